// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/natural_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solvers/matrix_space.hpp"

namespace rigor::engine {

template <class R>
Eigen::Matrix<R, 3, 1> projectOnCone(const Eigen::Matrix<R, 3, 1>& r, R mu) {
    const R n = r[0], t = std::sqrt(r[1] * r[1] + r[2] * r[2]);
    if (mu * t <= -n) return Eigen::Matrix<R, 3, 1>::Zero();
    if (t <= mu * n) return r;
    const R onAxis = (n + mu * t) / (R(1) + mu * mu);
    const R scale = mu * onAxis / t;
    return {onAxis, scale * r[1], scale * r[2]};
}

namespace {

template <class R>
R contactResidual(const Eigen::Matrix<R, 3, 1>& r, const Eigen::Matrix<R, 3, 1>& w, R mu, R muStatic, R rho) {
    using Vec3 = Eigen::Matrix<R, 3, 1>;
    const R slip = std::sqrt(w[1] * w[1] + w[2] * w[2]);
    const Vec3 shifted(w[0] + mu * slip, w[1], w[2]);
    const R sliding = (r - projectOnCone<R>(r - rho * shifted, mu)).norm() / rho;
    if (!(muStatic > mu)) return sliding;
    const R pull = std::sqrt(r[1] * r[1] + r[2] * r[2]);
    const R sticking =
        std::max({std::abs(w[0]), slip, (pull - muStatic * r[0]) / rho, std::max(R(0), -r[0]) / rho});
    return std::min(sliding, sticking);
}

/// Natural map of a contact with a normal impulse from outside the rows as well (Poisson's expansion), normal
/// and friction separately: 0 <= r_n _|_ w_n >= 0 and the disc |r_t| <= mu (r_n + applied).
template <class R>
R pressedResidual(const Eigen::Matrix<R, 3, 1>& r, const Eigen::Matrix<R, 3, 1>& w, R mu, R muStatic,
                  R applied, R rho) {
    using Vec2 = Eigen::Matrix<R, 2, 1>;
    const R normal = std::abs(r[0] - std::max(R(0), r[0] - rho * w[0])) / rho;
    const Vec2 rt(r[1], r[2]), wt(w[1], w[2]), target = rt - rho * wt;
    const R radius = mu * (r[0] + applied), length = target.norm();
    const Vec2 onDisc = length > radius ? Vec2(target * (radius / length)) : target;
    R friction = (rt - onDisc).norm() / rho;
    if (muStatic > mu)
        friction = std::min(friction, std::max(wt.norm(), (rt.norm() - muStatic * (r[0] + applied)) / rho));
    return std::max(normal, friction);
}

/// Natural map of rolling or torsional friction: the disc |m| <= bound.
template <class S>
typename S::Real momentResidual(const Eigen::Matrix<typename S::Real, 2, 1>& m,
                                const Eigen::Matrix<typename S::Real, 2, 1>& w, typename S::Real bound,
                                typename S::Real rho) {
    using Vec2 = Eigen::Matrix<typename S::Real, 2, 1>;
    const Vec2 target = m - rho * w;
    const typename S::Real length = target.norm();
    return (m - (length > bound ? Vec2(target * (bound / length)) : target)).norm() / rho;
}

template <class S>
typename S::Real rowDefect(const Row<S>& row, const Velocity<S>& a, const Velocity<S>& b) {
    return rowVelocity<S>(row, a, b) + row.bias + row.softness * row.impulse;
}

}  // namespace

template <class S>
typename S::Real blockResidual(const ConstraintRows<S>& constraints, const Block<S>& block,
                               std::span<const Velocity<S>> velocities) {
    using Real = typename S::Real;
    using Vec3 = Eigen::Matrix<Real, 3, 1>;
    const Row<S>* rows = constraints.rows.data() + block.first;
    const Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
    if (block.kind == BlockKind::Joint) {
        Real residual = 0;
        // A row that neither body can follow has no velocity to be wrong.
        for (int i = 0; i < block.rows; ++i)
            if (rows[i].invK > 0) residual = std::max(residual, std::abs(rowDefect<S>(rows[i], a, b)));
        return residual;
    }
    if (block.kind == BlockKind::Bounded) {
        const Row<S>& row = rows[0];
        if (!(row.invK > 0)) return 0;
        const Real next = std::clamp(row.impulse - row.invK * rowDefect<S>(row, a, b), row.lower, row.upper);
        return std::abs(row.impulse - next) / row.invK;
    }
    Vec3 r = Vec3::Zero(), w = Vec3::Zero();
    for (int i = 0; i < block.rows; ++i) {
        r[i] = rows[i].impulse;
        w[i] = rowDefect<S>(rows[i], a, b);
    }
    if (block.kind == BlockKind::Moment) {
        const Real pressed = constraints.rows[block.normal].impulse + block.appliedNormal;
        return momentResidual<S>(r.template head<2>(), w.template head<2>(),
                                 block.friction * std::max(Real(0), pressed), rows[0].invK);
    }
    return block.appliedNormal > 0
               ? pressedResidual<Real>(r, w, block.friction, block.staticFriction, block.appliedNormal,
                                       rows[0].invK)
               : contactResidual<Real>(r, w, block.friction, block.staticFriction, rows[0].invK);
}

template <class S>
typename S::Real naturalMapResidual(const ConstraintRows<S>& constraints,
                                    std::span<const Velocity<S>> velocities) {
    using Real = typename S::Real;
    Real largest = 0;
    for (const Block<S>& block : constraints.blocks) {
        const Real residual = blockResidual<S>(constraints, block, velocities);
        // A NaN is the largest of all.
        if (!(residual <= largest)) largest = residual;
    }
    return largest;
}

template <class S>
typename S::Real blockResolution(const ConstraintRows<S>& constraints, const Block<S>& block,
                                 std::span<const Velocity<S>> velocities) {
    using Real = typename S::Real;
    const Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
    Real largest = 0;
    for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
        const Row<S>& row = constraints.rows[i];
        const Real moving = rowMotion<S>(row, a, b);
        const Real pushed = row.invK > 0 ? std::abs(row.impulse) / row.invK : Real(0);
        largest = std::max(largest, moving + pushed);
    }
    return Real(32) * std::numeric_limits<Real>::epsilon() * largest;
}

template <class S>
typename S::Real velocityResolution(const ConstraintRows<S>& constraints,
                                    std::span<const Velocity<S>> velocities) {
    using Real = typename S::Real;
    Real largest = 0;
    for (const Block<S>& block : constraints.blocks)
        largest = std::max(largest, blockResolution<S>(constraints, block, velocities));
    return largest;
}

template Eigen::Vector3f projectOnCone(const Eigen::Vector3f&, float);
template Eigen::Vector3d projectOnCone(const Eigen::Vector3d&, double);
#define RIGOR_INSTANTIATE(S)                                                                              \
    template typename S::Real blockResidual(const ConstraintRows<S>&, const Block<S>&,                    \
                                            std::span<const Velocity<S>>);                                \
    template typename S::Real blockResolution(const ConstraintRows<S>&, const Block<S>&,                  \
                                              std::span<const Velocity<S>>);                              \
    template typename S::Real naturalMapResidual(const ConstraintRows<S>&, std::span<const Velocity<S>>); \
    template typename S::Real velocityResolution(const ConstraintRows<S>&, std::span<const Velocity<S>>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
RIGOR_INSTANTIATE(MatrixSpace<2>)
RIGOR_INSTANTIATE(MatrixSpace<3>)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
