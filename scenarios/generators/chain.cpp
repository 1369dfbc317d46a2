// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// chain {name, body, links, origin, direction, link_length, joint, axis, anchored, end_body}: link i has its
// body frame at the middle of the i-th piece of length link_length from origin along direction, and is joined
// to the one before; the first to the world unless "anchored" is false. "end_body" replaces the template of
// the last link (a heavy weight). Names name_i and joints name_joint_i.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generateChain(const Node& node) {
    node.isObject({"name", "body", "links", "origin", "direction", "link_length", "joint", "axis", "anchored",
                   "end_body"});
    const auto name = node.require("name"), body = node.require("body"), linksNode = node.require("links"),
               direction = node.require("direction"), lengthNode = node.require("link_length"),
               joint = node.require("joint");
    Generated made;
    if (!name || !body || !linksNode || !direction || !lengthNode || !joint) return made;
    const int links = linksNode->scaledInteger(1, kMaxBodies);
    const double length = lengthNode->positive();
    const Vec3 along = direction->unitVector(),
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    const bool anchored = !node.has("anchored") || node["anchored"].boolean();
    if (!node.context().problems.empty()) return made;
    std::string before = "world";
    for (int i = 0; i < links; ++i) {
        const bool last = i == links - 1;
        const Json& pattern = last && node.has("end_body") ? node["end_body"].json() : body->json();
        const std::string label = name->name() + "_" + std::to_string(i);
        made.bodies.push_back(
            placed(pattern, label, origin + ((i + 0.5) * length) * along, node.dimension()));
        if (i > 0 || anchored) {
            Json link{{"name", name->name() + "_joint_" + std::to_string(i)},
                      {"type", joint->json()},
                      {"a", before},
                      {"b", label},
                      {"anchor", vectorJson(origin + (i * length) * along, node.dimension())}};
            if (node.has("axis")) link["axis"] = node["axis"].json();
            made.joints.push_back(std::move(link));
        }
        before = label;
    }
    return made;
}

}  // namespace rigor::scenario
