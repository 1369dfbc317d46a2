// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Extended position-based dynamics of rigid bodies [Mueller2020], in small steps [Macklin2019]. Each sub-step
// of h moves the bodies under forces alone, then puts positions right one constraint after the other, with
// Lagrange multipliers lambda [kg m] that start at zero:
//     d(lambda) = -(C + alpha~ lambda) / (J M^-1 J^T + alpha~)               [Mueller2020, eqs 4-5]
//     x += M^-1 J^T d(lambda)                                                 [eqs 6-9]
// takes as velocities what has moved the bodies, (x - x_start) / h, and ends with a pass over velocities.
//     joints    C as the poses are now, all held rows at once; limits where C < 0
//     springs   C = J dx + h bias with alpha~ = softness: by soft.hpp the implicit spring and damper of the
//               velocity solvers, dx being the motion in this sub-step
//     contacts  C = separation, lambda >= 0; static friction C = J_t dx as far as the friction law goes with
//               the limit mu lambda_n                                        [section 3.5]
//     moments   C = J_m dx, the rolling or spinning of this sub-step, as far as rho lambda_n goes
//     velocity pass [section 3.6]: the normal velocity of contacts with lambda_n > 0 becomes e times the
//               approach, or 0, which takes out what pushing overlap apart has added; sliding friction up to
//               mu lambda_n / h; moments up to rho lambda_n / h; motors within their force; speed out
//               of a limit to 0.
// Deviations: static friction goes up to its limit instead of all or nothing, and the velocity pass counts
// what positions have used, so that the world's friction law holds over both. Normals go before all friction:
// visiting corner by corner, friction holds on to the rotation that the first corner's normal has made and
// the next one's takes back, and stacks walk. The velocity pass is swept until nearly solved: once is not
// enough to take the push out of a box that rests on two corners.
//
// substeps 0 means 20, velocity_iterations (of positions) 0 means 1. Cost per step: substeps * (2..11) * rows
// and a joint evaluation each. No warm starting: lambda starts at zero in every sub-step.
// Known limits (pipeline/tests/solver_test.cpp): forces in a stack are those of a hardly iterated solve, and
// tall stacks keep rocking by centimetres; a load of 100 times the mass squeezes its support out; velocities
// come from positions that end on the constraint, which damps a swing by (w h)^2 / 2 per sub-step, 18 % of a
// pendulum's energy in 10 s.
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makeXpbdTraits() {
    return {.substeps = 20, .iterations = 1, .errors = ErrorHandling::Positions, .warmStarts = false};
}

namespace {

template <class S>
class Xpbd final : public Solver<S> {
  public:
    using Real = typename S::Real;
    using Vec2 = Eigen::Matrix<Real, 2, 1>;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Xpbd>(*this); }

    SolverStyle<S> style() const override { return styleOf<S>(makeXpbdTraits()); }

    /// Row::impulse holds lambda meanwhile.
    void solvePositions(PositionProblem<S>& problem, const SolverInput<S>& input) override {
        for (Row<S>& row : input.constraints.rows) row.impulse = 0;
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            Real change = solveJoints(problem, input);
            change = std::max(change, solveSprings(problem, input));
            for (std::size_t c = 0; c < problem.contactCount(); ++c)
                change = std::max(change, solveNormal(problem, c, input));
            for (std::size_t c = 0; c < problem.contactCount(); ++c)
                change = std::max(change, solveSlip(problem, c, input));
            for (const Block<S>& block : input.constraints.blocks)
                if (block.kind == BlockKind::Moment)
                    change = std::max(change, solveTurn(problem, block, input));
            problem.applyRotations();
            if (input.monitor.after(input.velocities, change / input.h)) break;
        }
        for (Row<S>& row : input.constraints.rows) row.impulse /= input.h;
    }

    void solve(const SolverInput<S>& input) override {
        findActive(input.constraints);
        Real first = 0;
        for (int i = 0; i < std::max(input.iterations, kVelocitySweeps); ++i) {
            input.monitor.before(input.velocities);
            Real change = 0;
            for (std::size_t k = 0; k < active_.size(); ++k) {
                if (!active_[k]) continue;
                const Block<S>& block = input.constraints.blocks[k];
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                if (block.kind == BlockKind::Bounded && !isLimit(input.constraints.rows[block.first])) {
                    change = std::max(change, solveBoundedRow(input, block, a, b));
                    continue;
                }
                if (block.kind != BlockKind::Moment)
                    change = std::max(change, bounce(input.constraints.rows[block.first], block, a, b));
            }
            for (std::size_t k = 0; k < active_.size(); ++k) {
                const Block<S>& block = input.constraints.blocks[k];
                if (!active_[k] || !isOfContact(block.kind)) continue;
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                change = std::max(change, block.kind == BlockKind::Contact ? solveFriction(input, block, a, b)
                                                                           : solveMoment(input, block, a, b));
            }
            if (i == 0) first = change;
            if (input.monitor.after(input.velocities, change) || change <= kSweepTolerance * first) break;
        }
    }

  private:
    static constexpr int kVelocitySweeps = 10;           ///< maximum number of sweeps
    static constexpr Real kSweepTolerance = Real(0.01);  ///< relative to the first sweep's residual

    /// Moves the bodies of a row by what takes its multiplier to `lambda`; returns the error removed.
    static Real moveTo(PositionProblem<S>& problem, const Block<S>& block, const Row<S>& where, Row<S>& held,
                       Real lambda) {
        const Real step = lambda - held.impulse;
        held.impulse = lambda;
        problem.move(block, where, step);
        return where.invK > 0 ? std::abs(step) / where.invK : Real(0);
    }

    Real solveJoints(PositionProblem<S>& problem, const SolverInput<S>& input) {
        Real largest = 0;
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            problem.applyRotations();
            problem.evaluateJoint(j, joint_);
            const int held = joint_.block.rows;
            if (held > 0) {
                BlockVector<S> C(held);
                for (int r = 0; r < held; ++r) C[r] = joint_.row[r].error;
                BlockMatrix<S> inverseK;
                invertBlock<S>(joint_.row.data(), joint_.block, inverseK);
                const BlockVector<S> step = -(inverseK * C);
                for (int r = 0; r < held; ++r) {
                    const auto at = static_cast<std::size_t>(r);
                    Row<S>& row = input.constraints.rows[joint_.velocityRow[at]];
                    moveTo(problem, joint_.block, joint_.row[at], row, row.impulse + step[r]);
                }
                largest = std::max(largest, C.cwiseAbs().maxCoeff());
            }
            for (auto at = static_cast<std::size_t>(held); at < static_cast<std::size_t>(joint_.count);
                 ++at) {
                Row<S>& row = input.constraints.rows[joint_.velocityRow[at]];
                const Real lambda =
                    std::max(Real(0), row.impulse - joint_.row[at].error * joint_.row[at].invK);
                largest = std::max(largest, moveTo(problem, joint_.block, joint_.row[at], row, lambda));
            }
        }
        return largest;
    }

    static bool isSpring(const Row<S>& row) { return row.softness > 0; }
    static bool isLimit(const Row<S>& row) {
        return row.lower == Real(0) && row.upper > std::numeric_limits<Real>::max();
    }

    static Real solveSprings(PositionProblem<S>& problem, const SolverInput<S>& input) {
        Real largest = 0;
        for (const Block<S>& block : input.constraints.blocks) {
            if (block.kind != BlockKind::Bounded) continue;
            Row<S>& row = input.constraints.rows[block.first];
            if (!isSpring(row)) continue;
            const Real error = problem.moved(block, row) + input.h * row.bias + row.softness * row.impulse;
            const Real lambda =
                std::clamp(row.impulse - row.invK * error, input.h * row.lower, input.h * row.upper);
            largest = std::max(largest, moveTo(problem, block, row, row, lambda));
        }
        return largest;
    }

    static Real solveNormal(PositionProblem<S>& problem, std::size_t c, const SolverInput<S>& input) {
        const Block<S>& block = problem.contactBlock(c);
        Row<S>& row = input.constraints.rows[block.first];
        const Real lambda = std::max(Real(0), row.impulse - problem.separation(c) * row.invK);
        return moveTo(problem, block, row, row, lambda);
    }

    /// Static friction: the tangential motion back, as far as the friction law goes.
    static Real solveSlip(PositionProblem<S>& problem, std::size_t c, const SolverInput<S>& input) {
        const Block<S>& block = problem.contactBlock(c);
        Row<S>* rows = input.constraints.rows.data() + block.first;
        if (block.rows < 2) return 0;
        Vec2 lambda = Vec2::Zero(), slip = Vec2::Zero();
        for (int i = 0; i < S::tangents; ++i) {
            lambda[i] = rows[1 + i].impulse;
            slip[i] = problem.moved(block, rows[1 + i]) + input.h * rows[1 + i].bias;
        }
        const Vec2 next = contactFriction<S>(input.friction, block, lambda, slip, rows[0].impulse);
        Real removed = 0;
        for (int i = 0; i < S::tangents; ++i)
            removed = std::max(removed, moveTo(problem, block, rows[1 + i], rows[1 + i], next[i]));
        return removed;
    }

    /// Rolling or torsional friction: the relative rotation of this sub-step back, as far as its bound goes.
    static Real solveTurn(PositionProblem<S>& problem, const Block<S>& block, const SolverInput<S>& input) {
        const Real bound = block.friction * input.constraints.rows[block.normal].impulse;
        if (!(bound > 0)) return 0;
        Row<S>* rows = input.constraints.rows.data() + block.first;
        Vec2 lambda = Vec2::Zero(), turn = Vec2::Zero();
        for (int i = 0; i < block.rows; ++i) {
            lambda[i] = rows[i].impulse;
            turn[i] = problem.moved(block, rows[i]) + input.h * rows[i].bias;
        }
        const Vec2 next = frictionCone<Real>(block.k11, block.k12, block.k22, lambda, turn, bound);
        Real removed = 0;
        for (int i = 0; i < block.rows; ++i)
            removed = std::max(removed, moveTo(problem, block, rows[i], rows[i], next[i]));
        return removed;
    }

    /// Finds the blocks that take part in the velocity pass: contacts and limits that have pushed, motors.
    void findActive(const ConstraintRows<S>& constraints) {
        active_.resize(constraints.blocks.size());
        for (std::size_t k = 0; k < active_.size(); ++k) {
            const Block<S>& block = constraints.blocks[k];
            const Row<S>& row = constraints.rows[block.first];
            const bool motor = block.kind == BlockKind::Bounded && !isLimit(row) && !isSpring(row);
            const Row<S>& pushing = block.kind == BlockKind::Moment ? constraints.rows[block.normal] : row;
            active_[k] = motor || (block.kind != BlockKind::Joint && !isSpring(row) && pushing.impulse > 0);
        }
    }

    /// Normal velocity to that of restitution; the bias of a gap that has been closed has no effect.
    static Real bounce(Row<S>& row, const Block<S>& block, Velocity<S>& a, Velocity<S>& b) {
        const Real error = rowVelocity<S>(row, a, b) + std::min(row.bias, Real(0));
        const Real step = -row.invK * error;
        row.impulse = std::max(Real(0), row.impulse + step);
        applyRowImpulse<S>(row, block, step, a, b);
        return std::abs(error);
    }

    JointPositions<S> joint_;
    std::vector<std::uint8_t> active_;  ///< flag of each block
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makeXpbd() {
    return std::make_unique<Xpbd<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeXpbd, Solver);

}  // namespace rigor::engine
