// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Block Gauss-Seidel on velocities: projected Gauss-Seidel (pgs.cpp) whose unit is not the row but everything
// that acts between two bodies, and all joints together. Kernels: sequential_impulses.hpp; source
// [Catto2005], [Catto2009]. Differences:
//   - the contacts between two bodies are a group that is swept until it is nearly solved before the next one
//     is solved: a box then meets its neighbours without the rotation that solving its corners one by one
//     would leave it with, which is what makes tall stacks rock;
//   - iterations go forwards and backwards in turn, so that weight travels down a stack as fast as up;
//   - all joints are a group too, whose equality blocks are solved at once (joint_group.hpp); the normal goes
//     before the tangents, so that friction has this sweep's limit;
//   - what the iterations allowed, at least kFinishIterations, leave of a problem of at most kFinishRows rows
//     is handed to Newton's method (newton_finish.hpp), with friction on the exact cone. Heavy boxes on light
//     ones are then solved to rounding.
//
// Cost: iterations * rows * (1..kInnerSweeps). Known limit: contacts converge linearly, slowly for large mass
// ratios, where there are more rows than that.
#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/methods/newton_finish.hpp"
#include "engine/solvers/natural_map.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
class BlockGaussSeidel final : public Solver<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<BlockGaussSeidel>(*this); }

    void useThreads(const Tasks& tasks) override { tasks_ = &tasks; }

    void solve(const SolverInput<S>& input) override {
        applyWarmStart<S>(input);
        findGroups(input.constraints.blocks);
        orderGroups(input);
        joints_.begin(input.constraints);
        for (int i = 0; i < input.iterations; ++i) {
            input.monitor.before(input.velocities);
            const Real change = sweeps_.template largest<Real>(i % 2 != 0, [&](std::size_t group) {
                return solveGroup(input, groups_[group], groups_[group + 1]);
            });
            if (input.monitor.after(input.velocities, change)) break;
        }
        finish(input);
    }

  private:
    static bool isJoint(const Block<S>& block) { return block.kind != BlockKind::Contact; }

    /// Newton's method solves what sweeps leave of a small problem.
    void finish(const SolverInput<S>& input) {
        const std::size_t n = input.constraints.rows.size();
        const Real tolerance = input.monitor.tolerance();
        if (n == 0 || n > kFinishRows || !(tolerance > 0) || input.iterations < kFinishIterations) return;
        if (input.friction != &frictionCone<Real>) return;
        const Real residual = renewedResidual(input);
        const Real goal = std::max(tolerance, velocityResolution<S>(input.constraints, input.velocities));
        if (residual <= goal) return;
        newton_.forget();
        const Real reached = newton_.attempt(input, residual, goal, kFinishSteps);
        if (reached < residual) input.monitor.after(input.velocities, reached);
    }

    /// Consecutive contact blocks between the same two bodies form a group; so do all consecutive joints.
    void findGroups(const std::vector<Block<S>>& blocks) {
        groups_.clear();
        for (std::uint32_t i = 0; i < blocks.size(); ++i) {
            const bool joins =
                i > 0 && isJoint(blocks[i]) == isJoint(blocks[i - 1]) &&
                (isJoint(blocks[i]) || (blocks[i].a == blocks[i - 1].a && blocks[i].b == blocks[i - 1].b));
            if (!joins) groups_.push_back(i);
        }
        groups_.push_back(static_cast<std::uint32_t>(blocks.size()));
    }

    void orderGroups(const SolverInput<S>& input) {
        constexpr std::size_t kGrain = 8;  // a group takes some 2 us, handing out a part 0.3 us
        sweeps_.begin(*tasks_, input.velocities.size(), kGrain);
        for (std::size_t k = 0; k + 1 < groups_.size(); ++k)
            sweeps_.add<S>({input.constraints.blocks.data() + groups_[k], groups_[k + 1] - groups_[k]});
        sweeps_.finish();
    }

    /// Returns the residual of the group before it was solved.
    Real solveGroup(const SolverInput<S>& input, std::uint32_t first, std::uint32_t last) {
        if (isJoint(input.constraints.blocks[first]))
            return joints_.solve(input.constraints, input.velocities);
        Real found = 0;
        const int sweeps = last - first > 1 ? kInnerSweeps : 1;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Real largest = 0;
            for (std::uint32_t k = 0; k < last - first; ++k) {
                // Always forwards, which measurably calms stacks.
                const Block<S>& block = input.constraints.blocks[first + k];
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                const Real residual = solveNormal(input, block, a, b);
                largest = std::max({largest, residual, solveFriction(input, block, a, b)});
            }
            if (sweep == 0) found = largest;
            if (largest <= kInnerTolerance * found) break;
        }
        return found;
    }

    static constexpr std::size_t kFinishRows = 128;  ///< n^3 / 3 is then less than a millisecond
    static constexpr int kFinishSteps = 12;
    static constexpr int kFinishIterations = 30;         ///< fewer than that are too few to sort contacts by
    static constexpr int kInnerSweeps = 10;              ///< maximum number of sweeps per solve of a group
    static constexpr Real kInnerTolerance = Real(0.01);  ///< relative to the first sweep's residual
    const Tasks* tasks_ = &Tasks::one();
    std::vector<std::uint32_t> groups_;
    SweepOrder sweeps_;
    JointGroup<S> joints_;
    NewtonFinish<S> newton_;
};

}  // namespace

SolverTraits makeBlockTraits() {
    return {};
}

template <class S>
std::unique_ptr<Solver<S>> makeBlock() {
    return std::make_unique<BlockGaussSeidel<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeBlock, Solver);

}  // namespace rigor::engine
