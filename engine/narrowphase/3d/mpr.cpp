// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Portal discovery and refinement in 3D [Snethen2008]. With u_i = v_i - from, the ray along d passes
// through the triangle v0 v1 v2 of support points iff
//   det(u_i, u_i+1, d) >= 0  for all three edges.
// Discovery turns a plane about the ray until a third support point closes the portal. Refinement computes
// the support point along the portal's normal and keeps that third of the triangle through which the ray
// passes, until the point is no further out than the portal itself.
#include "engine/narrowphase/mpr.hpp"

namespace rigor::engine {
namespace {

/// Discovery needs a handful; refinement gains a bit or more per step on curved sides. [-]
constexpr int kMostDiscoveries = 32, kMostRefinements = 80;

template <class R>
R det(const Vec3<R>& a, const Vec3<R>& b, const Vec3<R>& c) {
    return a.dot(b.cross(c));
}

template <class R>
bool discover(PortalQuery<Space<R, 3>>& query, const Vec3<R>& from, const Vec3<R>& d,
              std::array<DifferencePoint<Space<R, 3>>, 3>& v) {
    using V = Vec3<R>;
    v[0] = query.support(d);
    const auto u = [&](std::size_t i) { return V(v[i].w - from); };
    V n = u(0).cross(d);
    if (!(n.norm() > query.tolerance()))
        n = d.unitOrthogonal();  // the ray leaves at the support point itself
    v[1] = query.support(n.normalized());
    n = u(0).cross(u(1));
    if (n.dot(d) < 0) {
        std::swap(v[0], v[1]);
        n = -n;
    }
    for (int i = 0; i < kMostDiscoveries; ++i) {
        const R length = n.norm();
        if (!(length > query.tolerance() * query.tolerance())) return false;
        v[2] = query.support(n / length);
        if (det<R>(u(0), u(2), d) > 0) {
            v[1] = v[2];
            n = u(0).cross(u(1));
        } else if (det<R>(u(2), u(1), d) > 0) {
            v[0] = v[2];
            n = u(0).cross(u(1));
        } else {
            return true;
        }
    }
    return false;
}

}  // namespace

template <class R>
Portal<Space<R, 3>> castPortal(PortalQuery<Space<R, 3>>& query, const Vec3<R>& from, const Vec3<R>& d) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    Portal<S> portal;
    portal.normal = d;
    std::array<DifferencePoint<S>, 3> v;
    if (!discover<R>(query, from, d, v)) return portal;
    for (int step = 0; step < kMostRefinements; ++step) {
        const V e1 = v[1].w - v[0].w, e2 = v[2].w - v[0].w;
        const V n = e1.cross(e2);
        const R area = n.norm();
        if (!(area > R(4) * query.tolerance() * std::max(e1.norm(), e2.norm()))) return portal;
        portal.normal = n / area;
        for (std::size_t i = 0; i < 3; ++i) portal.facet.points[i] = v[i];
        portal.facet.count = 3;
        const DifferencePoint<S> p = query.support(portal.normal);
        if (!(portal.normal.dot(p.w - v[0].w) > query.tolerance())) return portal;
        std::array<R, 3> side;
        for (std::size_t i = 0; i < 3; ++i) side[i] = det<R>(V(p.w - from), V(v[i].w - from), d);
        std::size_t keep = 0;
        R best = -std::numeric_limits<R>::max();
        for (std::size_t i = 0; i < 3; ++i)
            if (const R inside = std::min(side[i], -side[(i + 1) % 3]); inside > best) {
                best = inside;
                keep = i;
            }
        v[(keep + 2) % 3] = p;
    }
    return portal;
}

template Portal<Space3f> castPortal<float>(PortalQuery<Space3f>&, const Vec3<float>&, const Vec3<float>&);
template Portal<Space3d> castPortal<double>(PortalQuery<Space3d>&, const Vec3<double>&, const Vec3<double>&);

}  // namespace rigor::engine
