// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// group {bodies, joints, generators}: bodies and joints that are written out, and what generators make, as one
// thing: for `repeat`. The bodies that are written out come first.
#include <iterator>

#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generateGroup(const Node& node) {
    node.isObject({"bodies", "joints", "generators"});
    Generated made;
    if (node.has("bodies"))
        for (const Node& body : node["bodies"].items()) made.bodies.push_back(body.json());
    if (node.has("generators"))
        for (const Node& entry : node["generators"].items()) {
            Generated part = generate(entry);
            std::move(part.bodies.begin(), part.bodies.end(), std::back_inserter(made.bodies));
            std::move(part.joints.begin(), part.joints.end(), std::back_inserter(made.joints));
        }
    if (node.has("joints"))
        for (const Node& joint : node["joints"].items()) made.joints.push_back(joint.json());
    return made;
}

}  // namespace rigor::scenario
