// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-linear Gauss-Seidel on positions [Catto2009, "position correction"], after the bodies have moved. Joints are put
// right by Newton's method (joint_newton.hpp), then overlaps of contacts and violated limits are swept over, each
// by an impulse times a second along its row:
//     lambda = max(0, -beta (C + slop)) / K             contacts: beta < 1 lets coupled contacts converge; limits: 1
// Where joints connect few bodies with something that cannot move, an impulse moves all of them while the joints hold, and
// K is that of them all: a plank of a bridge would be pushed out from under a truck by itself, and its hinges would pull it
// back in. Other bodies are pushed one by one, and their joints put right after each sweep: heaps of ragdolls that contacts
// pushed as wholes were lifted out of overlaps that cannot be resolved, and fell again. At last the joints' iteration
// goes on to rounding.
// Velocities are not touched, so no energy enters through them (potential energy does: bodies are lifted
// out). Connected joints that are still apart after the usual number of iterations have further ones, whatever the others
// do.
// Cost: iterations * constraints, and a solution of the joints' system for each contact that overlaps beside joints.
//
// `rattle` is the same, and takes joints over the halves of a step to midpoints and back by RATTLE (position_correction.hpp).
// `processed_rattle` gives the velocities 3/4 of what RATTLE gives them. The halves of a step are the processor of the
// sequence of midpoints [BlanesCasasMurua2004]: they decide which energy of the shown states it conserves. With a fraction w
// of RATTLE's impulses the shown energy H varies, to the order h^2, by
//     h^2 (1/12 - w/8) a M a                           joints that nothing but joints accelerates, accelerations a
//     h^2/8 v^2 ((1/2 - w) v^2 / r^2 - g.n / r)        a point on an arc of radius r about a fixed one, gravity g, n to the centre
// which vanish for w = 2/3 and, released at the height of the centre, for w = 1.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/solvers/corrections/joint_drift.hpp"
#include "engine/solvers/corrections/joint_newton.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Ngs final : public PositionCorrection<S> {
  public:
    using Real = typename S::Real;

    explicit Ngs(Real drift) : drift_(drift) {}
    std::unique_ptr<PositionCorrection<S>> clone() const override { return std::make_unique<Ngs>(*this); }

    void correct(PositionProblem<S>& problem, const PositionIterations& iterations, Real slop) override {
        if (iterations.usual == 0) return;
        newton_.evaluateAll(problem);
        newton_.findParts();
        findLimits(problem);
        for (Part& part : newton_.parts()) {
            newton_.approach(problem, part, 1, true);
            part.holds = part.hangs && newton_.fits() && !part.slow && part.size() <= kMostHeld;
        }
        sweepPushes(problem, iterations.usual, slop);
        for (Part& part : newton_.parts()) {
            const int usual = part.pushed ? iterations.usual : iterations.alone;
            newton_.approach(problem, part, usual - 1, false);
            newton_.approachFurther(problem, part, iterations.most - usual, JointNewton<S>::kNear);
        }
    }

    bool drifts() const override { return drift_ > 0; }

    bool beginDrift(PositionProblem<S>& problem) override {
        return drifts() && drifting_.begin(problem, newton_);
    }

    void endDrift(PositionProblem<S>& problem, Real time, bool whole,
                  const PositionIterations& iterations) override {
        drifting_.end(problem, newton_, drift_ / time, whole, iterations);
        if (newton_.limited()) correctLimits(problem);
    }

  private:
    using Part = typename JointNewton<S>::Part;
    using Reach = typename JointNewton<S>::Reach;
    static constexpr Real kBaumgarte = Real(0.2);    ///< beta of contacts
    static constexpr Real kLongestMove = Real(0.2);  ///< longest move per contact and sweep [m]
    static constexpr std::size_t kMostHeld = 64;     ///< largest part whose joints hold while it is pushed
    /// Least mobility that joints leave to a contact or a limit, relative to its own.
    static constexpr Real kLeastMobility = Real(1e-2);

    /// A row of a joint that is a limit.
    struct Limit {
        std::size_t joint, row;
        Real error;  ///< C where bodies have not moved since the rows of the step were made [m] or [rad]
    };
    /// The bodies that an impulse along a contact's or a limit's row moves.
    struct Push {
        bool found = false;
        Real invK = 0;
        /// Range of reach_, the last one excluded; empty: its two bodies alone.
        std::size_t first = 0, last = 0;
    };

    void findLimits(const PositionProblem<S>& problem) {
        limits_.clear();
        for (std::size_t j = 0; newton_.limited() && j < problem.jointCount(); ++j) {
            const JointPositions<S>& joint = newton_.joints()[j];
            for (std::size_t r = joint.block.rows; r < static_cast<std::size_t>(joint.count); ++r)
                limits_.push_back({j, r, joint.row[r].error - problem.moved(joint.block, joint.row[r])});
        }
    }

    /// Sweeps over limits and contacts until none of them is pushed.
    void sweepPushes(PositionProblem<S>& problem, int sweeps, Real slop) {
        pushes_.assign(limits_.size() + problem.contactCount(), Push{});
        reach_.clear();
        bool limited = false;
        for (int i = 0; i < sweeps; ++i) {
            const bool limits = pushLimits(problem), contacts = pushContacts(problem, slop);
            if (!limits && !contacts) break;
            limited = limited || limits;
            if (approachPushed(problem) && limits) renewLimits(problem);
        }
        problem.applyRotations();
        if (limited) correctLimits(problem);
    }

    /// An iteration for joints that were pushed apart. False: there are none.
    bool approachPushed(PositionProblem<S>& problem) {
        bool any = false;
        for (Part& part : newton_.parts()) {
            if (!part.pushed) continue;
            part.settled = false;
            part.before = part.error = std::numeric_limits<Real>::infinity();
            if (part.holds) continue;
            if (!std::exchange(any, true)) problem.applyRotations();
            newton_.approach(problem, part, 1, false);
        }
        return any;
    }

    /// Finds limits again beside joints that were put right.
    void renewLimits(const PositionProblem<S>& problem) {
        for (Limit& limit : limits_) {
            JointPositions<S>& joint = newton_.joints()[limit.joint];
            const Part* const part = newton_.partOf(joint.block.invMassA > 0 ? joint.block.a : joint.block.b);
            if (part != nullptr && part->holds) continue;
            problem.evaluateJoint(limit.joint, joint);
            limit.error = joint.row[limit.row].error - problem.moved(joint.block, joint.row[limit.row]);
        }
    }

    /// True: some limit was violated.
    bool pushLimits(PositionProblem<S>& problem) {
        bool any = false;
        for (std::size_t l = 0; l < limits_.size(); ++l) {
            const Limit& limit = limits_[l];
            const JointPositions<S>& joint = newton_.joints()[limit.joint];
            const Row<S>& row = joint.row[limit.row];
            const Real error = limit.error + problem.moved(joint.block, row);
            if (error >= 0) continue;
            any = true;
            push(problem, pushes_[l], joint.block, row, -error);
        }
        return any;
    }

    /// True: some contact overlaps.
    bool pushContacts(PositionProblem<S>& problem, Real slop) {
        bool any = false;
        for (std::size_t c = 0; c < problem.contactCount(); ++c) {
            const Real error = problem.separation(c) + slop;
            if (error >= 0) continue;
            any = true;
            push(problem, pushes_[limits_.size() + c], problem.contactBlock(c), problem.contactRow(c),
                 std::min(-kBaumgarte * error, kLongestMove));
        }
        return any;
    }

    void push(PositionProblem<S>& problem, Push& push, const Block<S>& block, const Row<S>& row, Real way) {
        Part* const a = block.invMassA > 0 ? newton_.partOf(block.a) : nullptr;
        Part* const b = block.invMassB > 0 ? newton_.partOf(block.b) : nullptr;
        for (Part* const part : {a, b})
            if (part != nullptr) part->pushed = true;
        if (!std::exchange(push.found, true))
            findPush(push, block, row, (a != nullptr && a->holds) || (b != nullptr && b->holds));
        const Real lambda = way * push.invK;
        if (push.first == push.last) return problem.move(block, row, lambda);
        for (std::size_t k = push.first; k < push.last; ++k)
            problem.moveBody(reach_[k].body, lambda * reach_[k].motion.v, lambda * reach_[k].motion.w);
    }

    void findPush(Push& push, const Block<S>& block, const Row<S>& row, bool held) {
        push.invK = row.invK;
        push.first = push.last = reach_.size();
        if (!held || !(row.invK > 0)) return;
        const Real K = newton_.reach(block, row, reach_);
        push.invK = Real(1) / (std::max(K, Real(0)) + kLeastMobility / row.invK);
        push.last = reach_.size();
    }

    /// Limits one by one, where their bodies are now.
    void correctLimits(PositionProblem<S>& problem) {
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            JointPositions<S>& joint = newton_.joints()[j];
            if (joint.count == joint.block.rows) continue;
            problem.evaluateJoint(j, joint);
            for (std::size_t r = joint.block.rows; r < static_cast<std::size_t>(joint.count); ++r)
                if (joint.row[r].error < 0)
                    problem.move(joint.block, joint.row[r], -joint.row[r].error * joint.row[r].invK);
            problem.applyRotations();
        }
    }

    Real drift_ = 0;  ///< fraction of RATTLE's impulses that velocities get; 0: no RATTLE
    JointNewton<S> newton_;
    JointDrift<S> drifting_;
    std::vector<Limit> limits_;
    std::vector<Push> pushes_;  ///< a push of each limit, then of each contact
    std::vector<Reach> reach_;
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeNgs() {
    return std::make_unique<Ngs<S>>(typename S::Real(0));
}
RIGOR_INSTANTIATE_FACTORY(makeNgs, PositionCorrection);

template <class S>
std::unique_ptr<PositionCorrection<S>> makeRattle() {
    return std::make_unique<Ngs<S>>(typename S::Real(1));
}
RIGOR_INSTANTIATE_FACTORY(makeRattle, PositionCorrection);

template <class S>
std::unique_ptr<PositionCorrection<S>> makeProcessedRattle() {
    return std::make_unique<Ngs<S>>(typename S::Real(0.75));
}
RIGOR_INSTANTIATE_FACTORY(makeProcessedRattle, PositionCorrection);

}  // namespace rigor::engine
