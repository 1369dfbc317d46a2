// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/oracle/solid.hpp"

#include <algorithm>

namespace rigor::validation::oracle {
namespace {

const Vec kAxis{0, 1, 0};

Solid cylinder(const scenario::Cylinder& g) {
    const Real r = g.radius, half = g.halfLength;
    Solid s;
    s.discs = {{half * kAxis, kAxis, r}, {-half * kAxis, kAxis, r}};
    s.circles = {{kAxis, 0, {}, r}};
    s.faceNormals = {kAxis, -1 * kAxis};
    s.size = 2 * std::hypot(r, half);
    return s;
}

/// Apex at +half, so that its side's normals rise by the slope of half the opening angle.
Solid cone(const scenario::Cone& g) {
    const Real r = g.radius, half = g.halfLength;
    Solid s;
    s.points = {half * kAxis};
    s.discs = {{-half * kAxis, kAxis, r}};
    s.circles = {{kAxis, r / std::hypot(r, 2 * half), half * kAxis, 0}};
    s.faceNormals = {-1 * kAxis};
    s.size = std::max(2 * r, std::hypot(r, 2 * half));
    return s;
}

Solid fromCore(const Core& core) {
    Solid s;
    s.points = core.vertices;
    s.radius = core.radius;
    s.size = core.size;
    for (const Face& f : core.faces) {
        s.faceNormals.push_back(f.normal);
        s.faceNormals.push_back(-1 * f.normal);
    }
    for (const auto& e : core.edges) {
        const Vec along = edgeVector(core, e);
        const Real length = norm(along);
        if (length > 0) s.circles.push_back({(1 / length) * along, 0, core.vertices[e[0]], 0});
    }
    return s;
}

}  // namespace

std::optional<Solid> makeSolid(const scenario::Geometry& geometry, const scenario::Pose& pose,
                               scenario::Vec3 origin, bool features) {
    Solid s;
    if (const auto* c = std::get_if<scenario::Cylinder>(&geometry)) {
        s = cylinder(*c);
    } else if (const auto* k = std::get_if<scenario::Cone>(&geometry)) {
        s = cone(*k);
    } else {
        const std::optional<Core> core = makeCore(geometry, pose, 3, origin, features);
        if (!core) return std::nullopt;
        return fromCore(*core);
    }
    const Vec shift = widen(pose.position) - widen(origin);
    const auto turn = [&](Vec v) { return rotate(pose.orientation, v); };
    for (Vec& p : s.points) p = shift + turn(p);
    for (Disc& d : s.discs) {
        d.center = shift + turn(d.center);
        d.axis = turn(d.axis);
    }
    for (DirectionCircle& c : s.circles) {
        c.anchor = shift + turn(c.anchor);
        c.axis = turn(c.axis);
    }
    for (Vec& n : s.faceNormals) n = turn(n);
    return s;
}

Solid mirrored(const Solid& solid) {
    Solid s = solid;
    for (Vec& p : s.points) p = -1 * p;
    for (Disc& d : s.discs) d.center = -1 * d.center;
    for (DirectionCircle& c : s.circles) {
        c.axis = -1 * c.axis;
        c.anchor = -1 * c.anchor;
    }
    for (Vec& n : s.faceNormals) n = -1 * n;
    return s;
}

Real supportOf(const Solid& solid, Vec n) {
    Real best = -std::numeric_limits<Real>::max();
    for (const Vec& p : solid.points) best = std::max(best, dot(p, n));
    for (const Disc& d : solid.discs)
        best = std::max(best, dot(d.center, n) + d.radius * norm(cross(n, d.axis)));
    return best + solid.radius;
}

}  // namespace rigor::validation::oracle
