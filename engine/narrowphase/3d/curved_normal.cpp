// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact normals of ellipsoids to rounding, from those of GJK, EPA or MPR, which are off by the square root of it;
// and the closed form against a half-space.
//
// For every unit vector n, phi(n) = max over D of n . w is minus a lower bound of the signed distance of the cores,
// and the least phi is minus the distance itself, apart or overlapping. On the unit sphere, with the support point
// w(n), the tangents T and the second derivative H(n) of the support function,
//     gradient T^T w,  Hessian T^T H T - phi          (Newton: n := n - T (T^T H T - phi)^-1 T^T w, normalised)
// H is the sum of those of A and B:
//     ellipsoid          E^2 / |E n| - (E^2 n)(E^2 n)^T / |E n|^3, E the half axes [m]
//     cylinder and cone  rho (I - u u^T) / |n_xz| across the axis, u = n_xz / |n_xz|
//     polytopes, segments, points: 0 where one vertex supports n
// phi has kinks where an edge or a face of the other shape supports n: there n is across the edge (one tangent is
// left) or the face's own. Which of the features near n it is, nothing but phi decides: each of them, its edges and
// its vertices is tried, and the least phi is kept. As any direction gives a bound, none of them can be wrong.
//
// Cost: a few Newton steps for each part of the supporting feature. Limits: a local method; which of several ways
// out of a deep overlap is the shortest is EPA's decision.
#include <cmath>

#include "engine/narrowphase/3d/feature.hpp"
#include "engine/narrowphase/minkowski.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

template <class R>
using S3 = Space<R, 3>;
template <class R>
using Mat3 = Eigen::Matrix<R, 3, 3>;

/// Rim of a disc across y.
template <class R>
Mat3<R> rimCurvature(R radius, const Vec3<R>& n) {
    const Vec3<R> across(n.x(), 0, n.z());
    const R length = across.norm();
    if (!(length > 0)) return Mat3<R>::Zero();
    const Vec3<R> u = across / length;
    return (radius / length) * (Mat3<R>(Vec3<R>(1, 0, 1).asDiagonal()) - u * u.transpose());
}

/// Second derivative of a core's support function along the unit vector n, in the frame of the shape.
template <class R>
Mat3<R> curvature(const Shape<S3<R>>& shape, const Vec3<R>& n) {
    if (const auto* s = std::get_if<Ellipsoid<S3<R>>>(&shape)) {
        const Vec3<R> e = s->halfAxes.cwiseProduct(n), w = s->halfAxes.cwiseProduct(e);
        const R length = e.norm();
        const Vec3<R> squares = s->halfAxes.cwiseProduct(s->halfAxes);
        return Mat3<R>(squares.asDiagonal()) / length - w * w.transpose() / (length * length * length);
    }
    if (const auto* s = std::get_if<Cylinder<S3<R>>>(&shape)) return rimCurvature<R>(s->radius, n);
    if (const auto* s = std::get_if<Cone<S3<R>>>(&shape)) {
        const bool apex = support<S3<R>>(shape, n).y() > 0;
        return apex ? Mat3<R>(Mat3<R>::Zero()) : rimCurvature<R>(s->radius, n);
    }
    return Mat3<R>::Zero();
}

/// Minimises phi from a start, kept if it is less than the least so far.
template <class R>
class CurvedNormal {
  public:
    using V = Vec3<R>;

    /// phi is flat around its least value: a start that is off by the square root of the rounding may seem less
    /// than what Newton's method finds, and gives way to it.
    CurvedNormal(const Minkowski<S3<R>>& D, const V& start) : D_(D), best_(start) {
        const DifferencePoint<S3<R>> p = D.point(start);
        rounding_ = kRounding<R> * (p.a.norm() + p.b.norm());
        least_ = p.w.dot(start) + rounding_;
    }

    const V& normal() const { return best_; }

    void tryNormal(const V& n) {
        const R phi = D_.point(n).w.dot(n);
        if (!(phi < least_)) return;
        least_ = phi;
        best_ = n;
    }
    /// Newton's method. With `onOther` the other shape is that point of the frame of A, `otherIsA` says which it
    /// is; with `across` the normal stays perpendicular to that unit vector.
    void descend(V n, const V* onOther, bool otherIsA, const V* across) {
        constexpr int kMostSteps = 24, kMostHalvings = 12;
        if (across != nullptr) {
            n -= across->dot(n) * *across;
            if (!(n.norm() > R(0.5))) return;
            n.normalize();
        }
        V w = point(n, onOther, otherIsA);
        R phi = w.dot(n);
        for (int step = 0; step < kMostSteps; ++step) {
            const V turn = newtonStep(n, w, phi, onOther, otherIsA, across);
            const R length = turn.norm();
            if (!(length > R(2) * std::numeric_limits<R>::epsilon())) break;
            // Near the end phi is flat: a step that is no worse than rounding is taken.
            R scale = std::min(R(1), R(0.5) / length);
            V next = n;
            int halving = 0;
            for (; halving < kMostHalvings; ++halving) {
                next = (n + scale * turn).normalized();
                w = point(next, onOther, otherIsA);
                if (w.dot(next) <= phi + rounding_) break;
                scale *= R(0.5);
            }
            if (halving == kMostHalvings) break;
            n = next;
            phi = w.dot(n);
        }
        tryNormal(n);
    }

  private:
    V point(const V& n, const V* onOther, bool otherIsA) const {
        const DifferencePoint<S3<R>> p = D_.point(n);
        if (onOther == nullptr) return p.w;
        return otherIsA ? V(*onOther - p.b) : V(p.a - *onOther);
    }
    Mat3<R> secondDerivative(const V& n, const V* onOther, bool otherIsA) const {
        Mat3<R> H = Mat3<R>::Zero();
        if (onOther == nullptr || !otherIsA) H += curvature<R>(D_.shapeA(), n);
        if (onOther == nullptr || otherIsA) {
            const Mat3<R>& q = D_.rotation();
            H += q * curvature<R>(D_.shapeB(), V(-(q.transpose() * n))) * q.transpose();
        }
        return H;
    }
    V newtonStep(const V& n, const V& w, R phi, const V* onOther, bool otherIsA, const V* across) const {
        const Mat3<R> H = secondDerivative(n, onOther, otherIsA);
        if (across != nullptr) {
            const V t = across->cross(n);
            const R k = t.dot(H * t) - phi;
            const R along = k > 0 ? k : std::abs(k) + std::abs(phi);
            return along > 0 ? V(-(w.dot(t) / along) * t) : V(V::Zero());
        }
        const V t1 = n.unitOrthogonal(), t2 = n.cross(t1);
        R a = t1.dot(H * t1) - phi, b = t1.dot(H * t2), c = t2.dot(H * t2) - phi;
        // A Hessian that is not positive definite gives way to that of a sphere: a step along the gradient.
        if (!(a > 0 && a * c - b * b > 0)) {
            a = c = H.trace() + std::abs(phi);
            b = 0;
        }
        const R det = a * c - b * b;
        if (!(det > 0)) return V::Zero();
        const R g1 = w.dot(t1), g2 = w.dot(t2);
        return -((c * g1 - b * g2) / det) * t1 - ((a * g2 - b * g1) / det) * t2;
    }

    const Minkowski<S3<R>>& D_;
    V best_;
    R least_ = 0, rounding_ = 0;
};

template <class R>
bool isEllipsoid(const Shape<S3<R>>& shape) {
    return std::holds_alternative<Ellipsoid<S3<R>>>(shape);
}
template <class R>
bool isRound(const Shape<S3<R>>& shape) {
    return std::holds_alternative<Cylinder<S3<R>>>(shape) || std::holds_alternative<Cone<S3<R>>>(shape);
}

/// The feature of a shape's core; supportingFeature has the rounding radius in it.
template <class R>
void coreFeature(const Shape<S3<R>>& shape, const Vec3<R>& d, SupportFeature<R>& out) {
    supportingFeature<R>(shape, d, out);
    const R radius = roundingRadius<S3<R>>(shape);
    for (int i = 0; i < out.count; ++i) out.at[static_cast<std::size_t>(i)] -= radius * d;
}

/// Every part of the feature of the shape that is no ellipsoid.
template <class R>
void tryFeature(const Minkowski<S3<R>>& D, bool otherIsA, CurvedNormal<R>& search) {
    using V = Vec3<R>;
    const V start = search.normal();
    const Shape<S3<R>>& other = otherIsA ? D.shapeA() : D.shapeB();
    const auto place = [&](const V& x) { return otherIsA ? x : V(D.rotation() * x + D.translation()); };
    SupportFeature<R> feature;
    coreFeature<R>(other, otherIsA ? start : V(-(D.rotation().transpose() * start)), feature);
    const auto count = static_cast<std::size_t>(feature.count);
    if (count > 2) search.tryNormal(otherIsA ? feature.normal : V(-(D.rotation() * feature.normal)));
    const bool round = isRound<R>(other);
    if (round) search.descend(start, nullptr, otherIsA, nullptr);
    if (round && count > 2) return;  // the points of a rim are on it, its chords are not
    for (std::size_t i = 0; i < count; ++i) {
        const V at = place(feature.at[i]), next = place(feature.at[(i + 1) % count]);
        if (!round) search.descend(start, &at, otherIsA, nullptr);
        if (round && std::abs(feature.at[i].x()) + std::abs(feature.at[i].z()) == 0)
            search.descend(start, &at, otherIsA, nullptr);  // the apex
        if (count < 2 || (count == 2 && i == 1)) continue;
        const V along = (next - at).normalized();
        search.descend(start, round ? nullptr : &at, otherIsA, &along);
    }
}

}  // namespace

template <class R>
void refineCurved(const Minkowski<Space<R, 3>>& D, CoreContact<Space<R, 3>>& contact) {
    using V = Vec3<R>;
    const bool curvedA = isEllipsoid<R>(D.shapeA()), curvedB = isEllipsoid<R>(D.shapeB());
    if (!curvedA && !curvedB) return;
    CurvedNormal<R> search(D, contact.normal);
    if (curvedA && curvedB)
        search.descend(contact.normal, nullptr, false, nullptr);
    else
        tryFeature<R>(D, curvedB, search);
    contact.normal = search.normal();
    const DifferencePoint<Space<R, 3>> p = D.point(contact.normal);
    contact.distance = -p.w.dot(contact.normal);
    if (curvedA) {
        contact.onA = p.a;
        contact.onB = V(p.a + contact.distance * contact.normal);
    } else {
        contact.onB = p.b;
        contact.onA = V(p.b - contact.distance * contact.normal);
    }
    contact.converged = true;
}
template void refineCurved<float>(const Minkowski<Space3f>&, CoreContact<Space3f>&);
template void refineCurved<double>(const Minkowski<Space3d>&, CoreContact<Space3d>&);

/// The point of the ellipsoid whose outward normal is -n; its depth is h - |E n|.
template <class R>
void collidePair(const Ellipsoid<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa,
                 const HalfSpace<Space<R, 3>>& b, const Pose<Space<R, 3>>& Xb,
                 typename Space<R, 3>::Real speculative, Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const V n = rotate(Xb.q, b.normal), e = a.halfAxes.cwiseProduct(rotateInverse<R>(Xa.q, n));
    const R reach = e.norm(), separation = n.dot(Xa.p - Xb.p) - b.offset - reach;
    if (separation > speculative) return;
    const V x = toWorld<S>(Xa, V(a.halfAxes.cwiseProduct(e) / -reach));
    out.normal = -n;
    addPoint<S>(out, x, x - separation * n, separation, 0);
}
template void collidePair<float>(const Ellipsoid<Space3f>&, const Pose<Space3f>&, const HalfSpace<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Ellipsoid<Space3d>&, const Pose<Space3d>&, const HalfSpace<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
