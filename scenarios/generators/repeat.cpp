// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// repeat {name, generator, counts, spacing, spin, seed}: what the generator makes, counts[0] x counts[1] (x counts[2])
// times, copy (i, j, k) moved by (i, j, k) * spacing. Bodies and joints of a copy are called name_i_j_k_...
// (2D: name_i_j_...) before their own name. With `spin` [rad/s] each copy turns as one rigid body at first, about the mean
// position of its dynamic bodies, with an angular velocity whose components the seed draws from -spin .. spin (2D: one).
#include <span>

#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

/// Adds `by` to a vector of the file where it has one. What is no vector of numbers stays, for the reader to report.
void add(Json& object, const char* key, const Vec3& by, int dimension) {
    if (!object.contains(key)) {
        object[key] = vectorJson(by, dimension);
        return;
    }
    const double d[3] = {by.x, by.y, by.z};
    Json& v = object[key];
    for (std::size_t c = 0; v.is_array() && c < v.size() && c < 3; ++c)
        if (v[c].is_number()) v[c] = v[c].get<double>() + d[c];
}

bool isDynamic(const Json& body) {
    return !body.contains("type") || body["type"] == "dynamic";
}

Vec3 positionOf(const Json& body) {
    double p[3] = {0, 0, 0};
    if (const auto found = body.find("position"); found != body.end() && found->is_array())
        for (std::size_t c = 0; c < found->size() && c < 3; ++c)
            if ((*found)[c].is_number()) p[c] = (*found)[c].get<double>();
    return {p[0], p[1], p[2]};
}

/// Adds the velocities of a rigid motion of all dynamic bodies about the mean of their positions.
void spinTogether(std::span<Json> bodies, const Vec3& w, int dimension) {
    Vec3 sum;
    int n = 0;
    for (const Json& body : bodies)
        if (isDynamic(body)) {
            sum = sum + positionOf(body);
            ++n;
        }
    for (Json& body : bodies) {
        if (!isDynamic(body)) continue;
        add(body, "velocity", cross(w, positionOf(body) - sum * (1.0 / n)), dimension);
        if (dimension == 3)
            add(body, "angular_velocity", w, 3);
        else if (!body.contains("angular_velocity"))
            body["angular_velocity"] = w.z;
        else if (Json& turning = body["angular_velocity"]; turning.is_number())
            turning = turning.get<double>() + w.z;
    }
}

Vec3 drawn(PortableRandom& random, double most, int dimension) {
    const double x = dimension == 3 ? random.between(-most, most) : 0.0;
    const double y = dimension == 3 ? random.between(-most, most) : 0.0;
    return {x, y, random.between(-most, most)};
}

void rename(Json& object, const char* key, const std::string& prefix) {
    if (object.contains(key) && object[key].is_string() && object[key] != "world")
        object[key] = prefix + object[key].get<std::string>();
}

}  // namespace

Generated generateRepeat(const Node& node) {
    node.isObject({"name", "generator", "counts", "spacing", "spin", "seed"});
    const auto name = node.require("name"), generator = node.require("generator"),
               counts = node.require("counts"), spacing = node.require("spacing");
    Generated made;
    if (!name || !generator || !counts || !spacing) return made;
    const auto axes = counts->items();
    if (counts->json().is_array() && axes.size() != static_cast<std::size_t>(node.dimension()))
        counts->problem("schema.type", "array of " + std::to_string(node.dimension()) + " numbers");
    const Vec3 step = spacing->scaledVector();
    const double spin = node.has("spin") ? node["spin"].number(0.0, 1e3) : 0.0;
    const auto seed = node.has("spin") ? node.require("seed") : node.find("seed");
    PortableRandom random(seed ? static_cast<std::uint64_t>(seed->integer(0, 2000000000)) : 0);
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
                    add(body, "position", by, node.dimension());
                    made.bodies.push_back(std::move(body));
                }
                if (spin > 0)
                    spinTogether(std::span(made.bodies).last(one.bodies.size()),
                                 drawn(random, spin, node.dimension()), node.dimension());
                for (Json joint : one.joints) {
                    for (const char* key : {"name", "a", "b"}) rename(joint, key, prefix);
                    add(joint, "anchor", by, node.dimension());
                    made.joints.push_back(std::move(joint));
                }
            }
    return made;
}

}  // namespace rigor::scenario
