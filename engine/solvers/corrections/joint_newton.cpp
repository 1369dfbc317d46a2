// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/corrections/joint_newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rigor::engine {
namespace {

/// J1 M^-1 J2^T of rows of two blocks, by the bodies that both move.
template <class S>
typename S::Real couplingOf(const Block<S>& block1, const Row<S>& row1, const Block<S>& block2,
                            const Row<S>& row2) {
    typename S::Real sum = 0;
    for (const bool isB1 : {false, true})
        for (const bool isB2 : {false, true}) {
            const typename S::Real invMass = isB1 ? block1.invMassB : block1.invMassA;
            if (!(invMass > 0) || (isB1 ? block1.b : block1.a) != (isB2 ? block2.b : block2.a)) continue;
            sum += (isB1 == isB2 ? invMass : -invMass) * row1.lin.dot(row2.lin) +
                   dotAng(isB1 ? row1.angB : row1.angA, isB2 ? row2.invIAngB : row2.invIAngA);
        }
    return sum;
}

}  // namespace

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
    part.factored = true;
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

/// The motion of a body among those that reach() finds.
template <class S>
Velocity<S>& JointNewton<S>::motionOf(std::uint32_t body, std::vector<Reach>& out) {
    if (body >= placeOf_.size()) placeOf_.resize(body + 1, kNullIndex);
    if (placeOf_[body] == kNullIndex) {
        placeOf_[body] = static_cast<std::uint32_t>(out.size());
        out.push_back({body, Velocity<S>()});
    }
    return out[placeOf_[body]].motion;
}

/// Adds what the joints of a part make of an impulse along `row`.
template <class S>
void JointNewton<S>::hold(const Part& part, const Block<S>& block, const Row<S>& row,
                          std::vector<Reach>& out) {
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        const JointPositions<S>& joint = joints_[jointOf(m)];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            system_.at(members_[m])[r] = -couplingOf<S>(joint.block, joint.row[r], block, row);
    }
    system_.solve(system_.partOf(members_[part.first]));
    for (std::uint32_t m = part.first; m < part.last; ++m) {
        const JointPositions<S>& joint = joints_[jointOf(m)];
        for (std::size_t r = 0; r < joint.block.rows; ++r)
            push(joint.block, joint.row[r], system_.at(members_[m])[r], out);
    }
}

template <class S>
void JointNewton<S>::push(const Block<S>& block, const Row<S>& row, Real impulse, std::vector<Reach>& out) {
    if (block.invMassA > 0) {
        Velocity<S>& motion = motionOf(block.a, out);
        motion.v -= (block.invMassA * impulse) * row.lin;
        motion.w += impulse * row.invIAngA;
    }
    if (block.invMassB > 0) {
        Velocity<S>& motion = motionOf(block.b, out);
        motion.v += (block.invMassB * impulse) * row.lin;
        motion.w += impulse * row.invIAngB;
    }
}

template <class S>
typename S::Real JointNewton<S>::reach(const Block<S>& block, const Row<S>& row, std::vector<Reach>& out) {
    const std::size_t first = out.size();
    push(block, row, Real(1), out);
    const Part* const a = block.invMassA > 0 ? partOf(block.a) : nullptr;
    const Part* const b = block.invMassB > 0 ? partOf(block.b) : nullptr;
    if (a != nullptr && a->holds) hold(*a, block, row, out);
    if (b != nullptr && b->holds && b != a) hold(*b, block, row, out);
    const Velocity<S> still;
    const Real way = rowVelocity<S>(row, block.invMassA > 0 ? motionOf(block.a, out) : still,
                                    block.invMassB > 0 ? motionOf(block.b, out) : still);
    for (std::size_t k = first; k < out.size(); ++k) placeOf_[out[k].body] = kNullIndex;
    return way;
}

RIGOR_INSTANTIATE_CLASS(JointNewton)

}  // namespace rigor::engine
