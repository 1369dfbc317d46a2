// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// repeat {name, generator, counts, spacing}: what the generator makes, counts[0] x counts[1] (x counts[2])
// times, copy (i, j, k) moved by (i, j, k) * spacing. Bodies and joints of a copy are called name_i_j_k_...
// (2D: name_i_j_...) before their own name.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

/// Adds `by` to a vector of the file where it has one.
void move(Json& object, const char* key, const Vec3& by, int dimension) {
    if (!object.contains(key)) {
        object[key] = vectorJson(by, dimension);
        return;
    }
    const double d[3] = {by.x, by.y, by.z};
    Json& v = object[key];
    for (std::size_t c = 0; c < v.size() && c < 3; ++c)
        if (v[c].is_number()) v[c] = v[c].get<double>() + d[c];
}

void rename(Json& object, const char* key, const std::string& prefix) {
    if (object.contains(key) && object[key].is_string() && object[key] != "world")
        object[key] = prefix + object[key].get<std::string>();
}

}  // namespace

Generated generateRepeat(const Node& node) {
    node.isObject({"name", "generator", "counts", "spacing"});
    const auto name = node.require("name"), generator = node.require("generator"),
               counts = node.require("counts"), spacing = node.require("spacing");
    Generated made;
    if (!name || !generator || !counts || !spacing) return made;
    const auto axes = counts->items();
    if (counts->json().is_array() && axes.size() != static_cast<std::size_t>(node.dimension()))
        counts->problem("schema.type", "array of " + std::to_string(node.dimension()) + " numbers");
    const Vec3 step = spacing->scaledVector();
    if (!node.context().problems.empty()) return made;
    int n[3] = {1, 1, 1};
    for (std::size_t c = 0; c < axes.size(); ++c) n[c] = axes[c].scaledInteger(1, kMaxBodies);
    if (!node.context().problems.empty()) return made;
    const Generated one = generate(*generator);
    if (!node.context().problems.empty()) return made;
    if (static_cast<double>(n[0]) * n[1] * n[2] * static_cast<double>(one.bodies.size()) > kMaxBodies) {
        counts->problem("generator.size", "at most " + std::to_string(kMaxBodies) + " bodies");
        return made;
    }
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                std::string prefix = name->name() + "_" + std::to_string(i) + "_" + std::to_string(j) + "_";
                if (node.dimension() == 3) prefix += std::to_string(k) + "_";
                const Vec3 by{i * step.x, j * step.y, k * step.z};
                for (Json body : one.bodies) {
                    rename(body, "name", prefix);
                    move(body, "position", by, node.dimension());
                    made.bodies.push_back(std::move(body));
                }
                for (Json joint : one.joints) {
                    for (const char* key : {"name", "a", "b"}) rename(joint, key, prefix);
                    move(joint, "anchor", by, node.dimension());
                    made.joints.push_back(std::move(joint));
                }
            }
    return made;
}

}  // namespace rigor::scenario
