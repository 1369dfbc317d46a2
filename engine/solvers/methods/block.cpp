// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Block Gauss-Seidel on velocities: projected Gauss-Seidel (pgs.cpp) whose unit is not the row but everything
// that acts between two bodies, and all joints that are connected. Kernels: sequential_impulses.hpp; source
// [Catto2005], [Catto2009]. Differences:
//   - the contacts between two bodies are a group that is swept until it is nearly solved before the next one
//     is solved (contact_group.hpp): a box then meets its neighbours without the rotation that solving its corners one
//     by one would leave it with, which is what makes tall stacks rock. In larger parts that an impact goes through,
//     groups are swept once until the part is nearly solved: more sweeps of a group there cost more than they bring;
//   - iterations go forwards and backwards in turn, so that weight travels down a stack as fast as up, and two of
//     them are a step of conjugate gradients (conjugate_sweeps.hpp) where there are contacts alone;
//   - connected joints are a group too, whose equality blocks are solved at once (joint_group.hpp); the normal goes
//     before the tangents, so that friction has this sweep's limit;
//   - parts of the problem that share no body (independent_parts.hpp) are swept until each of them is solved;
//     what becomes of a part does not depend on the others;
//   - Newton's method (part_finish.hpp), with friction on the exact cone, solves what the iterations allowed, at
//     least kFinishIterations, leave of small parts, and of larger ones that are narrow. Parts of few contacts, and of few
//     contacts and limits of many joints (free_rows.hpp), it solves sooner. Heavy boxes on light ones, and stacks, are
//     then solved to rounding;
//   - sweeps give up on parts that they hardly bring nearer.
//
// Cost: the sum over all parts of iterations * rows * (1..kInnerSweeps). Known limits: contacts converge
// linearly, slowly for large mass ratios, where a part is too large for Newton's method.
#include <algorithm>
#include <limits>
#include <utility>

#include "engine/solvers/independent_parts.hpp"
#include "engine/solvers/joint_loops.hpp"
#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/methods/conjugate_sweeps.hpp"
#include "engine/solvers/methods/contact_group.hpp"
#include "engine/solvers/methods/part_finish.hpp"
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
        findLoops(input);
        contacts_.begin(input.constraints, groups_);
        orderGroups(input);
        iterate(input);
        finish(input);
    }

  private:
    static bool isJoint(const Block<S>& block) { return !isOfContact(block.kind); }

    /// Sweeps over all groups but those of parts that are solved.
    void iterate(const SolverInput<S>& input) {
        solved_.assign(parts_.count(), 0);
        stalled_.assign(parts_.count(), 0);
        ended_.assign(parts_.count(), 0);
        impact_.assign(parts_.count(), 0);
        before_.assign(parts_.count(), kUnknown);
        last_.assign(parts_.count(), kUnknown);
        found_.resize(groups_.size());
        for (int i = 0; i < input.iterations; ++i) {
            renewBiases(input, i);
            if (i == kPlainSweeps) conjugate_.begin(input, parts_.count());
            if (i >= kPlainSweeps && i % 2 == 0)
                forUnsolved(input, [&](std::size_t) { conjugate_.remember(input, blocks_); });
            const Real change = sweeps_.template largest<Real>(i % 2 != 0, [&](std::size_t group) {
                const bool solved = solved_[parts_.partOf(group)] != 0;
                return found_[group] = solved ? Real(0) : solveGroup(input, group);
            });
            if (input.monitor.after(input.velocities, change)) break;
            if (i == 0) findImpacts(input);
            if (markSolved(input)) break;
            if ((i + 1) % kStallIterations == 0) giveUpStalled(input);
            if (i + 1 == kEarlyIterations) finishEarly(input);
            if (i > kPlainSweeps && i % 2 != 0 && i + 1 < input.iterations)
                forUnsolved(input, [&](std::size_t part) { conjugate_.advance(input, part, blocks_); });
        }
    }

    /// Calls use(part), with its blocks in blocks_, for the parts of contacts alone that are not solved.
    template <class Use>
    void forUnsolved(const SolverInput<S>& input, const Use& use) {
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            if (solved_[part]) continue;
            collectBlocks(input.constraints.blocks, part, std::numeric_limits<std::size_t>::max());
            if (!rowsOf(input).ofJoints) use(part);
        }
    }

    /// Rows of the blocks in blocks_.
    PartRows rowsOf(const SolverInput<S>& input) const { return partRows(input.constraints.blocks, blocks_); }

    /// Renews the biases of parts that are not solved yet.
    void renewBiases(const SolverInput<S>& input, int iteration) {
        if (iteration == 0 || parts_.count() == 1) return input.monitor.before(input.velocities);
        blocks_.clear();
        for (std::size_t group = 0; group + 1 < groups_.size(); ++group) {
            if (solved_[parts_.partOf(group)]) continue;
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
            const Real change = changeOf(part);
            const Real gain = last_[part] < kUnknown ? last_[part] / change : Real(2);
            solved_[part] = change < tolerance || (tolerance > 0 && mayBeRounding(change) &&
                                                   change < resolution(input, part, gain));
            last_[part] = change;
            all = all && solved_[part] != 0;
        }
        return all;
    }

    /// Parts of more than a few rows whose first sweep had to change velocities by more than gravity makes in a step.
    void findImpacts(const SolverInput<S>& input) {
        const Real most = kImpact * input.monitor.tolerance();
        for (std::size_t part = 0; part < parts_.count(); ++part)
            impact_[part] = most > 0 && changeOf(part) > most &&
                            !collectBlocks(input.constraints.blocks, part, PartFinish<S>::kFewRows);
    }

    /// An impact goes through the part, and the last sweep did not leave it nearly solved.
    bool isFar(const SolverInput<S>& input, std::size_t part) const {
        return impact_[part] != 0 && last_[part] > kFar * input.monitor.tolerance();
    }

    /// Sweeps end, too, over parts that they hardly bring nearer. With joints and contacts friction that sticks may have to
    /// grow until it slides, where they require what cannot both be: sweeps take thousands for that. Contacts alone may be
    /// left with the rounding of positions, from which gaps follow: an ulp of 10 m is 6e-5 m/s at 1/60 s in single precision.
    void giveUpStalled(const SolverInput<S>& input) {
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            if (solved_[part]) continue;
            collectBlocks(input.constraints.blocks, part, std::numeric_limits<std::size_t>::max());
            const PartRows rows = rowsOf(input);
            const Real change = changeOf(part), before = std::exchange(before_[part], change);
            if (rows.mixesJoints() && change > kStalled * before) solved_[part] = stalled_[part] = 1;
            if (!rows.ofJoints && input.monitor.tolerance() > 0 && change > kHovers * before &&
                mayBeRounding(change) && change < kPositions * roundingOf(input, part))
                solved_[part] = 1;
        }
    }

    /// Residual of a part before its last sweep.
    Real changeOf(std::size_t part) const {
        Real change = 0;
        for (const std::uint32_t group : parts_.units(part)) change = std::max(change, found_[group]);
        return change;
    }

    /// Joints alone, without a closed loop: each sweep solves them at once.
    bool isTreeOfJoints(const SolverInput<S>& input, std::size_t part) const {
        const std::span<const std::uint32_t> units = parts_.units(part);
        return looped_[part] == 0 && units.size() == 1 &&
               isJoint(input.constraints.blocks[groups_[units.front()]]);
    }

    /// False: more than the rounding of 1000 m/s.
    static bool mayBeRounding(Real change) {
        return change < Real(32e3) * std::numeric_limits<Real>::epsilon();
    }

    /// Residual below which rounding has been reached in a part, where `gain` is how much nearer the last sweep has brought
    /// it (2: unknown). Biases of joints are renewed from positions, whose rounding a solver does not know. A part of joints
    /// alone is solved at once in each sweep: what is left is rounding where sweeps no longer halve it, and where the next
    /// one would get below that of velocities. With contacts beside the joints, rounding of velocities counts from where
    /// sweeps no longer halve the residual. Closed loops of joints get as near as they can.
    Real resolution(const SolverInput<S>& input, std::size_t part, Real gain) const {
        const bool settled = gain < 2 && looped_[part] == 0;
        if (isTreeOfJoints(input, part))
            return settled ? std::numeric_limits<Real>::max() : gain * roundingOf(input, part);
        const auto isOfJoints = [&](std::uint32_t unit) {
            return isJoint(input.constraints.blocks[groups_[unit]]);
        };
        const std::span<const std::uint32_t> units = parts_.units(part);
        if (!settled && std::any_of(units.begin(), units.end(), isOfJoints)) return 0;
        return roundingOf(input, part);
    }

    /// Rounding of the velocities of a part.
    Real roundingOf(const SolverInput<S>& input, std::size_t part) const {
        Real largest = 0;
        for (const std::uint32_t group : parts_.units(part))
            for (std::uint32_t k = groups_[group]; k < groups_[group + 1]; ++k)
                largest = std::max(largest, blockResolution<S>(input.constraints, input.constraints.blocks[k],
                                                               input.velocities));
        return largest;
    }

    /// Newton's method solves what sweeps leave of small parts.
    void finish(const SolverInput<S>& input) {
        if (!mayFinish(input)) return;
        bool renewed = false;
        Real worst = -1;
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            if (ended_[part] || (solved_[part] && isTreeOfJoints(input, part))) continue;
            if (!collectBlocks(input.constraints.blocks, part, PartFinish<S>::kMostRows)) continue;
            if (!std::exchange(renewed, true)) input.monitor.before(input.velocities);
            const auto left = PartFinish<S>::residualOf(input, blocks_);
            if (left.found <= left.goal) continue;
            if (!finish_.isWorthwhile(input, blocks_, left, !solved_[part] || stalled_[part])) continue;
            const Real reached = finish_.solve(input, blocks_, left);
            if (reached < left.found) worst = std::max(worst, reached);
        }
        if (worst >= 0) input.monitor.after(input.velocities, worst);
    }

    /// Newton's method solves contacts of few bodies sooner than sweeps that converge slowly. Sweeps go on where
    /// it does not.
    void finishEarly(const SolverInput<S>& input) {
        if (!mayFinish(input)) return;
        for (std::size_t part = 0; part < parts_.count(); ++part) {
            if (solved_[part] || !collectBlocks(input.constraints.blocks, part, PartFinish<S>::kMostRows))
                continue;
            const PartRows rows = rowsOf(input);
            if (rows.besideEqualities == 0 || rows.besideEqualities > PartFinish<S>::kFewRows) continue;
            input.monitor.before(input.velocities, blocks_);
            auto left = PartFinish<S>::residualOf(input, blocks_);
            if (looped_[part] && rows.ofJoints)
                left.goal = std::max(left.goal, kLoopsGoal * input.monitor.tolerance());
            if (left.found > left.goal) {
                finish_.putInOrder(input, blocks_);
                const Real reached = finish_.solve(input, blocks_, left);
                solved_[part] = reached <= left.goal;
                endLoops(input, part, reached);
            } else {
                solved_[part] = 1;
            }
        }
    }

    /// Rows of closed loops may contradict each other by more than the tolerance, and by more than kLoopsGoal. What Newton's
    /// method then leaves of such a part, sweeps hardly bring nearer, nor does a second attempt.
    void endLoops(const SolverInput<S>& input, std::size_t part, Real reached) {
        if (looped_[part] && reached < kLoopsEnd * input.monitor.tolerance())
            solved_[part] = ended_[part] = 1;
    }

    static bool mayFinish(const SolverInput<S>& input) {
        return input.monitor.tolerance() > 0 && input.iterations >= kFinishIterations &&
               input.friction == &frictionCone<Real>;
    }

    /// The blocks of a part. False: it has more rows than `most`.
    bool collectBlocks(const std::vector<Block<S>>& blocks, std::size_t part, std::size_t most) {
        blocks_.clear();
        std::size_t rows = 0;
        for (const std::uint32_t group : parts_.units(part))
            for (std::uint32_t k = groups_[group]; k < groups_[group + 1]; ++k) {
                rows += blocks[k].rows;
                if (rows > most) return false;
                blocks_.push_back(k);
            }
        return true;
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

    void findLoops(const SolverInput<S>& input) {
        looped_.assign(parts_.count(), 0);
        std::size_t group = 0;
        loops_.find<S>(input.constraints.blocks, input.velocities.size(), [&](std::size_t block) {
            while (groups_[group + 1] <= block) ++group;
            looped_[parts_.partOf(group)] = 1;
        });
    }

    void orderGroups(const SolverInput<S>& input) {
        constexpr std::size_t kGrain = 8;  // a group takes some 2 us, handing out a part 0.3 us
        sweeps_.begin(*tasks_, input.velocities.size(), kGrain);
        for (std::size_t k = 0; k + 1 < groups_.size(); ++k)
            sweeps_.add<S>({input.constraints.blocks.data() + groups_[k], groups_[k + 1] - groups_[k]});
        sweeps_.finish();
    }

    /// Returns the residual of the group before it was solved.
    Real solveGroup(const SolverInput<S>& input, std::size_t group) {
        const std::uint32_t first = groups_[group], last = groups_[group + 1];
        if (isJoint(input.constraints.blocks[first]))
            return joints_.solveUnit(joints_.unitOf(first), input.constraints, input.velocities);
        const Real found = sweepOnce(input, first, last);
        if (last - first == 1 || isFar(input, parts_.partOf(group))) return found;
        const Real enough = std::max({kInnerFloor * input.monitor.tolerance(),
                                      std::numeric_limits<Real>::epsilon(), kInnerTolerance * found});
        if (found <= enough) return found;
        if (contacts_.takes(group)) {
            contacts_.sweep(input, group, {input.constraints.blocks.data() + first, last - first},
                            kInnerSweeps - 1, enough);
            return found;
        }
        for (int sweep = 1; sweep < kInnerSweeps; ++sweep)
            if (sweepOnce(input, first, last) <= enough) break;
        return found;
    }

    /// Sweeps over the blocks of a group, always forwards, which measurably calms stacks.
    static Real sweepOnce(const SolverInput<S>& input, std::uint32_t first, std::uint32_t last) {
        Real largest = 0;
        for (std::uint32_t k = first; k < last; ++k) {
            const Block<S>& block = input.constraints.blocks[k];
            Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
            if (block.kind == BlockKind::Moment) {
                largest = std::max(largest, solveMoment(input, block, a, b));
                continue;
            }
            const Real residual = solveNormal(input, block, a, b);
            largest = std::max({largest, residual, solveFriction(input, block, a, b)});
        }
        return largest;
    }

    static constexpr Real kUnknown =
        std::numeric_limits<Real>::max();  ///< residual of a sweep before the first
    static constexpr int kPlainSweeps =
        2;  ///< before conjugate gradients: most parts of scenes at rest need no more
    static constexpr int kEarlyIterations = 6;  ///< sweeps before Newton's method takes the smallest parts
    /// Even, since sweeps forwards and backwards leave other residuals.
    static constexpr int kStallIterations = 10;
    static constexpr Real kStalled =
        Real(0.8);  ///< fraction of the residual that so many sweeps leave at most
    static constexpr Real kHovers = Real(0.9);  ///< the same of contacts alone
    static constexpr Real kPositions =
        Real(64);  ///< rounding of positions, as a multiple of that of velocities
    /// Multiples of the tolerance: where Newton's method ends over closed loops, and where sweeps do not go on after it.
    static constexpr Real kLoopsGoal = Real(64), kLoopsEnd = Real(1e3);
    static constexpr int kFinishIterations = 30;  ///< fewer than that are too few to sort contacts by
    /// Multiple of the tolerance: faster than what gravity does in a step to stacks that nothing holds yet.
    static constexpr Real kImpact = Real(2e6);
    static constexpr Real kFar = Real(1e5);              ///< multiple of the tolerance: far from solved
    static constexpr int kInnerSweeps = 5;               ///< maximum number of sweeps per solve of a group
    static constexpr Real kInnerTolerance = Real(0.03);  ///< relative to the first sweep's residual
    static constexpr Real kInnerFloor =
        Real(1e-3);  ///< fraction of the tolerance below which a group stays as it is
    const Tasks* tasks_ = &Tasks::one();
    std::vector<std::uint32_t> groups_;  ///< first block of each group
    IndependentParts parts_;
    std::vector<std::uint8_t> solved_;   ///< flag of each part
    std::vector<std::uint8_t> stalled_;  ///< parts that count as solved without being it
    std::vector<std::uint8_t> ended_;   ///< parts with loops that Newton's method has taken as far as it goes
    std::vector<std::uint8_t> impact_;  ///< large parts that an impact goes through
    std::vector<Real> before_;          ///< residual of each part kStallIterations ago
    std::vector<Real> last_;            ///< residual of each part before its last sweep
    JointLoops loops_;
    std::vector<std::uint8_t> looped_;   ///< parts with closed loops of joints
    std::vector<Real> found_;            ///< residual of each group before its last solve
    std::vector<std::uint32_t> blocks_;  ///< blocks of a part
    SweepOrder sweeps_;
    ContactGroups<S> contacts_;
    ConjugateSweeps<S> conjugate_;
    JointGroup<S> joints_;
    PartFinish<S> finish_;
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
