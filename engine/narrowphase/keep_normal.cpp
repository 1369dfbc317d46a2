// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hysteresis of the penetration vectors that EPA and MPR find. Overlapping cores can have several that are
// equally deep, far apart from each other, and rounding would choose another one in every step. With h the
// support of the Minkowski difference D, n the direction of least h and m that of the last step:
//   where m and n are further apart than a face's own wobble (2.5 degrees), follow the descent n := normal of
//   the facet through which the ray along n leaves D (mpr.cpp) from m to its local minimum m';
//   m' stays where h(m') <= h(n) + kKeep size.
// So the penetration vector moves with the bodies, exactly, and changes only for one that is shorter by more
// than that. Cores that are apart have one normal, which moves with them: nothing to keep. Cost: nothing
// while n stays; about 3 rays (30 support points) in a step in which it would jump.
#include "engine/narrowphase/mpr.hpp"

namespace rigor::engine {
namespace {

/// A descent gains at least a facet per ray; more rays than this only trade rounding.
constexpr int kMostRays = 24;
/// A foot point this far from its facet, as a fraction of the place, was not on it.
template <class R>
inline constexpr R kLostFoot = R(1e-3);

/// Half the largest extent of a core.
template <class S>
typename S::Real coreSize(const Shape<S>& shape) {
    using R = typename S::Real;
    using V = typename S::Vec;
    R size = 0;
    for (int i = 0; i < S::dim; ++i)
        size =
            std::max(size, coreSupport<S>(shape, V::Unit(i))[i] - coreSupport<S>(shape, V(-V::Unit(i)))[i]);
    return size / R(2) + roundingRadius<S>(shape);
}

}  // namespace

template <class S>
PenetrationVector<S> descend(PortalQuery<S>& query, const typename S::Vec& start) {
    using R = typename S::Real;
    using V = typename S::Vec;
    PenetrationVector<S> out{start, R(start.dot(query.support(start).w))};
    for (int ray = 0; ray < kMostRays; ++ray) {
        const Portal<S> portal = castPortal<R>(query, V(V::Zero()), out.normal);
        if (portal.facet.count == 0) break;
        const R support = portal.normal.dot(portal.facet.points[0].w), gain = out.support - support;
        if (ray == 0 || gain > 0) out = {portal.normal, support};
        if (ray > 0 && !(gain > query.tolerance())) break;
    }
    return out;
}

template <class S>
void placeFoot(PortalQuery<S>& query, const Minkowski<S>& D, const typename S::Vec& inner,
               CoreContact<S>& contact) {
    using R = typename S::Real;
    using V = typename S::Vec;
    // The ray from deep inside to the foot point meets the facet that holds it.
    const V foot = (query.margin() - contact.distance) * contact.normal;
    Portal<S> portal = castPortal<R>(query, inner, V((foot - inner).normalized()));
    if (portal.facet.count == 0) {
        const DifferencePoint<S> p = D.point(contact.normal);
        contact.onA = p.a;
        contact.onB = p.b;
    } else {
        reduceSimplex<S>(portal.facet, foot);
        contact.onA = portal.facet.onA();
        contact.onB = portal.facet.onB();
    }
    V gap = contact.onB - contact.onA - contact.distance * contact.normal;
    if (gap.norm() > kLostFoot<typename S::Real> * std::max(contact.onA.norm(), contact.onB.norm()) &&
        std::abs(contact.distance) <= query.tolerance()) {
        // Cores that cross without a volume in common (two segments): no facet holds the foot. They touch.
        const GjkResult<S> closest = gjk<S>(D, D.translation());
        contact.onA = closest.simplex.onA();
        contact.onB = closest.simplex.onB();
        gap = contact.onB - contact.onA - contact.distance * contact.normal;
    }
    // The foot point is shared: what is left of a difference across the normal goes half to either side.
    contact.onA += R(0.5) * gap;
    contact.onB -= R(0.5) * gap;
}

template <class S>
typename S::Vec innerPoint(const Shape<S>& shape) {
    using V = typename S::Vec;
    if (const auto* hull = std::get_if<Hull<S>>(&shape)) return hull->data->center;
    V sum = V::Zero();
    for (int i = 0; i < S::dim; ++i)
        sum += coreSupport<S>(shape, V::Unit(i)) + coreSupport<S>(shape, V(-V::Unit(i)));
    return sum / typename S::Real(2 * S::dim);
}

template <class S>
void keepNormal(const Shape<S>& a, const Shape<S>& b, const Minkowski<S>& D, const typename S::Vec& last,
                CoreContact<S>& contact) {
    using R = typename S::Real;
    if (!(contact.distance < 0) || last.dot(contact.normal) > kFlatFeature<R>) return;
    PortalQuery<S> query(D, R(0));
    // The result of the descent, not the least of all directions queried: that may be the other one.
    const PenetrationVector<S> found = descend<S>(query, last);
    if (!(found.support <= kKeep<R> * std::min(coreSize<S>(a), coreSize<S>(b)) - contact.distance)) return;
    contact.normal = found.normal;
    contact.distance = -found.support;
    placeFoot<S>(query, D, D.innerPoint(), contact);
    refineCurved(D, contact);
}

#define INSTANTIATE(S)                                                                                \
    template PenetrationVector<S> descend(PortalQuery<S>&, const S::Vec&);                            \
    template void placeFoot(PortalQuery<S>&, const Minkowski<S>&, const S::Vec&, CoreContact<S>&);    \
    template S::Vec innerPoint<S>(const Shape<S>&);                                                   \
    template void keepNormal<S>(const Shape<S>&, const Shape<S>&, const Minkowski<S>&, const S::Vec&, \
                                CoreContact<S>&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
