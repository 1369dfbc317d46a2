// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Friction pyramid: one Gauss-Seidel sweep over the two tangents, each impulse clamped to [-mu lambda_n,
// mu lambda_n] on its own. Diagonal to the tangents it allows up to sqrt(2) times Coulomb's friction, and it
// does not oppose the slip there. The common simplification of game physics, here for comparison.
#include <algorithm>

#include "engine/math/space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

FrictionTraits frictionPyramidTraits() {
    return {FrictionShape::Box};
}

template <class R>
Eigen::Matrix<R, 2, 1> frictionPyramid(R k11, R k12, R k22, const Eigen::Matrix<R, 2, 1>& impulse,
                                       const Eigen::Matrix<R, 2, 1>& velocity, R limit) {
    Eigen::Matrix<R, 2, 1> lambda;
    lambda[0] = std::clamp(impulse[0] - velocity[0] / k11, -limit, limit);
    const R v2 = velocity[1] + k12 * (lambda[0] - impulse[0]);
    lambda[1] = std::clamp(impulse[1] - v2 / k22, -limit, limit);
    return lambda;
}
template Eigen::Vector2f frictionPyramid(float, float, float, const Eigen::Vector2f&, const Eigen::Vector2f&,
                                         float);
template Eigen::Vector2d frictionPyramid(double, double, double, const Eigen::Vector2d&,
                                         const Eigen::Vector2d&, double);

}  // namespace rigor::engine
