// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The textbook update by the quaternion's derivative, q' = w q / 2 [Baraff2001, section 2.3]:
//     q := (q + v q / 2) / |q + v q / 2|
// It turns about the right axis by 2 atan(|v| / 2) instead of |v|: short by |v|^3 / 12, hence of order 2 in h
// at a fixed angular velocity, and never by more than half a turn in a step. In 2D the same rotation
// is made from its cosine and sine.
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

template <class R>
Rot2<R> turned(const Rot2<R>& q, R v) {
    const R t = R(0.5) * v, n = R(1) + t * t;
    return normalizedRot(compose(Rot2<R>{(R(1) - t * t) / n, R(2) * t / n}, q));
}
template <class R>
Eigen::Quaternion<R> turned(const Eigen::Quaternion<R>& q, const Eigen::Matrix<R, 3, 1>& v) {
    const Eigen::Quaternion<R> rate = compose(Eigen::Quaternion<R>(R(0), v.x(), v.y(), v.z()), q);
    return normalizedRot(Eigen::Quaternion<R>(q.w() + R(0.5) * rate.w(), q.x() + R(0.5) * rate.x(),
                                              q.y() + R(0.5) * rate.y(), q.z() + R(0.5) * rate.z()));
}

template <class S>
typename S::Rot turnByFirstOrder(const typename S::Rot& q, const typename S::Ang& v) {
    return turned(q, v);
}

}  // namespace

OrientationTraits orientationFirstOrderTraits() {
    return {};
}

template <class S>
TurnRotation<S> orientationFirstOrder() {
    return &turnByFirstOrder<S>;
}
#define RIGOR_INSTANTIATE(S) template TurnRotation<S> orientationFirstOrder<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
