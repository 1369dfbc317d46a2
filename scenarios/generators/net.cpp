// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// net {name, body, counts, across, down, origin, joint, axis, anchored}: body name_i_j stands at
// origin + i across + j down, i < counts[0], j < counts[1], and is joined half-way to the bodies (i + 1, j)
// and (i, j + 1) by joints name_across_i_j and name_down_i_j. With "anchored" (default true) the bodies of
// row 0 are joined to the world at their places, by name_anchor_i.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

struct Net {
    const Node& node;
    std::string name;
    int columns, rows;
    Vec3 origin, across, down;

    Vec3 place(double i, double j) const { return origin + i * across + j * down; }
    static std::string index(int i, int j) { return "_" + std::to_string(i) + "_" + std::to_string(j); }
    std::string label(int i, int j) const { return name + index(i, j); }
    Json joint(const std::string& jointName, const std::string& a, const std::string& b,
               const Vec3& anchor) const {
        Json link{{"name", jointName},
                  {"type", node["joint"].json()},
                  {"a", a},
                  {"b", b},
                  {"anchor", vectorJson(anchor, node.dimension())}};
        if (node.has("axis")) link["axis"] = node["axis"].json();
        return link;
    }
};

}  // namespace

Generated generateNet(const Node& node) {
    node.isObject({"name", "body", "counts", "across", "down", "origin", "joint", "axis", "anchored"});
    const auto name = node.require("name"), body = node.require("body"), counts = node.require("counts"),
               across = node.require("across"), down = node.require("down"), joint = node.require("joint");
    Generated made;
    if (!name || !body || !counts || !across || !down || !joint) return made;
    const auto sides = counts->items();
    if (counts->json().is_array() && sides.size() != 2) counts->problem("schema.type", "array of 2 numbers");
    const bool anchored = !node.has("anchored") || node["anchored"].boolean();
    if (!node.context().problems.empty()) return made;
    Net net{node,
            name->name(),
            sides[0].scaledInteger(1, 1000),
            sides[1].scaledInteger(1, 1000),
            node.has("origin") ? node["origin"].scaledVector() : Vec3{},
            across->vector(),
            down->vector()};
    if (net.columns * net.rows > kMaxBodies)
        counts->problem("generator.size", "at most " + std::to_string(kMaxBodies) + " bodies");
    if (!node.context().problems.empty()) return made;
    for (int j = 0; j < net.rows; ++j)
        for (int i = 0; i < net.columns; ++i) {
            const std::string here = net.label(i, j);
            made.bodies.push_back(placed(body->json(), here, net.place(i, j), node.dimension()));
            if (j == 0 && anchored)
                made.joints.push_back(
                    net.joint(net.name + "_anchor_" + std::to_string(i), "world", here, net.place(i, j)));
            if (i > 0)
                made.joints.push_back(net.joint(net.name + "_across" + Net::index(i - 1, j),
                                                net.label(i - 1, j), here, net.place(i - 0.5, j)));
            if (j > 0)
                made.joints.push_back(net.joint(net.name + "_down" + Net::index(i, j - 1),
                                                net.label(i, j - 1), here, net.place(i, j - 0.5)));
        }
    return made;
}

}  // namespace rigor::scenario
