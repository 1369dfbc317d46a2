// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/corrections/joint_drift.hpp"

#include <algorithm>
#include <utility>

namespace rigor::engine {

template <class S>
bool JointDrift<S>::begin(const PositionProblem<S>& problem, JointNewton<S>& newton) {
    newton.evaluateAll(problem);
    return !newton.held().empty() && newton.factor(newton.joints());
}

template <class S>
void JointDrift<S>::end(PositionProblem<S>& problem, JointNewton<S>& newton, Real perTime, bool whole,
                        const PositionIterations& iterations) {
    findImpulses(problem, newton);
    if (newton.held().empty()) return;
    ends_.resize(newton.joints().size());
    for (const std::size_t j : newton.held()) problem.evaluateJoint(j, ends_[j]);
    project(problem, newton, perTime, whole);
    std::swap(newton.joints(), ends_);
    newton.findParts();
    for (auto& part : newton.parts()) {
        // A bound far above rounding would be met at one scale of lengths and not at another.
        newton.approachFurther(problem, part, std::min(iterations.most, 1),
                               std::min(JointNewton<S>::kRounding, JointNewton<S>::kNear));
        newton.approachFurther(problem, part, iterations.most - 1, JointNewton<S>::kNear);
    }
    std::swap(newton.joints(), ends_);
}

/// Impulses that take the joints back to where the errors are those of the start, along the directions of the start.
template <class S>
void JointDrift<S>::findImpulses(PositionProblem<S>& problem, JointNewton<S>& newton) {
    std::vector<std::size_t>& held = newton.held();
    JointSystem<S>& system = newton.system();
    for (std::size_t k = 0; k < held.size(); ++k) {
        problem.evaluateJoint(held[k], moved_);
        JointPositions<S>& joint = newton.joints()[held[k]];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            system.at(k)[r] = r < moved_.block.rows ? joint.row[r].error - moved_.row[r].error : Real(0);
        if (moved_.block.rows == 0) joint.block.rows = 0;  // asleep since, with all that it is connected to
    }
    system.solve();
    mu_.resize(kMaxJointRows * held.size());
    std::size_t awake = 0;
    for (std::size_t k = 0; k < held.size(); ++k) {
        const JointPositions<S>& joint = newton.joints()[held[k]];
        if (joint.block.rows == 0) continue;
        std::copy_n(system.at(k), joint.block.rows, mu_.begin() + kMaxJointRows * awake);
        moveJoint(problem, joint, system.at(k));
        held[awake++] = held[k];
    }
    held.resize(awake);
    problem.applyRotations();
}

/// Newton's iteration for the positions goes on where bodies have moved to, whose tangents the velocities get with the
/// impulses mu times `perTime`.
template <class S>
void JointDrift<S>::project(PositionProblem<S>& problem, JointNewton<S>& newton, Real perTime, bool whole) {
    const std::vector<std::size_t>& held = newton.held();
    JointSystem<S>& system = newton.system();
    kept_.resize(mu_.size());
    for (std::size_t k = 0; k < held.size(); ++k) {
        const JointPositions<S>& joint = ends_[held[k]];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            kept_[kMaxJointRows * k + r] =
                whole && !joint.driven[r] ? Real(0) : problem.velocity(joint.block, joint.row[r]);
    }
    for (std::size_t k = 0; k < held.size(); ++k)
        problem.push(newton.joints()[held[k]], &mu_[kMaxJointRows * k], perTime);
    if (!newton.factor(ends_)) return;
    const auto solve = [&](const auto& right, const auto& use) {
        for (std::size_t k = 0; k < held.size(); ++k)
            for (std::size_t r = 0; r < ends_[held[k]].block.rows; ++r)
                system.at(k)[r] = right(ends_[held[k]], k, r);
        system.solve();
        for (std::size_t k = 0; k < held.size(); ++k) use(ends_[held[k]], system.at(k));
    };
    solve(
        [&](const JointPositions<S>& joint, std::size_t k, std::size_t r) {
            return kept_[kMaxJointRows * k + r] - problem.velocity(joint.block, joint.row[r]);
        },
        [&](const JointPositions<S>& joint, const Real* x) { problem.push(joint, x, Real(1)); });
    solve([](const JointPositions<S>& joint, std::size_t, std::size_t r) { return -joint.row[r].error; },
          [&](const JointPositions<S>& joint, const Real* x) { moveJoint(problem, joint, x); });
    problem.applyRotations();
}

RIGOR_INSTANTIATE_CLASS(JointDrift)

}  // namespace rigor::engine
