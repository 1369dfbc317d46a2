// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Portal discovery and refinement in 2D (see ../mpr.cpp): the portal is a segment of two support
// points on either side of the ray,
//   cross(u_0, d) >= 0 >= cross(u_1, d),   u_i = v_i - from,
// so that v_0 v_1 is counter-clockwise about `from` and its normal points out.
#include "engine/narrowphase/mpr.hpp"

namespace rigor::engine {
namespace {

constexpr int kMostDiscoveries = 32, kMostRefinements = 80;  ///< same limits as in 3d/mpr.cpp

}  // namespace

template <class R>
Portal<Space<R, 2>> castPortal(PortalQuery<Space<R, 2>>& query, const Vec2<R>& from, const Vec2<R>& d) {
    using S = Space<R, 2>;
    using V = Vec2<R>;
    Portal<S> portal;
    portal.normal = d;
    std::array<DifferencePoint<S>, 2> v;
    DifferencePoint<S> p = query.support(d);
    const R first = cross(V(p.w - from), d);
    const std::size_t known = first > 0 ? 0u : 1u;
    const R turn = first > 0 ? R(1) : R(-1);
    v[known] = p;
    // Support points further and further round on the side of the ray.
    for (int i = 0;; ++i) {
        const V u = v[known].w - from;
        const R length = u.norm();
        if (i == kMostDiscoveries || !(length > query.tolerance())) return portal;
        p = query.support(V(-u.y(), u.x()) * (turn / length));
        if (!(turn * cross(V(p.w - from), d) > 0)) break;
        v[known] = p;
    }
    v[1 - known] = p;
    for (int step = 0; step < kMostRefinements; ++step) {
        const V e = v[1].w - v[0].w;
        const R length = e.norm();
        if (!(length > query.tolerance())) return portal;
        portal.normal = V(e.y(), -e.x()) / length;
        portal.facet.points[0] = v[0];
        portal.facet.points[1] = v[1];
        portal.facet.count = 2;
        p = query.support(portal.normal);
        if (!(portal.normal.dot(p.w - v[0].w) > query.tolerance())) return portal;
        v[cross(V(p.w - from), d) > 0 ? 0u : 1u] = p;
    }
    return portal;
}

template Portal<Space2f> castPortal<float>(PortalQuery<Space2f>&, const Vec2<float>&, const Vec2<float>&);
template Portal<Space2d> castPortal<double>(PortalQuery<Space2d>&, const Vec2<double>&, const Vec2<double>&);

}  // namespace rigor::engine
