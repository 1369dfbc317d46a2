// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Block Gauss-Seidel on velocities: projected Gauss-Seidel (pgs.cpp) whose unit is not the row but everything
// that acts between two bodies, and all joints that are connected. Kernels: sequential_impulses.hpp; source
// [Catto2005], [Catto2009]. Differences:
//   - the contacts between two bodies are a group that is swept until it is nearly solved before the next one
//     is solved: a box then meets its neighbours without the rotation that solving its corners one by one
//     would leave it with, which is what makes tall stacks rock;
//   - iterations go forwards and backwards in turn, so that weight travels down a stack as fast as up;
//   - connected joints are a group too, whose equality blocks are solved at once (joint_group.hpp); the normal goes
//     before the tangents, so that friction has this sweep's limit;
//   - parts of the problem that share no body (independent_parts.hpp) are swept until each of them is solved;
//     what becomes of a part does not depend on the others;
//   - what the iterations allowed, at least kFinishIterations, leave of a part of at most kFinishRows rows
//     is handed to Newton's method (newton_finish.hpp), with friction on the exact cone. Heavy boxes on light
//     ones are then solved to rounding.
//
// Cost: the sum over all parts of iterations * rows * (1..kInnerSweeps). Known limits: contacts converge
// linearly, slowly for large mass ratios, where a part has more rows than that.
#include <limits>
#include <utility>

#include "engine/solvers/independent_parts.hpp"
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
        joints_.begin(input.constraints);
        findGroups(input.constraints.blocks);
        parts_.find<S>(input.constraints.blocks, groups_, input.velocities.size());
        orderGroups(input);
        iterate(input);
        finish(input);
    }

  private:
    static bool isJoint(const Block<S>& block) { return !isOfContact(block.kind); }

    /// Sweeps over all groups but those of parts that are solved.
    void iterate(const SolverInput<S>& input) {
        solved_.assign(parts_.count(), 0);
        found_.resize(groups_.size());
        for (int i = 0; i < input.iterations; ++i) {
            renewBiases(input, i);
            const Real change = sweeps_.template largest<Real>(i % 2 != 0, [&](std::size_t group) {
                const bool solved = solved_[parts_.partOf(group)] != 0;
                return found_[group] =
                           solved ? Real(0) : solveGroup(input, groups_[group], groups_[group + 1]);
            });
            if (input.monitor.after(input.velocities, change)) break;
            if (markSolved(input)) break;
        }
    }

    /// Renews the biases of joints in parts that are not solved yet.
    void renewBiases(const SolverInput<S>& input, int iteration) {
        if (iteration == 0 || parts_.count() == 1) return input.monitor.before(input.velocities);
        blocks_.clear();
        for (std::size_t group = 0; group + 1 < groups_.size(); ++group) {
            if (solved_[parts_.partOf(group)] || !isJoint(input.constraints.blocks[groups_[group]])) continue;
            for (std::uint32_t k = groups_[group]; k < groups_[group + 1]; ++k) blocks_.push_back(k);
        }
        input.monitor.before(input.velocities, blocks_);
    }

    /// A part is solved to the tolerance, or to the rounding of its velocities where that is more: single
    /// precision would make all iterations in every step otherwise. Returns true if all parts are.
    bool markSolved(const SolverInput<S>& input) {
        const Real tolerance = input.monitor.tolerance();
        bool all = true;
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            Real change = 0;
            for (const std::uint32_t group : parts_.units(part)) change = std::max(change, found_[group]);
            solved_[part] = change < tolerance || (tolerance > 0 && mayBeRounding(change) &&
                                                   change < Real(0.25) * resolution(input, part));
            all = all && solved_[part] != 0;
        }
        return all;
    }

    /// False: more than the rounding of 1000 m/s.
    static bool mayBeRounding(Real change) {
        return change < Real(32e3) * std::numeric_limits<Real>::epsilon();
    }

    /// Rounding of the velocities of a part; 0 where it has joints, whose biases are not settled by then.
    Real resolution(const SolverInput<S>& input, std::size_t part) const {
        Real largest = 0;
        for (const std::uint32_t group : parts_.units(part))
            for (std::uint32_t k = groups_[group]; k < groups_[group + 1]; ++k) {
                const Block<S>& block = input.constraints.blocks[k];
                if (isJoint(block)) return 0;
                largest = std::max(largest, blockResolution<S>(input.constraints, block, input.velocities));
            }
        return largest;
    }

    /// Newton's method solves what sweeps leave of small parts.
    void finish(const SolverInput<S>& input) {
        const Real tolerance = input.monitor.tolerance();
        if (!(tolerance > 0) || input.iterations < kFinishIterations) return;
        if (input.friction != &frictionCone<Real>) return;
        bool renewed = false;
        Real worst = -1;
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            if (!collectBlocks(input.constraints.blocks, part)) continue;
            if (!std::exchange(renewed, true)) input.monitor.before(input.velocities);
            Real residual = 0, goal = tolerance;
            for (const std::uint32_t k : blocks_) {
                const Block<S>& block = input.constraints.blocks[k];
                const Real found = blockResidual<S>(input.constraints, block, input.velocities);
                if (!(found <= residual)) residual = found;
                goal = std::max(goal, blockResolution<S>(input.constraints, block, input.velocities));
            }
            if (residual <= goal) continue;
            const Real reached = finishPart(input, residual, goal);
            if (reached < residual) worst = std::max(worst, reached);
        }
        if (worst >= 0) input.monitor.after(input.velocities, worst);
    }

    /// The blocks of a part. False: it has too many rows for Newton's method.
    bool collectBlocks(const std::vector<Block<S>>& blocks, std::size_t part) {
        blocks_.clear();
        std::size_t rows = 0;
        for (const std::uint32_t group : parts_.units(part))
            for (std::uint32_t k = groups_[group]; k < groups_[group + 1]; ++k) {
                rows += blocks[k].rows;
                if (rows > kFinishRows) return false;
                blocks_.push_back(k);
            }
        return true;
    }

    /// Returns the residual reached.
    Real finishPart(const SolverInput<S>& input, Real residual, Real goal) {
        newton_.forget();
        if (parts_.count() == 1) return newton_.attempt(input, residual, goal, kFinishSteps);
        problem_.load(input, blocks_);
        const Real reached = newton_.attempt(problem_.input(), residual, goal, kFinishSteps);
        problem_.store();
        return reached;
    }

    /// Consecutive contact blocks between the same two bodies form a group; so do connected joints.
    void findGroups(const std::vector<Block<S>>& blocks) {
        groups_.clear();
        for (std::uint32_t i = 0; i < blocks.size(); ++i) {
            const bool joins =
                i > 0 && isJoint(blocks[i]) == isJoint(blocks[i - 1]) &&
                (isJoint(blocks[i]) ? joints_.unitOf(i) == joints_.unitOf(i - 1)
                                    : blocks[i].a == blocks[i - 1].a && blocks[i].b == blocks[i - 1].b);
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
            return joints_.solveUnit(joints_.unitOf(first), input.constraints, input.velocities);
        Real found = 0;
        const Real enough =
            std::max(kInnerFloor * input.monitor.tolerance(), std::numeric_limits<Real>::epsilon());
        const int sweeps = last - first > 1 ? kInnerSweeps : 1;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Real largest = 0;
            for (std::uint32_t k = 0; k < last - first; ++k) {
                // Always forwards, which measurably calms stacks.
                const Block<S>& block = input.constraints.blocks[first + k];
                Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
                if (block.kind == BlockKind::Moment) {
                    largest = std::max(largest, solveMoment(input, block, a, b));
                    continue;
                }
                const Real residual = solveNormal(input, block, a, b);
                largest = std::max({largest, residual, solveFriction(input, block, a, b)});
            }
            if (sweep == 0) found = largest;
            if (largest <= std::max(kInnerTolerance * found, enough)) break;
        }
        return found;
    }

    static constexpr std::size_t kFinishRows = 128;  ///< n^3 / 3 is then less than a millisecond
    static constexpr int kFinishSteps = 12;
    static constexpr int kFinishIterations = 30;         ///< fewer than that are too few to sort contacts by
    static constexpr int kInnerSweeps = 10;              ///< maximum number of sweeps per solve of a group
    static constexpr Real kInnerTolerance = Real(0.01);  ///< relative to the first sweep's residual
    static constexpr Real kInnerFloor =
        Real(1e-3);  ///< fraction of the tolerance below which a group stays as it is
    const Tasks* tasks_ = &Tasks::one();
    std::vector<std::uint32_t> groups_;  ///< first block of each group
    IndependentParts parts_;
    std::vector<std::uint8_t> solved_;   ///< flag of each part
    std::vector<Real> found_;            ///< residual of each group before its last solve
    std::vector<std::uint32_t> blocks_;  ///< blocks of a part
    PartProblem<S> problem_;
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
