// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The Space trait: dimension and precision of a world in one type. Code above math/ is written once over
// S = Space<Real, dim> and instantiated for Space2f, Space2d, Space3f and Space3d. The only door to Eigen.
//
// Conventions: right-handed; rotations are active, body to world; in 2D an angular velocity is a scalar about
// +z.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "engine/math/portable.hpp"

#if defined(EIGEN_VECTORIZE_NEON)
namespace Eigen::internal {
/// NEON has vectors of two floats, by which Eigen would add three or six numbers in another order than on x86.
template <int Size>
struct find_best_packet_helper<Size, Packet4f, false> {
    using type = Packet4f;
};
}  // namespace Eigen::internal
#endif

namespace rigor::engine {

/// Rotation in 2D, stored as cosine and sine of its angle; c^2 + s^2 = 1.
template <class R>
struct Rot2 {
    R c = R(1), s = R(0);
    static Rot2 fromAngle(R angle) { return {std::cos(angle), std::sin(angle)}; }
    R angle() const { return portable::atan2(s, c); }
};

template <class R, int D>
struct Space;

template <class R>
struct Space<R, 2> {
    using Real = R;
    static constexpr int dim = 2;
    static constexpr int maxManifoldPoints = 2;
    using Vec = Eigen::Matrix<R, 2, 1>;
    using Mat = Eigen::Matrix<R, 2, 2>;
    using Ang = R;      ///< angular velocity, torque, angular impulse about +z
    using Inertia = R;  ///< [kg m^2] about +z
    using Rot = Rot2<R>;
    static constexpr int tangents = 1;  ///< tangent directions of a contact
};

template <class R>
struct Space<R, 3> {
    using Real = R;
    static constexpr int dim = 3;
    static constexpr int maxManifoldPoints = 4;
    using Vec = Eigen::Matrix<R, 3, 1>;
    using Mat = Eigen::Matrix<R, 3, 3>;
    using Ang = Eigen::Matrix<R, 3, 1>;
    using Inertia = Eigen::Matrix<R, 3, 3>;
    using Rot = Eigen::Quaternion<R>;
    static constexpr int tangents = 2;
};

using Space2f = Space<float, 2>;
using Space2d = Space<double, 2>;
using Space3f = Space<float, 3>;
using Space3d = Space<double, 3>;

/// Rigid transform x_W = p + q x_B.
template <class S>
struct Pose {
    typename S::Vec p = S::Vec::Zero();
    typename S::Rot q = identityRot();
    static typename S::Rot identityRot() {
        if constexpr (S::dim == 2)
            return {};
        else
            return S::Rot::Identity();
    }
};

// --- rotations -----------------------------------------------------------------------------------------
template <class R>
Eigen::Matrix<R, 2, 1> rotate(const Rot2<R>& q, const Eigen::Matrix<R, 2, 1>& v) {
    return {q.c * v.x() - q.s * v.y(), q.s * v.x() + q.c * v.y()};
}
template <class R>
Eigen::Matrix<R, 2, 1> rotateInverse(const Rot2<R>& q, const Eigen::Matrix<R, 2, 1>& v) {
    return {q.c * v.x() + q.s * v.y(), -q.s * v.x() + q.c * v.y()};
}
template <class R>
Eigen::Matrix<R, 3, 1> rotate(const Eigen::Quaternion<R>& q, const Eigen::Matrix<R, 3, 1>& v) {
    return q._transformVector(v);
}
template <class R>
Eigen::Matrix<R, 3, 1> rotateInverse(const Eigen::Quaternion<R>& q, const Eigen::Matrix<R, 3, 1>& v) {
    return q.conjugate()._transformVector(v);
}
/// The same of an angular velocity.
template <class R>
R rotateAng(const Rot2<R>&, R w) {
    return w;
}
template <class R>
Eigen::Matrix<R, 3, 1> rotateAng(const Eigen::Quaternion<R>& q, const Eigen::Matrix<R, 3, 1>& w) {
    return rotate(q, w);
}
template <class R>
Rot2<R> compose(const Rot2<R>& a, const Rot2<R>& b) {
    return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
}
template <class R>
Eigen::Quaternion<R> compose(const Eigen::Quaternion<R>& a, const Eigen::Quaternion<R>& b) {
    return a * b;
}
template <class R>
Rot2<R> inverse(const Rot2<R>& q) {
    return {q.c, -q.s};
}
template <class R>
Eigen::Quaternion<R> inverse(const Eigen::Quaternion<R>& q) {
    return q.conjugate();
}
template <class R>
Eigen::Matrix<R, 2, 2> toMatrix(const Rot2<R>& q) {
    Eigen::Matrix<R, 2, 2> m;
    m << q.c, -q.s, q.s, q.c;
    return m;
}
template <class R>
Eigen::Matrix<R, 3, 3> toMatrix(const Eigen::Quaternion<R>& q) {
    return q.toRotationMatrix();
}

// --- poses ---------------------------------------------------------------------------------------------
template <class S>
typename S::Vec toWorld(const Pose<S>& X, const typename S::Vec& v) {
    return X.p + rotate(X.q, v);
}
template <class S>
typename S::Vec toLocal(const Pose<S>& X, const typename S::Vec& v) {
    return rotateInverse<typename S::Real>(X.q, v - X.p);
}
/// X_AC = X_AB X_BC
template <class S>
Pose<S> compose(const Pose<S>& a, const Pose<S>& b) {
    return {toWorld<S>(a, b.p), compose(a.q, b.q)};
}

// --- cross products that mean the same in both dimensions ------------------------------------------------
/// w x r: velocity of a point at r from an axis of angular velocity w.
template <class R>
Eigen::Matrix<R, 2, 1> cross(R w, const Eigen::Matrix<R, 2, 1>& r) {
    return {-w * r.y(), w * r.x()};
}
template <class R>
Eigen::Matrix<R, 3, 1> cross(const Eigen::Matrix<R, 3, 1>& a, const Eigen::Matrix<R, 3, 1>& b) {
    return a.cross(b);
}
/// r x f: moment of a force f at r.
template <class R>
R cross(const Eigen::Matrix<R, 2, 1>& r, const Eigen::Matrix<R, 2, 1>& f) {
    return r.x() * f.y() - r.y() * f.x();
}
/// Inner product of angular quantities.
template <class R>
R dotAng(R a, R b) {
    return a * b;
}
template <class R>
R dotAng(const Eigen::Matrix<R, 3, 1>& a, const Eigen::Matrix<R, 3, 1>& b) {
    return a.dot(b);
}

/// Axis-aligned box in world coordinates [m].
template <class S>
struct Aabb {
    typename S::Vec min, max;
    bool overlaps(const Aabb& o) const {
        return (min.array() <= o.max.array()).all() && (o.min.array() <= max.array()).all();
    }
    bool contains(const Aabb& o) const {
        return (min.array() <= o.min.array()).all() && (o.max.array() <= max.array()).all();
    }
};

}  // namespace rigor::engine

/// Explicit instantiation for every space: of what the macro M makes of it; of a class template.
#define RIGOR_FOR_ALL_SPACES(M) M(Space2f) M(Space2d) M(Space3f) M(Space3d)
#define RIGOR_INSTANTIATE_CLASS(C) \
    template class C<Space2f>;     \
    template class C<Space2d>;     \
    template class C<Space3f>;     \
    template class C<Space3d>;
