// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the oracle: a core (point, segment, polygon or polyhedron, by its vertices) grown by a rounding
// radius, in long double and in the world frame. Private to this folder.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation::oracle {

using Real = long double;

struct Vec {
    Real x = 0, y = 0, z = 0;
};
inline Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(Real s, Vec a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Real dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(Vec a) {
    return std::sqrt(dot(a, a));
}

/// A facet of a core: a maximal set of vertices in one supporting plane.
struct Face {
    std::vector<int> vertices;  ///< vertices in no particular order
    std::vector<std::array<int, 2>> edges;
    Vec normal;  ///< unit; either sign
};

struct Core {
    std::vector<Vec> vertices;
    std::vector<std::array<int, 2>> edges;  ///< a point has one, from itself to itself
    std::vector<Face> faces;                ///< 3D only
    Real radius = 0;
    Real size = 0;  ///< largest distance between two vertices, plus the radius on both sides
};

/// Core of a posed shape relative to `origin`; empty for half-space, cylinder and cone, and for a segment in
/// 3D. Without `features` it has vertices and radius alone.
std::optional<Core> makeCore(const scenario::Geometry& geometry, const scenario::Pose& pose, int dimension,
                             scenario::Vec3 origin, bool features = true);

Vec edgeVector(const Core& core, const std::array<int, 2>& edge);

/// Two points and how far they are apart.
struct Pair {
    Real distance = std::numeric_limits<Real>::max();
    Vec onA, onB;
    void consider(Vec a, Vec b) {
        if (const Real d = norm(b - a); d < distance) *this = {d, a, b};
    }
};

/// Closest points of two cores that do not overlap, B moved by `shiftB`: over all pairs of features.
Pair closestFeatures(const Core& a, const Core& b, Vec shiftB = {});

/// x rotated by the unit quaternion; renormalised in long double.
Vec rotate(const scenario::Quat& q, Vec x);

inline Vec widen(scenario::Vec3 v) {
    return {v.x, v.y, v.z};
}
inline scenario::Vec3 narrow(Vec v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace rigor::validation::oracle
