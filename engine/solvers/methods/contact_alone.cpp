// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/contact_alone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::engine {

template <class R>
Eigen::Matrix<R, 2, 1> frictionCone(R, R, R, const Eigen::Matrix<R, 2, 1>&, const Eigen::Matrix<R, 2, 1>&, R);

namespace {

template <class R>
using Vec2 = Eigen::Matrix<R, 2, 1>;
template <class R>
using Vec3 = Eigen::Matrix<R, 3, 1>;
template <class R>
using Mat3 = Eigen::Matrix<R, 3, 3>;

/// r_t(alpha) of a slipping contact, and f(alpha) = |r_t| - mu r_n with its derivative.
template <class R>
struct Slip {
    R s11, s12, s22;  ///< S
    Vec2<R> beta, c;  ///< c = W_tn
    R wn, bn, mu;
    R applied;  ///< normal impulse in addition to r_n that bounds the friction
    Vec2<R> rt = Vec2<R>::Zero();
    R rn = 0, slope = 0;

    Vec2<R> solve(R alpha, const Vec2<R>& rhs) const {
        const R a = s11 + alpha, d = s22 + alpha, determinant = a * d - s12 * s12;
        return {(d * rhs[0] - s12 * rhs[1]) / determinant, (a * rhs[1] - s12 * rhs[0]) / determinant};
    }
    R evaluate(R alpha) {
        rt = solve(alpha, -beta);
        rn = -(bn + c.dot(rt)) / wn;
        const R length = rt.norm();
        const Vec2<R> change = -solve(alpha, rt);
        slope = (length > 0 ? rt.dot(change) / length : R(0)) + mu * c.dot(change) / wn;
        return length - mu * (rn + applied);
    }
};

}  // namespace

template <class R>
Vec3<R> solveContactAlone(const Mat3<R>& W, const Vec3<R>& b, R mu, R muStatic, R applied) {
    if (applied > 0) {
        const auto open = [&](R limit) {
            return frictionCone<R>(W(1, 1), W(1, 2), W(2, 2), Vec2<R>::Zero(), Vec2<R>(b[1], b[2]), limit);
        };
        Vec2<R> rt = open(muStatic * applied);
        if (rt.norm() > mu * applied && !(rt.norm() < muStatic * applied)) rt = open(mu * applied);
        if (b[0] + W(0, 1) * rt[0] + W(0, 2) * rt[1] >= 0) return {R(0), rt[0], rt[1]};
    } else if (b[0] >= 0) {
        return Vec3<R>::Zero();
    }
    Slip<R> slip;
    slip.applied = applied;
    slip.c = Vec2<R>(W(1, 0), W(2, 0));
    slip.wn = W(0, 0);
    slip.bn = b[0];
    slip.mu = mu;
    if (!(std::max(mu, muStatic) > 0)) return {-b[0] / slip.wn, R(0), R(0)};
    slip.s11 = W(1, 1) - slip.c[0] * slip.c[0] / slip.wn;
    slip.s12 = W(1, 2) - slip.c[0] * slip.c[1] / slip.wn;
    slip.s22 = W(2, 2) - slip.c[1] * slip.c[1] / slip.wn;
    slip.beta = Vec2<R>(b[1], b[2]) - slip.c * (b[0] / slip.wn);

    slip.evaluate(R(0));
    if (slip.rn >= 0 && slip.rt.norm() <= std::max(mu, muStatic) * (slip.rn + applied))
        return {slip.rn, slip.rt[0], slip.rt[1]};
    if (!(mu > 0)) return {-b[0] / slip.wn, R(0), R(0)};
    R low = 0, high = slip.s11 + slip.s22;
    constexpr int kDoublings = 200;  // cover the whole range of the exponent; f(inf) < 0 ends it before
    for (int i = 0; i < kDoublings && slip.evaluate(high) > 0; ++i) {
        low = high;
        high *= R(4);
    }
    R alpha = low > 0 ? std::sqrt(low * high) : R(0.5) * high;
    constexpr int kSteps = 100;  // Newton takes about 5; bisection alone would be done by then too
    for (int i = 0; i < kSteps; ++i) {
        const R f = slip.evaluate(alpha);
        (f > 0 ? low : high) = alpha;
        R next = alpha - f / slip.slope;
        if (!(next > low && next < high)) next = R(0.5) * (low + high);
        const R moved = std::abs(next - alpha);
        alpha = next;
        if (moved <= R(2) * std::numeric_limits<R>::epsilon() * alpha) break;
    }
    slip.evaluate(alpha);
    const R length = slip.rt.norm(), rn = std::max(R(0), slip.rn);
    const R onRim = length > 0 ? mu * (rn + applied) / length : R(0);
    return {rn, onRim * slip.rt[0], onRim * slip.rt[1]};
}

template Eigen::Vector3f solveContactAlone(const Eigen::Matrix3f&, const Eigen::Vector3f&, float, float,
                                           float);
template Eigen::Vector3d solveContactAlone(const Eigen::Matrix3d&, const Eigen::Vector3d&, double, double,
                                           double);

}  // namespace rigor::engine
