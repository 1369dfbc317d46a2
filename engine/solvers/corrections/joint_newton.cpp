// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/corrections/joint_newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solvers/joints/row_coupling.hpp"

namespace rigor::engine {

template <class S>
typename S::Real JointNewton<S>::errorOf(const JointPositions<S>& joint) {
    Real largest = 0;
    for (std::size_t r = 0; r < joint.block.rows; ++r)
        largest = std::max(largest, std::abs(joint.row[r].error));
    return largest;
}

template <class S>
void JointNewton<S>::evaluateAll(const PositionProblem<S>& problem) {
    const std::size_t n = problem.jointCount();
    if (joints_.size() < n) joints_.resize(n);
    limited_ = false;
    held_.clear();
    for (std::size_t j = 0; j < n; ++j) {
        problem.evaluateJoint(j, joints_[j]);
        limited_ = limited_ || joints_[j].count > joints_[j].block.rows;
        if (joints_[j].block.rows > 0) held_.push_back(j);
    }
}

template <class S>
bool JointNewton<S>::factor(const std::vector<JointPositions<S>>& joints) {
    items_.clear();
    for (const std::size_t j : held_) items_.push_back({&joints[j].block, joints[j].row.data()});
    fits_ = system_.factor(items_);
    return fits_;
}

template <class S>
void JointNewton<S>::findParts() {
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
    const auto rootOf = [&](std::size_t j) {
        const Block<S>& block = joints_[j].block;
        return sets_.rootOf(block.invMassA > 0 ? block.a : block.b);
    };
    parts_.clear();
    partOfBody_.assign(bodies, kNullIndex);
    for (const std::size_t j : held_) {
        std::uint32_t& part = partOfBody_[rootOf(j)];
        if (part == kNullIndex) {
            part = static_cast<std::uint32_t>(parts_.size());
            parts_.emplace_back();
        }
        Part& own = parts_[part];
        ++own.last;
        own.error = std::max(own.error, errorOf(joints_[j]));
        own.hangs = own.hangs || !(joints_[j].block.invMassA > 0 && joints_[j].block.invMassB > 0);
    }
    std::uint32_t first = 0;
    for (Part& part : parts_) {
        part.first = first;
        first += std::exchange(part.last, first);
    }
    members_.resize(held_.size());
    items_.clear();
    for (std::uint32_t k = 0; k < held_.size(); ++k) {
        const JointPositions<S>& joint = joints_[held_[k]];
        items_.push_back({&joint.block, joint.row.data()});
        const std::uint32_t part = partOfBody_[rootOf(held_[k])];
        members_[parts_[part].last++] = k;
        if (joint.block.invMassA > 0) partOfBody_[joint.block.a] = part;
        if (joint.block.invMassB > 0) partOfBody_[joint.block.b] = part;
    }
    for (const std::size_t j : closing_) partOf(joints_[j].block.a)->looped = true;
    fits_ = system_.begin(items_);
}

template <class S>
void JointNewton<S>::evaluate(const PositionProblem<S>& problem, Part& part) {
    part.before = part.error;
    part.error = 0;
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        JointPositions<S>& joint = joints_[jointOf(m)];
        problem.evaluateJoint(jointOf(m), joint);
        part.error = std::max(part.error, errorOf(joint));
    }
}

template <class S>
void JointNewton<S>::move(PositionProblem<S>& problem, Part& part) {
    if (!fits_ || part.slow) return moveOneByOne(problem, part);
    for (std::uint32_t m = part.first; m < part.last; ++m)
        items_[members_[m]] = {&joints_[jointOf(m)].block, joints_[jointOf(m)].row.data()};
    system_.factor(items_, system_.partOf(members_[part.first]));
    moveTogether(problem, part);
}

template <class S>
void JointNewton<S>::moveTogether(PositionProblem<S>& problem, const Part& part) {
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        const JointPositions<S>& joint = joints_[jointOf(m)];
        for (std::size_t r = 0; r < joint.block.rows; ++r) system_.at(members_[m])[r] = -joint.row[r].error;
    }
    system_.solve(system_.partOf(members_[part.first]));
    for (std::uint32_t m = part.first; m < part.last; ++m)
        moveJoint(problem, joints_[jointOf(m)], system_.at(members_[m]));
    problem.applyRotations();
}

template <class S>
void JointNewton<S>::moveOneByOne(PositionProblem<S>& problem, const Part& part) {
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        JointPositions<S>& joint = joints_[jointOf(m)];
        problem.evaluateJoint(jointOf(m), joint);
        BlockVector<S> error(joint.block.rows);
        for (int r = 0; r < joint.block.rows; ++r) error[r] = joint.row[static_cast<std::size_t>(r)].error;
        BlockMatrix<S> inverseK;
        invertBlock<S>(joint.row.data(), joint.block, inverseK);
        const BlockVector<S> lambda = -(inverseK * error);
        moveJoint(problem, joint, lambda.data());
        problem.applyRotations();
    }
}

template <class S>
void JointNewton<S>::approach(PositionProblem<S>& problem, Part& part, int iterations, bool evaluated) {
    for (int i = 0; i < iterations && !part.settled; ++i) {
        if (i > 0 || !evaluated) evaluate(problem, part);
        move(problem, part);
        if (part.error < Real(0.5) * part.before) continue;
        // Rounding is reached, or Newton's iteration has been too far off. Where it brings nothing at all, joint by joint
        // is slow and sure.
        part.settled = part.error < kRounding;
        part.slow = part.slow || !(part.error < part.before || part.settled);
    }
}

template <class S>
void JointNewton<S>::renewDamping(Part& part) {
    if (part.looped && part.before > 0 && !(part.error < part.before))
        part.damping = std::clamp(100 * part.damping, kLeastDamping, kMostDamping);
    else if ((part.damping *= Real(0.5)) < kLeastDamping)
        part.damping = 0;
}

template <class S>
void JointNewton<S>::damp(JointPositions<S>& joint, Real damping) {
    for (std::size_t r = 0; r < joint.block.rows; ++r)
        if (joint.row[r].invK > 0) joint.row[r].softness = damping / joint.row[r].invK;
}

template <class S>
void JointNewton<S>::approachFurther(PositionProblem<S>& problem, Part& part, int iterations, Real near) {
    for (int i = 0; i < iterations && !part.settled && part.error >= near; ++i) {
        evaluate(problem, part);
        part.settled = part.before > 0 && !(part.error < Real(0.5) * part.before) && part.error < kRounding;
        renewDamping(part);
        for (std::uint32_t m = part.first; part.damping > 0 && m < part.last; ++m)
            damp(joints_[jointOf(m)], part.damping);
        part.slow = false;
        move(problem, part);
    }
}

/// Adds what the joints of a part make of an impulse along `row`.
template <class S>
void JointNewton<S>::hold(const Part& part, const Block<S>& block, const Row<S>& row) {
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        const JointPositions<S>& joint = joints_[jointOf(m)];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            system_.at(members_[m])[r] = -blockCoupling<S>(joint.row[r], joint.block, row, block);
    }
    system_.solve(system_.partOf(members_[part.first]));
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        const JointPositions<S>& joint = joints_[jointOf(m)];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            applyRowImpulse<S>(joint.row[r], joint.block, system_.at(members_[m])[r], motion_[joint.block.a],
                               motion_[joint.block.b]);
    }
}

template <class S>
typename S::Real JointNewton<S>::reach(const Block<S>& block, const Row<S>& row, std::vector<Reach>& out) {
    motion_.resize(
        std::max({motion_.size(), partOfBody_.size(), std::size_t(block.a) + 1, std::size_t(block.b) + 1}));
    applyRowImpulse<S>(row, block, Real(1), motion_[block.a], motion_[block.b]);
    const Part* const a = block.invMassA > 0 ? partOf(block.a) : nullptr;
    const Part* const b = block.invMassB > 0 ? partOf(block.b) : nullptr;
    const bool holdsA = a != nullptr && a->holds, holdsB = b != nullptr && b->holds && b != a;
    if (holdsA) hold(*a, block, row);
    if (holdsB) hold(*b, block, row);
    const Real way = rowVelocity<S>(row, motion_[block.a], motion_[block.b]);
    takeMotions(block, out);
    if (holdsA) takeMotions(*a, out);
    if (holdsB) takeMotions(*b, out);
    return way;
}

/// Takes the motions of the bodies of a block to `out`, unless they are there.
template <class S>
void JointNewton<S>::takeMotions(const Block<S>& block, std::vector<Reach>& out) {
    for (const std::uint32_t body : {block.a, block.b}) {
        const Velocity<S> motion = std::exchange(motion_[body], Velocity<S>());
        if (motion.v.isZero(0) && dotAng(motion.w, motion.w) == Real(0)) continue;
        out.push_back({body, motion});
    }
}

template <class S>
void JointNewton<S>::takeMotions(const Part& part, std::vector<Reach>& out) {
    for (std::uint32_t m = part.first; m < part.last; ++m) takeMotions(joints_[jointOf(m)].block, out);
}

RIGOR_INSTANTIATE_CLASS(JointNewton)

}  // namespace rigor::engine
