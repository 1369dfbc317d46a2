// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Turns of a step as vectors.
#pragma once

#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

/// Rotation from q to p as a vector in world axes, to third order in its angle [rad].
template <class R>
R smallTurn(const Rot2<R>& q, const Rot2<R>& p) {
    return compose(p, inverse(q)).s;
}
template <class R>
Eigen::Matrix<R, 3, 1> smallTurn(const Eigen::Quaternion<R>& q, const Eigen::Quaternion<R>& p) {
    const Eigen::Quaternion<R> turn = compose(p, inverse(q));
    return (turn.w() < R(0) ? R(-2) : R(2)) * turn.vec();
}

/// An impulse of friction turned into the plane of another normal; its size stays.
template <class S>
typename S::Vec turnedInto(const typename S::Vec& normal, const typename S::Vec& friction) {
    const typename S::Vec along = friction - normal.dot(friction) * normal;
    const typename S::Real size = along.norm();
    return size > 0 ? typename S::Vec(along * (friction.norm() / size)) : along;
}

}  // namespace rigor::engine
