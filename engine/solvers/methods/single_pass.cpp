// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The textbook beginner's method: one pass of impulses, here on purpose, so that its failures can be studied.
// Every contact that approaches, and every joint row, gets on its own the impulse that satisfies it at the
// velocity found when its turn comes [Hecker1997]:
//     joint     lambda = -(J v + bias) / K
//     contact   lambda_n = -(J_n v + bias) / K_nn   where that is > 0, else no impulse
//               lambda_t along the slip, |lambda_t| <= mu lambda_n
//     moment    lambda_m against the rolling or the spin, |lambda_m| <= rho lambda_n
// No matrix, no warm start, no memory: more passes (velocity_iterations) apply more such impulses, each
// clamped on its own. Overlap is left to the position correction chosen beside it.
//
// Why it fails:
//   - an impulse undoes what the one before it did, and nothing comes back to repair that: only the bottom of
//     a stack in the order of the sweep feels the load above it in the same step. The rest falls on by a part
//     of g h each step, sinks into its support and is pushed out again: jitter, then collapse;
//   - clamping each pass's impulse to lambda >= 0, and not the sum over the passes, means that an impulse too
//     large can never be taken back: corners of a box solved in turn leave it spinning, and more passes do
//     not converge to the answer;
//   - friction is limited by the normal impulse of this pass alone, which for resting contacts is what
//     is left of g h after the neighbours' impulses: stacks slide apart.
// It is exact where nothing couples: one contact or joint row per body and step, so for a bouncing sphere it
// cannot be distinguished from the others. Measured (pipeline/tests/solver_test.cpp): a stack of five boxes
// collapses whatever corrects its positions; a box slides on a slope that holds it; a pendulum on two rows
// loses most of its energy.
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makeSinglePassTraits() {
    return {.iterations = 1, .warmStarts = false};
}

namespace {

template <class S>
class SinglePass final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<SinglePass>(*this); }

    SolverStyle<S> style() const override { return styleOf<S>(makeSinglePassTraits()); }

    void useThreads(const Tasks& tasks) override { sweeps_.useThreads(tasks); }

    void solve(const SolverInput<S>& input) override {
        if (!input.warmStarted)
            for (Row<S>& row : input.constraints.rows) row.impulse = 0;
        sweeps_.begin(input);
        normals_.resize(input.constraints.rows.size());
        for (int pass = 0; pass < input.iterations; ++pass) {
            input.monitor.before(input.velocities);
            std::fill(normals_.begin(), normals_.end(), Real(0));
            const Real change = sweeps_.largest([&](std::size_t k) {
                const Block<S>& block = input.constraints.blocks[k];
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                return block.kind == BlockKind::Contact  ? solveContact(input, block, a, b)
                       : block.kind == BlockKind::Joint  ? solveJointRows(input, block, a, b)
                       : block.kind == BlockKind::Moment ? solveMoment(input, block, a, b)
                                                         : solveBounded(input, block, a, b);
            });
            if (input.monitor.after(input.velocities, change)) break;
        }
    }

  private:
    /// Solves a limit, motor or spring row: its bounds hold for the impulse of this pass.
    static Real solveBounded(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                             Velocity<S>& b) {
        Row<S>& row = input.constraints.rows[block.first];
        const Real lambda = std::clamp(-row.invK * rowError<S>(row, a, b), row.lower, row.upper);
        row.impulse += lambda;
        applyRowImpulse<S>(row, block, lambda, a, b);
        return row.invK > 0 ? std::abs(lambda) / row.invK : Real(0);
    }

    Real solveContact(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a, Velocity<S>& b) {
        Row<S>* rows = input.constraints.rows.data() + block.first;
        const Real error = rowVelocity<S>(rows[0], a, b) + rows[0].bias;
        if (!(error < 0)) return 0;
        const Real lambda = -rows[0].invK * error;
        rows[0].impulse += lambda;
        normals_[block.first] = lambda;
        applyRowImpulse<S>(rows[0], block, lambda, a, b);
        if (block.rows > 1) solveFriction(input, block, rows, lambda, a, b);
        return -error;
    }

    /// Solves the friction of a contact, limited by the normal impulse of this pass.
    static void solveFriction(const SolverInput<S>& input, const Block<S>& block, Row<S>* rows, Real normal,
                              Velocity<S>& a, Velocity<S>& b) {
        using Vec2 = Eigen::Matrix<Real, 2, 1>;
        Vec2 velocity = Vec2::Zero();
        for (int i = 0; i < S::tangents; ++i)
            velocity[i] = rowVelocity<S>(rows[1 + i], a, b) + rows[1 + i].bias;
        const Vec2 lambda = contactFriction<S>(input.friction, block, Vec2::Zero(), velocity, normal);
        for (int i = 0; i < S::tangents; ++i) {
            rows[1 + i].impulse += lambda[i];
            applyRowImpulse<S>(rows[1 + i], block, lambda[i], a, b);
        }
    }

    /// Solves rolling or torsional friction, limited by the normal impulse of its contact in this pass.
    Real solveMoment(const SolverInput<S>& input, const Block<S>& block, Velocity<S>& a,
                     Velocity<S>& b) const {
        using Vec2 = Eigen::Matrix<Real, 2, 1>;
        const Real normal = normals_[block.normal];
        if (!(normal > 0)) return 0;
        Row<S>* rows = input.constraints.rows.data() + block.first;
        Vec2 velocity = Vec2::Zero();
        for (int i = 0; i < block.rows; ++i) velocity[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias;
        const Vec2 lambda = frictionCone<Real>(block.k11, block.k12, block.k22, Vec2::Zero(), velocity,
                                               block.friction * (normal + block.appliedNormal));
        Real change = 0;
        for (int i = 0; i < block.rows; ++i) {
            rows[i].impulse += lambda[i];
            applyRowImpulse<S>(rows[i], block, lambda[i], a, b);
            change = std::max(change, std::abs(lambda[i]) / rows[i].invK);
        }
        return change;
    }

    BlockSweeps<S> sweeps_;
    std::vector<Real> normals_;  ///< impulse of each normal row in this pass
};

}  // namespace

template <class S>
std::unique_ptr<Solver<S>> makeSinglePass() {
    return std::make_unique<SinglePass<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSinglePass, Solver);
RIGOR_INSTANTIATE_ON_MATRIX(makeSinglePass);

}  // namespace rigor::engine
