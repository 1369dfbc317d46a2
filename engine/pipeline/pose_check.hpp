// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checks of the poses that a caller gives.
#pragma once

#include <cmath>

#include "engine/math/space.hpp"

namespace rigor::engine {

template <class R>
R rotNorm(const Rot2<R>& q) {
    return std::sqrt(q.c * q.c + q.s * q.s);
}
template <class R>
R rotNorm(const Eigen::Quaternion<R>& q) {
    return q.norm();
}
/// Position finite, orientation a unit rotation.
template <class S>
bool validPose(const Pose<S>& X) {
    return X.p.allFinite() && std::abs(rotNorm(X.q) - typename S::Real(1)) < typename S::Real(1e-4);
}

}  // namespace rigor::engine
