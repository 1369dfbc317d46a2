// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two capsules: the closest points of their segments [Ericson2005, ch. 5.1.9], or, where the segments run
// side by side, the two ends of their common stretch. Crossing segments are pushed apart along the common
// perpendicular: the Minkowski difference of two segments is flat, so the cores' penetration is zero.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// In the frame of A, whose segment is (0, -h, 0) to (0, h, 0); B's is c -+ e.
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

/// Sine of the angle between axes up to which two capsules lie side by side: about 3 degrees.
template <class R>
inline constexpr R kSideBySide = R(0.05);

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
    const V cross = V::UnitY().cross(s.e);
    const R sine = cross.norm() / b.halfLength;
    const V fallback = sine > kRounding<R> ? V(cross.normalized()) : V(V::UnitX());
    roundedPoint<S>(s.onA(y), a.radius, s.onB(t), b.radius, fallback, speculative, 0, out);
    if (out.count == 1 && sine < kSideBySide<R>) {
        // The common stretch along the axis of A; the closest point stays among the two.
        const R y0 = std::max(-s.h, s.c.y() - std::abs(s.e.y()));
        const R y1 = std::min(s.h, s.c.y() + std::abs(s.e.y()));
        const V n = out.normal;
        const R closest = out.points[0].separation;
        if (y1 - y0 > R(1e-3) * std::min(s.h, b.halfLength) && std::abs(n.y()) < kSideBySide<R>) {
            out.count = 0;
            for (const R end : {y0, y1}) {
                const R u = std::clamp((end - s.c.y()) / s.e.y(), R(-1), R(1));
                const V p = s.onA(end), q = s.onB(u);
                const R separation = n.dot(q - p) - a.radius - b.radius;
                if (separation > speculative) continue;
                // Which end of which segment bounds the stretch names the point.
                const bool endOfA = std::abs(end) >= s.h;
                const int vertex = endOfA ? (end < 0 ? 0 : 1) : (u < 0 ? 0 : 1);
                addPoint<S>(out, p + a.radius * n, p + (a.radius + separation) * n, separation,
                            vertexFeature(endOfA, vertex));
            }
            R best = std::numeric_limits<R>::max();
            for (int i = 0; i < out.count; ++i)
                best = std::min(best, out.points[static_cast<std::size_t>(i)].separation);
            if (best > closest + kRounding<R> * (a.radius + b.radius)) {
                // Skew segments are closest inside the stretch: that point alone.
                out.count = 0;
                roundedPoint<S>(s.onA(y), a.radius, s.onB(t), b.radius, fallback, speculative, 0, out);
            }
        }
    }
    toWorldFrame<S>(out, Xa);
}

template void collidePair<float>(const Capsule<Space3f>&, const Pose<Space3f>&, const Capsule<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Capsule<Space3d>&, const Pose<Space3d>&, const Capsule<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
