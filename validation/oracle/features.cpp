// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The closest points of two cores by trying every pair of features: edges against edges, vertices against
// faces.
#include <algorithm>

#include "validation/oracle/core.hpp"

namespace rigor::validation::oracle {
namespace {

/// Nearest point to x of the segment from p along d.
Vec nearestOnSegment(Vec x, Vec p, Vec d) {
    const Real dd = dot(d, d);
    return dd > 0 ? p + std::clamp(dot(x - p, d) / dd, 0.0L, 1.0L) * d : p;
}

/// All cases of two segments: the four ends against the other segment, and the two lines' common
/// perpendicular where its feet are inside both.
void segments(Vec p, Vec d, Vec q, Vec e, Pair& best) {
    for (const Vec& x : {p, p + d}) best.consider(x, nearestOnSegment(x, q, e));
    for (const Vec& y : {q, q + e}) best.consider(nearestOnSegment(y, p, d), y);
    const Vec n = cross(d, e);
    const Real nn = dot(n, n);
    if (nn <= 0) return;
    const Real s = dot(cross(q - p, e), n) / nn, t = dot(cross(q - p, d), n) / nn;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best.consider(p + s * d, q + t * e);
}

/// Foot of x on the plane of a face, if inside the face: on the inner side of all its edges.
bool footInFace(const Core& c, const Face& f, Vec x, Vec& foot) {
    Vec middle;
    for (int v : f.vertices) middle = middle + (1.0L / static_cast<Real>(f.vertices.size())) * c.vertices[v];
    foot = x - dot(f.normal, x - middle) * f.normal;
    for (const auto& e : f.edges) {
        const Vec p = c.vertices[e[0]];
        const Vec across = cross(f.normal, edgeVector(c, e));
        if (dot(across, foot - p) * dot(across, middle - p) < 0) return false;
    }
    return true;
}

}  // namespace

Vec edgeVector(const Core& c, const std::array<int, 2>& e) {
    return c.vertices[e[1]] - c.vertices[e[0]];
}

Pair closestFeatures(const Core& a, const Core& b, Vec shiftB) {
    Pair best;
    for (const auto& ea : a.edges)
        for (const auto& eb : b.edges)
            segments(a.vertices[ea[0]], edgeVector(a, ea), b.vertices[eb[0]] + shiftB, edgeVector(b, eb),
                     best);
    Vec foot;
    for (const Face& f : a.faces)
        for (const Vec& v : b.vertices)
            if (footInFace(a, f, v + shiftB, foot)) best.consider(foot, v + shiftB);
    for (const Face& f : b.faces)
        for (const Vec& v : a.vertices)
            if (footInFace(b, f, v - shiftB, foot)) best.consider(v, foot + shiftB);
    return best;
}

}  // namespace rigor::validation::oracle
