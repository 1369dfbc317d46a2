// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries of Minkowski portal refinement to the Minkowski difference, the same in both dimensions: support
// points of D grown by a margin, and the least support found so far. Private to this folder; the method is
// described in mpr.cpp.
#pragma once

#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {

template <class S>
class PortalQuery {
  public:
    using R = typename S::Real;
    using V = typename S::Vec;

    PortalQuery(const Minkowski<S>& difference, R margin) : D_(difference), margin_(margin) {}

    /// Support point of the grown difference along the unit vector n.
    DifferencePoint<S> support(const V& n) {
        DifferencePoint<S> p = D_.point(n);
        ++queries_;
        const R support = n.dot(p.w);
        if (support < least_) {
            least_ = support;
            normal_ = n;
        }
        size_ = std::max({size_, p.a.norm(), p.b.norm(), margin_});
        p.w += margin_ * n;
        return p;
    }
    R margin() const { return margin_; }
    R tolerance() const { return kRounding<R> * size_; }
    int queries() const { return queries_; }
    /// Least support of D itself (without the margin) over all directions queried, and the direction.
    R least() const { return least_; }
    const V& normal() const { return normal_; }

  private:
    const Minkowski<S>& D_;
    R margin_, size_ = 0, least_ = std::numeric_limits<R>::max();
    V normal_ = V::UnitY();
    int queries_ = 0;
};

/// The facet of the grown difference through which the ray from `from` (inside) along the unit vector `d`
/// leaves, to rounding: its outward normal and dim of its points. Count 0 where the ray has no facet of its
/// own: it leaves at a support point, or rounding left nothing.
template <class S>
struct Portal {
    typename S::Vec normal;
    Simplex<S> facet;
};
/// Candidate of the penetration vector: a unit direction and the support of the (grown) difference along it.
template <class S>
struct PenetrationVector {
    typename S::Vec normal;
    typename S::Real support;
};
/// Follows the normals of portals from the direction `start` down to a local minimum of the support.
template <class S>
PenetrationVector<S> descend(PortalQuery<S>& query, const typename S::Vec& start);
/// Points on the cores for a normal and distance that a query has found; `inner` is inside the difference.
template <class S>
void placeFoot(PortalQuery<S>& query, const Minkowski<S>& D, const typename S::Vec& inner,
               CoreContact<S>& contact);

template <class R>
Portal<Space<R, 2>> castPortal(PortalQuery<Space<R, 2>>& query, const Vec2<R>& from, const Vec2<R>& d);
template <class R>
Portal<Space<R, 3>> castPortal(PortalQuery<Space<R, 3>>& query, const Vec3<R>& from, const Vec3<R>& d);

}  // namespace rigor::engine
