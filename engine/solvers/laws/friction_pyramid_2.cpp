// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Friction along one line: two directions, with and against the slip that there would be at this contact
// without its friction. With b that slip velocity and d = b / |b|,
//     lambda = -min(|b| / (d^T K d), mu lambda_n) d
// the cheapest friction in three dimensions: exact where K is a multiple of the identity (a sphere, a point
// on the axis of a box) and where the slip keeps its line; elsewhere it leaves the slip across the line
// alone, so that sticking takes several iterations and the sliding direction is wrong by the anisotropy of K.
#include <algorithm>

#include "engine/math/space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

FrictionTraits frictionPyramid2Traits() {
    return {FrictionShape::Line};
}

template <class R>
Eigen::Matrix<R, 2, 1> frictionPyramid2(R k11, R k12, R k22, const Eigen::Matrix<R, 2, 1>& impulse,
                                        const Eigen::Matrix<R, 2, 1>& velocity, R limit) {
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const Vec2 b(velocity[0] - k11 * impulse[0] - k12 * impulse[1],
                 velocity[1] - k12 * impulse[0] - k22 * impulse[1]);
    const R speed = b.norm();
    if (!(limit > 0) || !(speed > 0)) return Vec2::Zero();
    const Vec2 d = b / speed;
    const R K = k11 * d[0] * d[0] + R(2) * k12 * d[0] * d[1] + k22 * d[1] * d[1];
    return -std::min(speed / K, limit) * d;
}
template Eigen::Vector2f frictionPyramid2(float, float, float, const Eigen::Vector2f&, const Eigen::Vector2f&,
                                          float);
template Eigen::Vector2d frictionPyramid2(double, double, double, const Eigen::Vector2d&,
                                          const Eigen::Vector2d&, double);

}  // namespace rigor::engine
