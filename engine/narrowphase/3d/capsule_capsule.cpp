// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two capsules: the closest points of their segments [Ericson2005, ch. 5.1.9], or, where the segments run
// side by side, the two ends of their common stretch. Segments that cross at less than 26 degrees have both: where
// capsules overlap deeply they do so along the stretch, and would turn about one point and sink further in. Crossing
// segments are pushed apart along the common perpendicular: the Minkowski difference of two segments is flat, so the
// cores' penetration is zero.
#include <utility>

#include "engine/narrowphase/3d/feature_segments.hpp"
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// Both segments in the frame of A; A's is (0, -h, 0) to (0, h, 0), B's is c -+ e.
template <class R>
struct Segments {
    R h;
    Vec3<R> c, e;
    Vec3<R> onA(R y) const { return {0, y, 0}; }
    Vec3<R> onB(R t) const { return c + t * e; }
    /// Parameter in [-1, 1] of the point of B nearest to x.
    R nearestOnB(const Vec3<R>& x) const { return std::clamp(e.dot(x - c) / e.squaredNorm(), R(-1), R(1)); }
};

/// Closest pair: the interior one of the lines, clamped to B, then to A, then to B again.
template <class R>
void closestPair(const Segments<R>& s, R& y, R& t) {
    const R ee = s.e.squaredNorm(), across = ee - s.e.y() * s.e.y();
    // Squared distance of the axis and B's line, minimised over t with y free.
    const R free = across > 0 ? (s.c.y() * s.e.y() - s.c.dot(s.e)) / across : R(0);
    t = std::clamp(free, R(-1), R(1));
    y = std::clamp(s.c.y() + t * s.e.y(), -s.h, s.h);
    t = s.nearestOnB(s.onA(y));
    y = std::clamp(s.onB(t).y(), -s.h, s.h);
}

/// The contact normal. If the closest points are inside both segments it is the common perpendicular, which
/// stays accurate when the axes nearly meet; `across` = axis A x axis B, of length sine.
template <class R>
Vec3<R> contactNormal(const Segments<R>& s, R y, R t, const Vec3<R>& across, R sine, R size) {
    const Vec3<R> d = s.onB(t) - s.onA(y);
    const bool inside = std::abs(y) < s.h && std::abs(t) < R(1);
    if (inside && sine > R(1e-3)) return across * ((across.dot(d) < 0 ? R(-1) : R(1)) / sine);
    const R distance = d.norm();
    if (distance > kRounding<R> * size) return d / distance;
    return sine > kRounding<R> ? Vec3<R>(across / sine) : Vec3<R>(Vec3<R>::UnitX());
}

/// The stretch along A's axis that both segments reach over.
template <class R>
std::pair<R, R> commonStretch(const Segments<R>& s) {
    return {std::max(-s.h, s.c.y() - std::abs(s.e.y())), std::min(s.h, s.c.y() + std::abs(s.e.y()))};
}

/// Parameter of the point of B beside an end of the stretch.
template <class R>
R besideOnB(const Segments<R>& s, R end) {
    return std::clamp((end - s.c.y()) / s.e.y(), R(-1), R(1));
}

/// Name of a point by the end and the segment that bound the stretch.
template <class R>
int endFeature(const Segments<R>& s, R end, R u) {
    const bool endOfA = std::abs(end) >= s.h;
    return vertexFeature(endOfA, endOfA ? (end < 0 ? 0 : 1) : (u < 0 ? 0 : 1));
}

/// The two ends of the common stretch of nearly parallel segments, along the axis of A, with separations
/// along n. False if there is no interval for two points, or the closest point is inside it (skew segments).
template <class R>
bool sideBySide(const Segments<R>& s, R radiusA, R radiusB, const Vec3<R>& n, R closest, R speculative,
                Manifold<Space<R, 3>>& out) {
    const auto [low, high] = commonStretch(s);
    if (high - low <= R(1e-3) * std::min(s.h, s.e.norm()) || std::abs(n.y()) >= kParallelEdges<R>)
        return false;
    R least = std::numeric_limits<R>::max();
    for (const R end : {low, high}) {
        const R u = besideOnB(s, end);
        const Vec3<R> p = s.onA(end);
        const R separation = n.dot(s.onB(u) - p) - radiusA - radiusB;
        least = std::min(least, separation);
        if (separation > speculative) continue;
        addPoint<Space<R, 3>>(out, p + radiusA * n, p + (radiusA + separation) * n, separation,
                              endFeature(s, end, u));
    }
    if (least <= closest + kRounding<R> * (radiusA + radiusB)) return true;
    out.count = 0;
    return false;
}

/// The ends of the common stretch of segments that cross, on the line of B's side, with the separations there along n, which
/// stands on both axes. `y`: where the closest point is.
template <class R>
void addEnds(const Segments<R>& s, R radiusA, R radiusB, const Vec3<R>& n, R y, R speculative,
             Manifold<Space<R, 3>>& out) {
    const auto [low, high] = commonStretch(s);
    const R apart = R(0.1) * std::min(s.h, s.e.norm());
    for (const R end : {low, high}) {
        if (high - low < apart || std::abs(end - y) < apart) continue;
        const R u = besideOnB(s, end);
        const Vec3<R> way = s.onB(u) - s.onA(end);
        const R height = n.dot(way), x = (way - height * n).norm();
        if (!(x < R(0.9) * radiusA)) continue;
        const R separation = height - radiusB - std::sqrt(radiusA * radiusA - x * x);
        if (separation > speculative) continue;
        const Vec3<R> onB = s.onB(u) - radiusB * n;
        addPoint<Space<R, 3>>(out, onB - separation * n, onB, separation, endFeature(s, end, u));
    }
}

}  // namespace

template <class R>
void collidePair(const Capsule<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Capsule<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const Pose<S> X = relativePose<S>(Xa, Xb);
    const Segments<R> s{a.halfLength, X.p, b.halfLength * rotate(X.q, V(V::UnitY()))};
    R y = 0, t = 0;
    closestPair(s, y, t);
    const V p = s.onA(y), q = s.onB(t);
    const R separation = (q - p).norm() - a.radius - b.radius;
    if (separation > speculative) return;
    const V across = V::UnitY().cross(s.e) / b.halfLength;
    const R sine = across.norm();
    out.normal = contactNormal<R>(s, y, t, across, sine, a.radius + b.radius);
    const V n = out.normal;
    if (sine >= kParallelEdges<R> || !sideBySide<R>(s, a.radius, b.radius, n, separation, speculative, out)) {
        addPoint<S>(out, p + a.radius * n, q - b.radius * n, separation, 0);
        const R slope = std::max(std::abs(n.y()), std::abs(n.dot(s.e)) / b.halfLength);
        if (sine < kParallelSides<R> && slope < kSquare<R>)
            addEnds<R>(s, a.radius, b.radius, n, y, speculative, out);
    }
    toWorldFrame<S>(out, Xa);
}

template void collidePair<float>(const Capsule<Space3f>&, const Pose<Space3f>&, const Capsule<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Capsule<Space3d>&, const Pose<Space3d>&, const Capsule<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
