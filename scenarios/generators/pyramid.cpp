// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// pyramid {name, body, rows, origin, spacing}: row r (0 at the bottom) has rows - r bodies centred on origin
// along x; in 3D it is a square layer of (rows - r)^2. Names name_r_i (3D: name_r_i_k). `origin` is the
// centre of the bottom row.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generatePyramid(const Node& node) {
    node.isObject({"name", "body", "rows", "origin", "spacing"});
    const auto name = node.require("name"), body = node.require("body"), rowsNode = node.require("rows"),
               spacing = node.require("spacing");
    Generated made;
    if (!name || !body || !rowsNode || !spacing) return made;
    // both limits are below kMaxBodies
    const int rows = rowsNode->scaledInteger(1, node.dimension() == 2 ? 315 : 52);
    const Vec3 step = spacing->scaledVector(),
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    if (!node.context().problems.empty()) return made;
    for (int row = 0; row < rows; ++row) {
        const int n = rows - row, depth = node.dimension() == 3 ? n : 1;
        const double half = 0.5 * (n - 1);
        for (int k = 0; k < depth; ++k)
            for (int i = 0; i < n; ++i) {
                std::string label = name->name() + "_" + std::to_string(row) + "_" + std::to_string(i);
                if (node.dimension() == 3) label += "_" + std::to_string(k);
                const Vec3 offset{(i - half) * step.x, row * step.y,
                                  node.dimension() == 3 ? (k - half) * step.z : 0.0};
                made.bodies.push_back(placed(body->json(), label, origin + offset, node.dimension()));
            }
    }
    return made;
}

}  // namespace rigor::scenario
