// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The Minkowski difference D = core A - core B as GJK, EPA and MPR see it: a support mapping in the frame of
// A. A core is the shape without its rounding radius: a point for a sphere, a segment for a capsule.
//   support of D along d:  w = a - b,  a = support of A along d,  b = support of B along -d
// D holds the origin iff the cores overlap; a facet of D with outward normal n is a way to part them by
// moving B along n. Private to this folder.
#pragma once

#include "engine/narrowphase/detail.hpp"

namespace rigor::engine {

/// A support point of D and the points of the cores it comes from, frame of A.
template <class S>
struct DifferencePoint {
    typename S::Vec w, a, b;
};

template <class S>
typename S::Real roundingRadius(const Shape<S>& shape) {
    if (const auto* s = std::get_if<Sphere<S>>(&shape)) return s->radius;
    if (const auto* s = std::get_if<Capsule<S>>(&shape)) return s->radius;
    return 0;
}

template <class S>
typename S::Vec coreSupport(const Shape<S>& shape, const typename S::Vec& d) {
    using V = typename S::Vec;
    if (std::holds_alternative<Sphere<S>>(shape)) return V::Zero();
    if (const auto* s = std::get_if<Capsule<S>>(&shape))
        return V((d.y() < 0 ? -s->halfLength : s->halfLength) * V::UnitY());
    return support<S>(shape, d);
}

/// Strictly inside a shape with a volume, in its own frame.
template <class S>
typename S::Vec innerPoint(const Shape<S>& shape);

template <class S>
class Minkowski {
  public:
    using R = typename S::Real;
    using V = typename S::Vec;

    Minkowski(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb) : a_(a), b_(b) {
        const Pose<S> X = relativePose<S>(Xa, Xb);
        rotation_ = toMatrix(X.q);
        translation_ = X.p;
    }

    DifferencePoint<S> point(const V& d) const {
        DifferencePoint<S> p;
        p.a = coreSupport<S>(a_, d);
        p.b = rotation_ * coreSupport<S>(b_, V(-(rotation_.transpose() * d))) + translation_;
        p.w = p.a - p.b;
        return p;
    }
    const Shape<S>& shapeA() const { return a_; }
    const Shape<S>& shapeB() const { return b_; }
    /// B's frame in the frame of A.
    const typename S::Mat& rotation() const { return rotation_; }
    const V& translation() const { return translation_; }
    /// Inside D, where either shape has a volume.
    V innerPoint() const {
        return engine::innerPoint<S>(a_) - (rotation_ * engine::innerPoint<S>(b_) + translation_);
    }

  private:
    const Shape<S>& a_;
    const Shape<S>& b_;
    typename S::Mat rotation_;
    V translation_;
};

/// Simplex of up to dim + 1 points of D with the weights of their point nearest to the origin; for EPA, of
/// the facet.
template <class S>
struct Simplex {
    std::array<DifferencePoint<S>, S::dim + 1> points;
    std::array<typename S::Real, S::dim + 1> weights{};
    int count = 0;

    typename S::Vec onA() const {
        typename S::Vec x = S::Vec::Zero();
        for (int i = 0; i < count; ++i) x += weights[i] * points[i].a;
        return x;
    }
    typename S::Vec onB() const {
        typename S::Vec x = S::Vec::Zero();
        for (int i = 0; i < count; ++i) x += weights[i] * points[i].b;
        return x;
    }
};

/// Drops the points that the nearest point to `target` does not need, sets the weights and returns the vector
/// from target to the nearest point. If dim + 1 points are left, the target is inside and the vector is zero.
template <class S>
typename S::Vec reduceSimplex(Simplex<S>& simplex, const typename S::Vec& target);

/// Result of an algorithm for two cores, in the frame of A.
template <class S>
struct CoreContact {
    typename S::Vec normal;         ///< unit, A to B
    typename S::Real distance = 0;  ///< [m]; < 0: minus the depth
    typename S::Vec onA, onB;       ///< points on the cores; onB - onA = distance * normal
    int iterations = 0;             ///< support points computed
    bool converged = false;
};
/// Closest points of the cores by GJK, and by EPA where the cores overlap.
template <class S>
CoreContact<S> closestCores(const Minkowski<S>& D);

/// Follows the normal to a minimum of the support of D, to rounding, where one of the shapes is an ellipsoid
/// (3d/curved_normal.cpp). Other contacts stay as they are, and those of 2D.
template <class R>
void refineCurved(const Minkowski<Space<R, 3>>& D, CoreContact<Space<R, 3>>& contact);
template <class R>
void refineCurved(const Minkowski<Space<R, 2>>&, CoreContact<Space<R, 2>>&) {}

/// Puts the penetration vector that `last`, the normal of the last step (frame of A), leads to in the place
/// of the contact's, where that one is no shorter than by kKeep of the smaller shape (keep_normal.cpp).
template <class S>
void keepNormal(const Shape<S>& a, const Shape<S>& b, const Minkowski<S>& D, const typename S::Vec& last,
                CoreContact<S>& contact);

/// Contact points along a known normal: the two faces (edges, segments) of the shapes that support it, one
/// clipped to the other where they are nearly flat against each other, and always the deepest point. Fills
/// `out` in the frame of A; `a` and `b` are the shapes of D.
template <class R>
void featureManifold(const Shape<Space<R, 2>>& a, const Shape<Space<R, 2>>& b,
                     const Minkowski<Space<R, 2>>& D, const CoreContact<Space<R, 2>>& contact, R speculative,
                     Manifold<Space<R, 2>>& out);
template <class R>
void featureManifold(const Shape<Space<R, 3>>& a, const Shape<Space<R, 3>>& b,
                     const Minkowski<Space<R, 3>>& D, const CoreContact<Space<R, 3>>& contact, R speculative,
                     Manifold<Space<R, 3>>& out);

/// Cosine of the largest angle between the contact normal and a face's own for which the face takes part:
/// 2.5 degrees.
template <class R>
inline constexpr R kFlatFeature = R(0.999);

/// The deepest point of a contact where no other point is as deep: features that touch in a point have it
/// alone.
template <class S>
void addDeepest(const CoreContact<S>& contact, typename S::Real rA, typename S::Real rB,
                typename S::Real tolerance, Manifold<S>& out) {
    using R = typename S::Real;
    const R separation = contact.distance - rA - rB;
    for (int i = 0; i < out.count; ++i)
        if (out.points[i].separation <= separation + tolerance) return;
    if (out.count == S::maxManifoldPoints) --out.count;
    addPoint<S>(out, contact.onA + rA * contact.normal, contact.onB - rB * contact.normal, separation,
                crossingFeature(0, 1));
}

template <class S>
struct GjkResult {
    Simplex<S> simplex;  ///< its weighted point is v
    typename S::Vec v;   ///< the nearest point; zero where the origin is inside or on D
    bool overlap = false;
    bool converged = false;
    int iterations = 0;
};
/// Point of D nearest to the origin.
template <class S>
GjkResult<S> gjk(const Minkowski<S>& D, const typename S::Vec& start);

template <class S>
struct EpaResult {
    typename S::Vec normal;  ///< unit, outward of D, A to B
    typename S::Real depth;  ///< support of D along the normal: >= the true depth, attained at the optimum
    Simplex<S> simplex;      ///< its weighted point is depth * normal
    bool flat = false;       ///< D has no volume: the simplex is not set
    bool converged = false;
    int iterations = 0;
};
/// The direction in which the support of D is least, D holding the origin or having it near its surface.
template <class R>
EpaResult<Space<R, 2>> epa(const Minkowski<Space<R, 2>>& D);
template <class R>
EpaResult<Space<R, 3>> epa(const Minkowski<Space<R, 3>>& D);

}  // namespace rigor::engine
