// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See hollow.hpp.
#include "validation/references/rolling/hollow.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

struct Facets {
    std::vector<Vec3> corners;  ///< world
    std::vector<Vec3> normals;  ///< unit, any sign
};

Facets facetsOf(const Body& body) {
    const std::string subject = "body '" + body.name + "'";
    require(body.shapes.size() == 1, subject + " is not a single surface");
    const Pose pose = body.pose * body.shapes[0].pose;
    Facets facets;
    if (const auto* chain = std::get_if<scenario::Chain>(&body.shapes[0].geometry)) {
        for (const Vec3 v : chain->vertices) facets.corners.push_back(pose * v);
        for (std::size_t i = 0; i + 1 < facets.corners.size(); ++i)
            facets.normals.push_back(unit(cross({0, 0, 1}, facets.corners[i + 1] - facets.corners[i])));
        return facets;
    }
    const auto* mesh = std::get_if<scenario::TriangleMesh>(&body.shapes[0].geometry);
    require(mesh != nullptr, subject + " is neither a chain of segments nor a mesh of triangles");
    for (const Vec3 v : mesh->vertices) facets.corners.push_back(pose * v);
    for (const auto& t : mesh->triangles) {
        const auto at = [&](std::size_t k) { return facets.corners[t[k]]; };
        facets.normals.push_back(unit(cross(at(1) - at(0), at(2) - at(0))));
    }
    return facets;
}

/// Centre of the circle through three points across `axis`.
Vec3 circleCenter(Vec3 a, Vec3 b, Vec3 c, Vec3 axis) {
    const auto flat = [&](Vec3 v) { return v - dot(v, axis) * axis; };
    const Vec3 u = flat(b - a), v = flat(c - a), n = cross(u, v);
    const double area = dot(n, n);
    return a + (1 / (2 * area)) * cross(dot(u, u) * v - dot(v, v) * u, n);
}

}  // namespace

Hollow hollowOf(const Scenario& scenario, int base, Vec3 inside) {
    const Body& body = scenario.bodies[base];
    const std::string subject = bodyTitle(scenario, base);
    require(body.type == scenario::BodyType::Static, subject + " is not static");
    const Facets facets = facetsOf(body);
    Hollow hollow;
    hollow.material = body.shapes[0].material;
    hollow.axis = {0, 0, 1};
    if (scenario.dimension == 3) {
        // All normals are across the axis: it is across the two that differ most.
        Vec3 widest{};
        for (const Vec3 n : facets.normals) {
            const Vec3 c = cross(facets.normals[0], n);
            if (norm(c) > norm(widest)) widest = c;
        }
        require(norm(widest) > 0.1, subject + " is not hollow");
        hollow.axis = unit(widest);
    }
    for (const Vec3 n : facets.normals)
        require(std::abs(dot(n, hollow.axis)) <= 1e-6, subject + " is not straight along one axis");
    // Three corners that lie apart across the axis.
    const auto apart = [&](Vec3 a, Vec3 b) { return norm(cross(b - a, hollow.axis)); };
    const Vec3 a = facets.corners.front();
    Vec3 b = a, c = a;
    for (const Vec3 p : facets.corners)
        if (apart(a, p) > apart(a, b)) b = p;
    for (const Vec3 p : facets.corners)
        if (std::min(apart(a, p), apart(b, p)) > std::min(apart(a, c), apart(b, c))) c = p;
    require(apart(a, c) > 0.0, subject + " is not hollow");
    hollow.center = circleCenter(a, b, c, hollow.axis);
    const double outer = norm(hollow.across(a));
    for (const Vec3 p : facets.corners)
        require(std::abs(norm(hollow.across(p)) - outer) <= 1e-6 * outer,
                "the corners of " + subject + " are not on one cylinder");
    // A facet's distance from the axis is R cos(d/2).
    double nearest = outer;
    for (std::size_t k = 0; k < facets.normals.size(); ++k) {
        Vec3 corner = facets.corners[k];
        if (scenario.dimension == 3) {
            const auto& mesh = std::get<scenario::TriangleMesh>(body.shapes[0].geometry);
            corner = facets.corners[mesh.triangles[k][0]];
        }
        nearest = std::min(nearest, std::abs(dot(facets.normals[k], hollow.across(corner))));
    }
    hollow.facet = 2 * std::acos(std::min(1.0, nearest / outer));
    require(hollow.facet <= 0.035, "the facets of " + subject + " are wider than 2 degrees");
    hollow.radius = nearest;
    require(norm(hollow.across(inside)) < outer, "nothing is inside " + subject);
    return hollow;
}

}  // namespace rigor::validation
