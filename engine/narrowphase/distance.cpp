// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance of any two convex shapes: half-spaces in closed form, else GJK between the cores and, where
// they overlap, EPA; the rounding radii come off in the end:
//   distance(A, B) = distance(core A, core B) - rA - rB
// A core difference without volume (two crossing segments, concentric balls) has no inside: the cores touch,
// the normal is across it, and its sign such that B is on the side of its own centre.
// Where EPA ran out of vertices (a ring of equally deep ways out of curved sides) its normal is close to the
// best: the descent of mpr.cpp, which needs no more of the surface than a portal, follows it to the end.
#include "engine/narrowphase/distance.hpp"

#include "engine/narrowphase/mpr.hpp"

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

/// What an unfinished EPA left to gain.
template <class S>
void finishByDescent(const Minkowski<S>& D, CoreContact<S>& r) {
    PortalQuery<S> query(D, typename S::Real(0));
    const WayOut<S> found = descend<S>(query, r.normal);
    r.iterations += query.asked();
    if (!(found.support < -r.distance)) return;
    r.normal = found.normal;
    r.distance = -found.support;
    r.converged = true;
    placeFoot<S>(query, D, D.innerPoint(), r);
}

}  // namespace

template <class S>
CoreContact<S> closestCores(const Minkowski<S>& D) {
    GjkResult<S> apart = gjk<S>(D, D.translation());
    CoreContact<S> r;
    r.iterations = apart.iterations;
    if (!apart.converged) {
        // Once in 10^4 pairs of parallel faces rounding keeps a stale simplex: start afresh where it stood.
        const GjkResult<S> again = gjk<S>(D, typename S::Vec(-apart.v));
        r.iterations += again.iterations;
        if (again.converged) apart = again;
    }
    r.converged = apart.converged;
    r.onA = apart.simplex.onA();
    r.onB = apart.simplex.onB();
    if (!apart.overlap) {
        r.distance = apart.v.norm();
        r.normal = -apart.v / r.distance;
        return r;
    }
    const EpaResult<S> inside = epa<typename S::Real>(D);
    r.iterations += inside.iterations;
    r.converged = inside.converged;
    r.normal = inside.normal;
    r.distance = -inside.depth;
    if (inside.flat) {
        if (r.normal.dot(D.translation()) < 0) r.normal = -r.normal;
    } else {
        r.onA = inside.simplex.onA();
        r.onB = inside.simplex.onB();
        if (!inside.converged) finishByDescent<S>(D, r);
    }
    return r;
}

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

    const CoreContact<S> cores = closestCores<S>(Minkowski<S>(a, Xa, b, Xb));
    const R rA = roundingRadius<S>(a), rB = roundingRadius<S>(b);
    ClosestPoints<S> r;
    r.distance = cores.distance - rA - rB;
    r.normal = rotate(Xa.q, cores.normal);
    r.pointA = toWorld<S>(Xa, V(cores.onA + rA * cores.normal));
    r.pointB = toWorld<S>(Xa, V(cores.onB - rB * cores.normal));
    r.iterations = cores.iterations;
    r.converged = cores.converged;
    return r;
}

#define INSTANTIATE(S)                                         \
    template CoreContact<S> closestCores(const Minkowski<S>&); \
    template ClosestPoints<S> closestPoints(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&);
INSTANTIATE(Space2f)
INSTANTIATE(Space2d)
INSTANTIATE(Space3f)
INSTANTIATE(Space3d)
#undef INSTANTIATE

}  // namespace rigor::engine
