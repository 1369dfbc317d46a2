// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Non-linear Gauss-Seidel on positions [Catto2009, "position correction"]: after the bodies have moved, each
// iteration loops over the constraints, evaluates C where the bodies are now, and moves them along M^-1 J^T:
//     joints    lambda = -K^-1 C                                all of the error, all joints at once by a
//                                                               direct method (joint_system.hpp); then limits
//                                                               where C < 0, one by one
//     contact   lambda = max(0, -beta (C + slop)) / K           beta < 1 lets coupled contacts converge
// Velocities are not touched, so no energy enters through them (potential energy does: bodies are lifted
// out). Without contacts and limits the iterations end when they improve the joints no more. Connected joints that are
// still apart after the usual number of iterations have further ones, whatever the others do. Where these come no nearer, as in
// nets, which have more rows than motions, K is made larger on its diagonal, as by Levenberg and Marquardt.
// Cost: iterations * constraints.
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
#include <utility>

#include "engine/core/disjoint_sets.hpp"
#include "engine/solvers/joints/joint_system.hpp"
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
        Real last = std::numeric_limits<Real>::infinity();
        bool together = true;
        for (int i = 0; i < iterations.usual; ++i) {
            const Real error = correctJoints(problem, together);
            correctContacts(problem, slop);
            problem.applyRotations();
            if (!(error < Real(0.5) * last)) {
                // Rounding is reached, or Newton's iteration has been too far off. Where it brings nothing at all, joint by
                // joint is slow and sure.
                if (problem.contactCount() == 0 && !limited_ && error < kRounding) break;
                together = together && (error < last || error < kRounding);
            }
            last = error;
        }
        if (last >= kNear && iterations.usual < iterations.most)
            correctFurther(problem, iterations.most - iterations.usual, kNear);
    }

    bool drifts() const override { return drift_ > 0; }

    bool beginDrift(PositionProblem<S>& problem) override {
        if (!drifts()) return false;
        evaluateAll(problem);
        return !held_.empty() && factor(held_, joints_, system_);
    }

    void endDrift(PositionProblem<S>& problem, Real time, bool whole,
                  const PositionIterations& iterations) override {
        for (std::size_t k = 0; k < held_.size(); ++k) {
            problem.evaluateJoint(held_[k], moved_);
            JointPositions<S>& joint = joints_[held_[k]];
            for (std::size_t r = 0; r < joint.block.rows; ++r)
                system_.at(k)[r] = r < moved_.block.rows ? joint.row[r].error - moved_.row[r].error : Real(0);
            if (moved_.block.rows == 0)
                joint.block.rows = 0;  // asleep since, with all that it is connected to
        }
        system_.solve();
        mu_.resize(kMaxJointRows * held_.size());
        std::size_t awake = 0;
        for (std::size_t k = 0; k < held_.size(); ++k) {
            const JointPositions<S>& joint = joints_[held_[k]];
            if (joint.block.rows == 0) continue;
            std::copy_n(system_.at(k), joint.block.rows, mu_.begin() + kMaxJointRows * awake);
            move(problem, joint, system_.at(k));
            held_[awake++] = held_[k];
        }
        held_.resize(awake);
        problem.applyRotations();
        if (!held_.empty()) project(problem, drift_ / time, whole, iterations);
    }

  private:
    static constexpr Real kBaumgarte = Real(0.2);  ///< beta of contacts
    static constexpr Real kNear = Real(1e-5);      ///< joint error that Newton's method squares [m] or [rad]
    static constexpr Real kRounding =
        Real(1000) * std::numeric_limits<Real>::epsilon();  ///< error that rounding leaves
    static constexpr Real kLongestMove = Real(0.2);         ///< longest move per contact and iteration [m]
    static constexpr Real kLeastDamping = Real(1e-3), kMostDamping = Real(0.3);

    /// Connected joints in further iterations.
    struct Part {
        Real error = 0, last = 0;  ///< largest when its joints were evaluated, and before
        Real damping = 0;          ///< fraction of K's diagonal that is added to it, where there are loops
        bool settled = false;      ///< rounding is reached
        bool looped = false;       ///< some joint closes a loop
        void renewDamping() {
            if (looped && last > 0 && !(error < last))
                damping = std::clamp(100 * damping, kLeastDamping, kMostDamping);
            else if ((damping *= Real(0.5)) < kLeastDamping)
                damping = 0;
        }
    };

    /// Finds the joints as they are now. Returns the largest error of a row that holds.
    Real evaluateAll(PositionProblem<S>& problem) {
        const std::size_t n = problem.jointCount();
        if (joints_.size() < n) joints_.resize(n);
        Real largest = 0;
        limited_ = false;
        held_.clear();
        for (std::size_t j = 0; j < n; ++j) {
            problem.evaluateJoint(j, joints_[j]);
            limited_ = limited_ || joints_[j].count > joints_[j].block.rows;
            if (joints_[j].block.rows == 0) continue;
            held_.push_back(j);
            largest = std::max(largest, errorOf(joints_[j]));
        }
        return largest;
    }

    /// Returns the largest error of a row that holds.
    Real correctJoints(PositionProblem<S>& problem, bool together) {
        const Real largest = evaluateAll(problem);
        if (largest > 0) {
            if (!together || !correctTogether(problem, held_, system_)) correctOneByOne(problem, held_);
        }
        if (limited_) correctLimits(problem);
        return largest;
    }

    /// The end of endDrift(): Newton's iteration for the positions goes on where bodies have moved to, whose tangents the
    /// velocities get with the impulses mu times `perTime`.
    void project(PositionProblem<S>& problem, Real perTime, bool whole,
                 const PositionIterations& iterations) {
        ends_.resize(joints_.size());
        kept_.resize(mu_.size());
        for (std::size_t k = 0; k < held_.size(); ++k) {
            JointPositions<S>& joint = ends_[held_[k]];
            problem.evaluateJoint(held_[k], joint);
            for (std::size_t r = 0; r < joint.block.rows; ++r)
                kept_[kMaxJointRows * k + r] =
                    whole && !joint.driven[r] ? Real(0) : problem.velocity(joint.block, joint.row[r]);
        }
        for (std::size_t k = 0; k < held_.size(); ++k)
            problem.push(joints_[held_[k]], &mu_[kMaxJointRows * k], perTime);
        if (!factor(held_, ends_, system_)) return;
        const auto solve = [&](const auto& right, const auto& use) {
            for (std::size_t k = 0; k < held_.size(); ++k)
                for (std::size_t r = 0; r < ends_[held_[k]].block.rows; ++r)
                    system_.at(k)[r] = right(ends_[held_[k]], k, r);
            system_.solve();
            for (std::size_t k = 0; k < held_.size(); ++k) use(ends_[held_[k]], system_.at(k));
        };
        solve(
            [&](const JointPositions<S>& joint, std::size_t k, std::size_t r) {
                return kept_[kMaxJointRows * k + r] - problem.velocity(joint.block, joint.row[r]);
            },
            [&](const JointPositions<S>& joint, const Real* x) { problem.push(joint, x, Real(1)); });
        solve([](const JointPositions<S>& joint, std::size_t, std::size_t r) { return -joint.row[r].error; },
              [&](const JointPositions<S>& joint, const Real* x) { move(problem, joint, x); });
        problem.applyRotations();
        std::swap(joints_, ends_);
        // A bound far above rounding would be met at one scale of lengths and not at another.
        if (iterations.most > 0) correctFurther(problem, 1, std::min(kRounding, kNear));
        if (iterations.most > 1) correctFurther(problem, iterations.most - 1, kNear);
        std::swap(joints_, ends_);
        if (limited_) correctLimits(problem);
    }

    /// Goes on with the connected joints that were further apart than `near` before the last iteration. What becomes of
    /// a part does not depend on the others.
    void correctFurther(PositionProblem<S>& problem, int iterations, Real near) {
        findParts();
        for (int i = 0; i < iterations; ++i) {
            std::erase_if(held_, [&](std::size_t j) { return partOf(j).settled || partOf(j).error < near; });
            if (held_.empty()) return;
            for (const std::size_t j : held_) problem.evaluateJoint(j, joints_[j]);
            findErrors();
            for (Part& part : parts_) part.renewDamping();
            for (const std::size_t j : held_) damp(joints_[j], partOf(j).damping);
            if (!correctTogether(problem, held_, further_)) correctOneByOne(problem, held_);
        }
    }
    static void damp(JointPositions<S>& joint, Real damping) {
        if (damping == 0) return;
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            if (joint.row[r].invK > 0) joint.row[r].softness = damping / joint.row[r].invK;
    }

    void findParts() {
        std::uint32_t bodies = 0;
        for (const std::size_t j : held_)
            bodies = std::max({bodies, joints_[j].block.a + 1, joints_[j].block.b + 1});
        sets_.begin(bodies);
        closing_.clear();
        for (const std::size_t j : held_) {
            const Block<S>& block = joints_[j].block;
            if (!(block.invMassA > 0 && block.invMassB > 0)) continue;
            if (sets_.rootOf(block.a) == sets_.rootOf(block.b)) closing_.push_back(j);
            sets_.join(block.a, block.b);
        }
        parts_.assign(bodies, Part{});
        for (const std::size_t j : closing_) partOf(j).looped = true;
        findErrors();
    }
    Part& partOf(std::size_t joint) {
        const Block<S>& block = joints_[joint].block;
        return parts_[sets_.rootOf(block.invMassA > 0 ? block.a : block.b)];
    }
    /// Errors of the parts as their joints were evaluated.
    void findErrors() {
        for (Part& part : parts_) part.last = std::exchange(part.error, Real(0));
        for (const std::size_t j : held_) partOf(j).error = std::max(partOf(j).error, errorOf(joints_[j]));
        for (Part& part : parts_)
            part.settled = part.last > 0 && !(part.error < Real(0.5) * part.last) && part.error < kRounding;
    }
    static Real errorOf(const JointPositions<S>& joint) {
        Real largest = 0;
        for (int r = 0; r < joint.block.rows; ++r)
            largest = std::max(largest, std::abs(joint.row[static_cast<std::size_t>(r)].error));
        return largest;
    }

    bool factor(std::span<const std::size_t> joints, const std::vector<JointPositions<S>>& evaluated,
                JointSystem<S>& system) {
        items_.clear();
        for (const std::size_t j : joints) items_.push_back({&evaluated[j].block, evaluated[j].row.data()});
        return system.factor(items_);
    }

    /// False: there are no factors.
    bool correctTogether(PositionProblem<S>& problem, std::span<const std::size_t> joints,
                         JointSystem<S>& system) {
        if (joints.empty()) return true;
        if (!factor(joints, joints_, system)) return false;
        for (std::size_t k = 0; k < joints.size(); ++k)
            for (int r = 0; r < joints_[joints[k]].block.rows; ++r)
                system.at(k)[r] = -joints_[joints[k]].row[r].error;
        system.solve();
        for (std::size_t k = 0; k < joints.size(); ++k) move(problem, joints_[joints[k]], system.at(k));
        problem.applyRotations();
        return true;
    }

    void correctOneByOne(PositionProblem<S>& problem, std::span<const std::size_t> joints) {
        for (const std::size_t j : joints) {
            JointPositions<S>& joint = joints_[j];
            problem.evaluateJoint(j, joint);
            BlockVector<S> error(joint.block.rows);
            for (int r = 0; r < joint.block.rows; ++r) error[r] = joint.row[r].error;
            BlockMatrix<S> inverseK;
            invertBlock<S>(joint.row.data(), joint.block, inverseK);
            const BlockVector<S> lambda = -(inverseK * error);
            move(problem, joint, lambda.data());
            problem.applyRotations();
        }
    }

    static void move(PositionProblem<S>& problem, const JointPositions<S>& joint, const Real* lambda) {
        for (int r = 0; r < joint.block.rows; ++r) problem.move(joint.block, joint.row[r], lambda[r]);
    }

    void correctLimits(PositionProblem<S>& problem) {
        for (std::size_t j = 0; j < problem.jointCount(); ++j) {
            JointPositions<S>& joint = joints_[j];
            if (joint.count == joint.block.rows) continue;
            problem.evaluateJoint(j, joint);
            for (auto r = static_cast<std::size_t>(joint.block.rows);
                 r < static_cast<std::size_t>(joint.count); ++r)
                if (joint.row[r].error < 0)
                    problem.move(joint.block, joint.row[r], -joint.row[r].error * joint.row[r].invK);
            problem.applyRotations();
        }
    }

    static void correctContacts(PositionProblem<S>& problem, Real slop) {
        for (std::size_t c = 0; c < problem.contactCount(); ++c) {
            const Real error = problem.separation(c) + slop;
            if (error >= 0) continue;
            const Row<S>& row = problem.contactRow(c);
            problem.move(problem.contactBlock(c), row,
                         std::min(-kBaumgarte * error, kLongestMove) * row.invK);
        }
    }

    Real drift_ = 0;  ///< fraction of RATTLE's impulses that velocities get; 0: no RATTLE
    std::vector<JointPositions<S>> joints_;
    // --- of a drift
    std::vector<JointPositions<S>> ends_;  ///< joints where bodies have moved to
    JointPositions<S> moved_;
    std::vector<Real> mu_, kept_;    ///< kMaxJointRows numbers for each held joint
    std::vector<std::size_t> held_;  ///< joints with equality rows
    std::vector<typename JointSystem<S>::Item> items_;
    JointSystem<S> system_, further_;
    DisjointSets sets_;                 ///< bodies that joints connect
    std::vector<std::size_t> closing_;  ///< joints that close loops
    std::vector<Part> parts_;           ///< at the root of their bodies
    bool limited_ = false;              ///< some joint has limits
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
