// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Coulomb friction of one contact point, exactly: the tangential impulse lambda that maximises dissipation,
//     minimise 1/2 lambda^T K lambda + b^T lambda   subject to |lambda| <= R = mu lambda_n,
// with b the tangential velocity at lambda = 0. Inside the disc v = K lambda + b = 0 (stick); on its rim
// v = -alpha lambda, alpha >= 0: friction opposes slip even where K is not a multiple of the identity, which
// a plain projection of the sticking impulse onto the disc does not give. This is the trust-region problem
// of two dimensions: (K + alpha I) lambda = -b, solved for alpha by Newton's iteration on 1/|lambda| - 1/R,
// which converges monotonically from below the root [MoreSorensen1983, section 3], and gets there in one step.
//
// Cost: 1..3 Newton steps of about 20 flops where the contact slides, none where it sticks.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

FrictionTraits frictionConeTraits() {
    return {FrictionShape::Cone};
}

template <class R>
Eigen::Matrix<R, 2, 1> frictionCone(R k11, R k12, R k22, const Eigen::Matrix<R, 2, 1>& impulse,
                                    const Eigen::Matrix<R, 2, 1>& velocity, R limit) {
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    if (!(limit > 0)) return Vec2::Zero();
    const R b0 = velocity[0] - k11 * impulse[0] - k12 * impulse[1];
    const R b1 = velocity[1] - k12 * impulse[0] - k22 * impulse[1];
    // lambda times the determinant of K + alpha I, first for alpha = 0
    R p0 = k12 * b1 - k22 * b0, p1 = k12 * b0 - k11 * b1;
    R determinant = k11 * k22 - k12 * k12, rim = limit * determinant, length2 = p0 * p0 + p1 * p1;
    if (length2 <= rim * rim) return Vec2(p0, p1) * (R(1) / determinant);
    // The root where K is a multiple of the identity, and near it elsewhere: Newton's method goes from here to
    // its monotone side.
    const R slip2 = b0 * b0 + b1 * b1;
    const R mean = (k11 * b0 * b0 + R(2) * k12 * b0 * b1 + k22 * b1 * b1) / slip2;
    R alpha = std::max(R(0), std::sqrt(slip2) / limit - mean);
    constexpr int kMaxNewton = 20;  // 3 suffice; the bound only ends a loop on non-finite input
    for (int i = 0; i < kMaxNewton; ++i) {
        const R a = k11 + alpha, d = k22 + alpha;
        determinant = a * d - k12 * k12;
        p0 = k12 * b1 - d * b0;
        p1 = k12 * b0 - a * b1;
        length2 = p0 * p0 + p1 * p1;
        rim = limit * determinant;
        // A limit too small for the precision: with alpha beyond all bounds lambda opposes b.
        if (!std::isfinite(rim * rim + length2)) return Vec2(b0, b1) * (-limit / std::sqrt(slip2));
        if (std::abs(length2 - rim * rim) <= R(8) * std::numeric_limits<R>::epsilon() * (rim * rim)) break;
        // d|lambda|^2/d alpha = -2 lambda^T (K + alpha I)^-1 lambda = -2 q / determinant^3
        const R q = d * p0 * p0 - R(2) * k12 * p0 * p1 + a * p1 * p1;
        const R next = std::max(R(0), alpha + length2 * (std::sqrt(length2) - rim) / (q * limit));
        if (next == alpha || (i > 0 && !(next > alpha))) break;
        alpha = next;
    }
    // Rounding may leave it beyond the rim.
    return Vec2(p0, p1) * (limit / std::max(std::sqrt(length2), rim));
}
template Eigen::Vector2f frictionCone(float, float, float, const Eigen::Vector2f&, const Eigen::Vector2f&,
                                      float);
template Eigen::Vector2d frictionCone(double, double, double, const Eigen::Vector2d&, const Eigen::Vector2d&,
                                      double);

}  // namespace rigor::engine
