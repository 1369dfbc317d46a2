// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance of any two convex shapes: half-spaces in closed form, else GJK between the cores and, where
// they overlap, EPA; the rounding radii come off in the end:
//   distance(A, B) = distance(core A, core B) - rA - rB
// A core difference without volume (two crossing segments, concentric balls) has no inside: the cores touch,
// the normal is across it, and its sign such that B is on the side of its own centre.
#include "engine/narrowphase/distance.hpp"

#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

/// A shape against a half-space: its lowest point over the plane.
template <class S>
ClosestPoints<S> overPlane(const Shape<S>& a, const Pose<S>& Xa, const HalfSpace<S>& b, const Pose<S>& Xb) {
    using R = typename S::Real;
    using V = typename S::Vec;
    ClosestPoints<S> r;
    const V n = rotate(Xb.q, b.normal);
    const V arm = rotate(Xa.q, coreSupport<S>(a, rotateInverse<R>(Xa.q, V(-n)))) - roundingRadius<S>(a) * n;
    r.normal = -n;
    r.distance = n.dot(Xa.p - Xb.p) - b.offset + n.dot(arm);
    r.pointA = Xa.p + arm;
    r.pointB = r.pointA - r.distance * n;
    r.iterations = 1;
    r.converged = true;
    return r;
}

template <class S>
ClosestPoints<S> twoPlanes(const HalfSpace<S>& a, const Pose<S>& Xa) {
    ClosestPoints<S> r;
    r.normal = rotate(Xa.q, a.normal);
    r.pointA = r.pointB = toWorld<S>(Xa, typename S::Vec(a.offset * a.normal));
    r.distance = std::numeric_limits<typename S::Real>::lowest();
    return r;
}

}  // namespace

template <class S>
ClosestPoints<S> closestPoints(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const auto* planeA = std::get_if<HalfSpace<S>>(&a);
    const auto* planeB = std::get_if<HalfSpace<S>>(&b);
    if (planeA && planeB) return twoPlanes<S>(*planeA, Xa);
    if (planeB) return overPlane<S>(a, Xa, *planeB, Xb);
    if (planeA) {
        ClosestPoints<S> r = overPlane<S>(b, Xb, *planeA, Xa);
        std::swap(r.pointA, r.pointB);
        r.normal = -r.normal;
        return r;
    }

    const Minkowski<S> D(a, Xa, b, Xb);
    const GjkResult<S> apart = gjk<S>(D, D.translation());
    ClosestPoints<S> r;
    r.iterations = apart.iterations;
    r.converged = apart.converged;
    V onA = apart.simplex.onA(), onB = apart.simplex.onB(), n;
    R distance = apart.v.norm();
    if (apart.overlap) {
        const EpaResult<S> inside = epa<R>(D);
        r.iterations += inside.iterations;
        r.converged = inside.converged;
        n = inside.normal;
        distance = -inside.depth;
        if (inside.flat) {
            if (n.dot(D.translation()) < 0) n = -n;
        } else {
            onA = inside.simplex.onA();
            onB = inside.simplex.onB();
        }
    } else {
        n = -apart.v / distance;
    }
    const R rA = roundingRadius<S>(a), rB = roundingRadius<S>(b);
    r.distance = distance - rA - rB;
    r.normal = rotate(Xa.q, n);
    r.pointA = toWorld<S>(Xa, V(onA + rA * n));
    r.pointB = toWorld<S>(Xa, V(onB - rB * n));
    return r;
}

#define INSTANTIATE(S) \
    template ClosestPoints<S> closestPoints(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&);
INSTANTIATE(Space2f)
INSTANTIATE(Space2d)
INSTANTIATE(Space3f)
INSTANTIATE(Space3d)
#undef INSTANTIATE

}  // namespace rigor::engine
