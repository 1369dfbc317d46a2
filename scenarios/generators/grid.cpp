// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// grid {name, body, counts, origin, spacing}: body (i, j, k) stands at origin + (i, j, k) * spacing and is
// called name_i_j_k (2D: name_i_j).
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generateGrid(const Node& node) {
    node.isObject({"name", "body", "counts", "origin", "spacing"});
    const auto name = node.require("name"), body = node.require("body"), counts = node.require("counts"),
               spacing = node.require("spacing");
    Generated made;
    if (!name || !body || !counts || !spacing) return made;
    const auto axes = static_cast<std::size_t>(node.dimension());
    std::vector<int> n;
    double total = 1.0;
    if (!counts->json().is_array() || counts->json().size() != axes)
        counts->problem("schema.type", "array of " + std::to_string(axes) + " numbers");
    else
        for (const Node& count : counts->items()) total *= n.emplace_back(count.scaledInteger(1, kMaxBodies));
    if (total > kMaxBodies)
        counts->problem("generator.size", "at most " + std::to_string(kMaxBodies) + " bodies");
    const Vec3 step = spacing->scaledVector(),
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    if (!node.context().problems.empty()) return made;
    const int layers = node.dimension() == 3 ? n[2] : 1;
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                std::string label = name->name() + "_" + std::to_string(i) + "_" + std::to_string(j);
                if (node.dimension() == 3) label += "_" + std::to_string(k);
                made.bodies.push_back(placed(body->json(), label,
                                             origin + Vec3{i * step.x, j * step.y, k * step.z},
                                             node.dimension()));
            }
    return made;
}

}  // namespace rigor::scenario
