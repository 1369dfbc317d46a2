// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sequential impulses, the whole method: what is done with one row or block, then a sweep over all of them, then
// the solver that is nothing else (RowByRow: pgs, pgs_soft and tgs_soft are it in three styles). Other methods
// use the kernels. A kernel finds the impulse that satisfies its equation alone at the velocities that the others
// have led to, applies the increment to the velocities, adds it to the accumulated impulse, and returns the
// velocity error it has removed [m/s or rad/s]:
//     joint     lambda += -K^-1 (J v + bias + softness lambda)
//     bounded   lambda := clamp(lambda - (J v + bias + softness lambda) / K, lower, upper)
//     normal    lambda_n := max(0, lambda_n - (J_n v + bias + softness lambda_n) / K_nn)
//     friction  lambda_t := friction law on J_t v + bias with limit mu lambda_n, both tangents at once
//     moment    lambda_m := Coulomb's law on J_m v + bias with limit rho lambda_n, both rows of a block at once
// It is the accumulated impulse that is clamped, not its increment [Catto2005].
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/solvers/solver.hpp"
#include "engine/solvers/sweep_order.hpp"

namespace rigor::engine {

/// J v + bias + softness lambda: zero where an unbounded row is satisfied.
template <class S>
[[gnu::always_inline]] inline typename S::Real rowError(const Row<S>& row, const Velocity<S>& a,
                                                        const Velocity<S>& b) {
    return rowVelocity<S>(row, a, b) + row.bias + row.softness * row.impulse;
}

/// A bounded row, given the velocities of its bodies.
template <class S>
typename S::Real satisfyBoundedRow(Row<S>& row, const Block<S>& block, Velocity<S>& a, Velocity<S>& b) {
    using Real = typename S::Real;
    const Real error = rowError<S>(row, a, b);
    const Real accumulated = std::clamp(row.impulse - row.invK * error, row.lower, row.upper);
    const Real step = accumulated - row.impulse;
    row.impulse = accumulated;
    applyRowImpulse<S>(row, block, step, a, b);
    return row.invK > 0 ? std::abs(step) / row.invK : Real(0);
}

/// All rows of a joint at once.
template <class S>
typename S::Real satisfyJointBlock(ConstraintRows<S>& constraints, const Block<S>& block, Velocity<S>& a,
                                   Velocity<S>& b) {
    Row<S>* rows = constraints.rows.data() + block.first;
    BlockVector<S> error(block.rows);
    for (int i = 0; i < block.rows; ++i) error[i] = rowError<S>(rows[i], a, b);
    const BlockVector<S> lambda = -(constraints.matrices[block.matrix] * error);
    for (int i = 0; i < block.rows; ++i) {
        rows[i].impulse += lambda[i];
        applyRowImpulse<S>(rows[i], block, lambda[i], a, b);
    }
    return error.cwiseAbs().maxCoeff();
}

template <class S>
typename S::Real solveBoundedRow(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                                 Velocity<S>& b) {
    return satisfyBoundedRow<S>(input.constraints.rows[block.first], block, a, b);
}

template <class S>
typename S::Real solveJointBlock(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                                 Velocity<S>& b) {
    return satisfyJointBlock<S>(input.constraints, block, a, b);
}

/// The rows of a joint one after the other.
template <class S>
typename S::Real solveJointRows(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                                Velocity<S>& b) {
    using Real = typename S::Real;
    Real residual = 0;
    for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
        Row<S>& row = input.constraints.rows[i];
        const Real step = -row.invK * rowError<S>(row, a, b);
        row.impulse += step;
        applyRowImpulse<S>(row, block, step, a, b);
        if (row.invK > 0) residual = std::max(residual, std::abs(step) / row.invK);
    }
    return residual;
}

template <class S>
typename S::Real solveNormal(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                             Velocity<S>& b) {
    using Real = typename S::Real;
    Row<S>& normal = input.constraints.rows[block.first];
    const Real error = rowError<S>(normal, a, b);
    const Real accumulated = std::max(Real(0), normal.impulse - normal.invK * error);
    const Real step = accumulated - normal.impulse;
    normal.impulse = accumulated;
    applyRowImpulse<S>(normal, block, step, a, b);
    return std::abs(step) / normal.invK;
}

template <class S>
typename S::Real solveFriction(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                               Velocity<S>& b) {
    using Real = typename S::Real;
    using Vec2 = Eigen::Matrix<Real, 2, 1>;
    if (block.rows < 2) return 0;
    Row<S>* rows = input.constraints.rows.data() + block.first;
    constexpr int tangents = S::tangents;
    Vec2 impulse = Vec2::Zero(), velocity = Vec2::Zero();
    for (int i = 0; i < tangents; ++i) {
        impulse[i] = rows[1 + i].impulse;
        velocity[i] = rowVelocity<S>(rows[1 + i], a, b) + rows[1 + i].bias;
    }
    const Vec2 next = contactFriction<S>(input.friction, block, impulse, velocity, rows[0].impulse);
    Real residual = 0;
    for (int i = 0; i < tangents; ++i) {
        const Real step = next[i] - impulse[i];
        rows[1 + i].impulse = next[i];
        applyRowImpulse<S>(rows[1 + i], block, step, a, b);
        residual = std::max(residual, std::abs(step) / rows[1 + i].invK);
    }
    return residual;
}

/// Rolling or torsional friction. The world's friction law is that of sliding; this is the exact disc.
template <class S>
typename S::Real solveMoment(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                             Velocity<S>& b) {
    using Real = typename S::Real;
    using Vec2 = Eigen::Matrix<Real, 2, 1>;
    Row<S>* rows = input.constraints.rows.data() + block.first;
    Vec2 impulse = Vec2::Zero(), velocity = Vec2::Zero();
    for (int i = 0; i < block.rows; ++i) {
        impulse[i] = rows[i].impulse;
        velocity[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias;
    }
    const Real limit = block.friction * (input.constraints.rows[block.normal].impulse + block.appliedNormal);
    const Vec2 next = frictionCone<Real>(block.k11, block.k12, block.k22, impulse, velocity, limit);
    Real residual = 0;
    for (int i = 0; i < block.rows; ++i) {
        const Real step = next[i] - impulse[i];
        rows[i].impulse = next[i];
        applyRowImpulse<S>(rows[i], block, step, a, b);
        residual = std::max(residual, std::abs(step) / rows[i].invK);
    }
    return residual;
}

/// Order of the contacts' impulses: the later ones have priority.
enum class ContactOrder : std::uint8_t {
    FrictionFirst,  ///< contact by contact, its normal
    FrictionLast,   ///< the friction of all contacts after everything else
};

/// Sweeps over all blocks in their order. Consecutive blocks between the same two bodies, which depend on
/// each other anyway, are one unit of the order.
template <class S>
class BlockSweeps {
  public:
    using Real = typename S::Real;

    /// Threads of the sweeps from the next begin() on.
    void useThreads(const Tasks& tasks) { tasks_ = &tasks; }
    void begin(const SolverInput<S>& input) {
        const std::vector<Block<S>>& blocks = input.constraints.blocks;
        starts_.clear();
        for (std::uint32_t k = 0; k < blocks.size(); ++k)
            if (k == 0 || blocks[k].a != blocks[k - 1].a || blocks[k].b != blocks[k - 1].b)
                starts_.push_back(k);
        starts_.push_back(static_cast<std::uint32_t>(blocks.size()));
        constexpr std::size_t kGrain = 32;  // a unit takes some 0.3 us, handing out a part as much
        order_.begin(*tasks_, input.velocities.size(), kGrain);
        for (std::size_t u = 0; u + 1 < starts_.size(); ++u)
            order_.add<S>({blocks.data() + starts_[u], starts_[u + 1] - starts_[u]});
        order_.finish();
    }
    /// The largest result of Real solveBlock(block index), or zero.
    template <class SolveBlock>
    Real largest(const SolveBlock& solveBlock) {
        return order_.template largest<Real>(false, [&](std::size_t unit) {
            Real most = 0;
            for (std::size_t k = starts_[unit]; k < starts_[unit + 1]; ++k)
                most = std::max(most, solveBlock(k));
            return most;
        });
    }

  private:
    const Tasks* tasks_ = &Tasks::one();
    SweepOrder order_;
    std::vector<std::uint32_t> starts_;  ///< first block of each unit
};

/// Projected Gauss-Seidel: iterations over all rows, one after the other. `sweeps` is scratch.
template <class S>
void solveRowByRow(const SolverInput<S>& input, ContactOrder order, BlockSweeps<S>& sweeps) {
    using Real = typename S::Real;
    applyWarmStart<S>(input);
    sweeps.begin(input);
    const std::vector<Block<S>>& blocks = input.constraints.blocks;
    const auto solve = [&input](auto kernel, const Block<S>& block) -> Real {
        return kernel(input, block, input.velocities[block.a], input.velocities[block.b]);
    };
    const auto solveBlock = [&](std::size_t k) -> Real {
        if (blocks[k].kind == BlockKind::Joint) return solve(solveJointRows<S>, blocks[k]);
        if (blocks[k].kind == BlockKind::Bounded) return solve(solveBoundedRow<S>, blocks[k]);
        if (blocks[k].kind == BlockKind::Moment)
            return order == ContactOrder::FrictionFirst ? solve(solveMoment<S>, blocks[k]) : Real(0);
        const Real friction =
            order == ContactOrder::FrictionFirst ? solve(solveFriction<S>, blocks[k]) : Real(0);
        return std::max(friction, solve(solveNormal<S>, blocks[k]));
    };
    const auto solveBlockFriction = [&](std::size_t k) -> Real {
        if (blocks[k].kind == BlockKind::Moment) return solve(solveMoment<S>, blocks[k]);
        return blocks[k].kind == BlockKind::Contact ? solve(solveFriction<S>, blocks[k]) : Real(0);
    };
    for (int i = 0; i < input.iterations; ++i) {
        input.monitor.before(input.velocities);
        Real change = sweeps.largest(solveBlock);
        if (order == ContactOrder::FrictionLast)
            change = std::max(change, sweeps.largest(solveBlockFriction));
        if (input.monitor.after(input.velocities, change)) break;
    }
}

/// A solver that is nothing but those sweeps, in an order and in a style.
template <class S>
class RowByRow final : public Solver<S> {
  public:
    explicit RowByRow(ContactOrder order, const SolverStyle<S>& style = {}) : order_(order), style_(style) {}
    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<RowByRow>(*this); }
    SolverStyle<S> style() const override { return style_; }
    void useThreads(const Tasks& tasks) override { sweeps_.useThreads(tasks); }
    void solve(const SolverInput<S>& input) override { solveRowByRow(input, order_, sweeps_); }

  private:
    ContactOrder order_;
    SolverStyle<S> style_;
    BlockSweeps<S> sweeps_;
};

}  // namespace rigor::engine
