// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance of any two convex shapes: half-spaces in closed form, else GJK between the cores and, where
// they overlap, EPA; the rounding radii come off in the end:
//   distance(A, B) = distance(core A, core B) - rA - rB
// A core difference without volume (two crossing segments, concentric spheres) has no inside: the cores
// touch, the normal is across it, and its sign such that B is on the side of its own centre. If EPA ran out
// of vertices (rings of nearly equal penetration vectors of curved sides), the descents of mpr.cpp, which
// need no more of the surface than a portal, go on from its normal and from the shapes' axes.
#include "engine/narrowphase/distance.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

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

/// Improves the result of an EPA that did not converge: descents from its normal and from the lowest of the
/// shapes' own axes, which are directions out of curved sides.
template <class S>
void finishByDescent(const Minkowski<S>& D, CoreContact<S>& r) {
    using R = typename S::Real;
    using V = typename S::Vec;
    constexpr std::size_t kAxes = 4 * S::dim, kDescents = 3;
    PortalQuery<S> query(D, R(0));
    descend<S>(query, r.normal);
    std::array<std::pair<R, V>, kAxes> starts;
    for (std::size_t i = 0; i < kAxes; ++i) {
        const auto k = static_cast<Eigen::Index>(i / 4);
        const V axis = i % 2 == 0 ? V(V::Unit(k)) : V(D.rotation().col(k)), d = i % 4 < 2 ? axis : V(-axis);
        starts[i] = {d.dot(query.support(d).w), d};
    }
    std::partial_sort(starts.begin(), starts.begin() + kDescents, starts.end(),
                      [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t i = 0; i < kDescents; ++i) descend<S>(query, starts[i].second);
    // A descent along a ring that is nearly level runs out of rays.
    R before = std::numeric_limits<R>::max();
    for (int again = 0; again < 8 && query.least() < before - query.tolerance(); ++again) {
        before = query.least();
        descend<S>(query, query.normal());
    }
    r.iterations += query.queries();
    if (query.least() < -r.distance) {
        r.normal = query.normal();
        r.distance = -query.least();
    }
    placeFoot<S>(query, D, D.innerPoint(), r);
}

/// The result of GJK and EPA, which know support points alone.
template <class S>
CoreContact<S> supportedCores(const Minkowski<S>& D) {
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

}  // namespace

template <class S>
CoreContact<S> closestCores(const Minkowski<S>& D) {
    CoreContact<S> r = supportedCores<S>(D);
    refineCurved(D, r);
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
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
