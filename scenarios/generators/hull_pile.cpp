// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// hull_pile {name, kinds, vertices, radius, roughness, material, count, seed, columns, origin, spacing,
// jitter, turn}: a pile (pile.cpp) of convex hulls, `kinds` different ones in turn. The vertices of a hull
// lie on a sphere of `radius` [m] about the body's frame, at the places of a Fibonacci lattice (Gonzalez,
// Mathematical Geosciences 42, 2010, 49-64), each moved by up to `roughness` radii along every axis and put
// back on the sphere. 3D only.
#include <cmath>

#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

constexpr double kGoldenAngle = 2.39996322972865332;  ///< pi (3 - sqrt 5)

Json hullTemplate(const Node& node, int vertices, double radius, double roughness, PortableRandom& random) {
    Json points = Json::array();
    for (int i = 0; i < vertices; ++i) {
        const double y = 1.0 - 2.0 * (i + 0.5) / vertices, r = std::sqrt(1.0 - y * y), a = i * kGoldenAngle;
        Vec3 p{r * std::cos(a), y, r * std::sin(a)};
        p.x += random.between(-roughness, roughness);
        p.y += random.between(-roughness, roughness);
        p.z += random.between(-roughness, roughness);
        points.push_back(vectorJson(radius / norm(p) * p, 3));
    }
    Json shape{{"hull", {{"vertices", points}}}};
    if (node.has("material")) shape["material"] = node["material"].json();
    return {{"shapes", Json::array({shape})}};
}

}  // namespace

Generated generateHullPile(const Node& node) {
    node.isObject({"name", "kinds", "vertices", "radius", "roughness", "material", "count", "seed", "columns",
                   "origin", "spacing", "jitter", "turn"});
    const auto kinds = node.require("kinds"), vertices = node.require("vertices"),
               radius = node.require("radius"), seed = node.require("seed");
    if (!kinds || !vertices || !radius || !seed) return {};
    if (node.dimension() != 3) node.problem("generator.dimension", "a scenario in 3D");
    const int hulls = kinds->integer(1, 1000), corners = vertices->integer(4, 64);
    const double size = radius->positive(),
                 roughness = node.has("roughness") ? node["roughness"].number(0.0, 0.3) : 0.0;
    PortableRandom random(static_cast<std::uint64_t>(seed->integer(0, 2000000000)));
    if (!node.context().problems.empty()) return {};
    std::vector<Json> templates;
    for (int i = 0; i < hulls; ++i) templates.push_back(hullTemplate(node, corners, size, roughness, random));
    return pileUp(node, templates, random);
}

}  // namespace rigor::scenario
