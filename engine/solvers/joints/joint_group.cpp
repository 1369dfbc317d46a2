// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/joints/joint_group.hpp"

#include <algorithm>

#include "engine/solvers/joints/joint_inverses.hpp"
#include "engine/solvers/sequential_impulses.hpp"

namespace rigor::engine {

template <class S>
void JointGroup<S>::begin(ConstraintRows<S>& constraints) {
    if (findBlocks(constraints)) findParts();
    items_.clear();
    for (const std::uint32_t k : equalities_) {
        const Block<S>& block = constraints.blocks[k];
        items_.push_back({&block, constraints.rows.data() + block.first});
    }
    direct_ = equalities_.size() > 1 && system_.factor(items_, *tasks_);
    if (!direct_) return invertJoints<S>(constraints);
    if (changed_) {
        findSystems();
        findNear();
        makeRoom();
    }
    for (Part& part : parts_) {
        part.count = 0;
        part.tooMany = false;
    }
    std::fill(acts_.begin(), acts_.end(), std::uint8_t(0));
}

template <class S>
void JointGroup<S>::warmStart(const ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) const {
    tasks_->forEach(parts_.size(), kGrain, [&](std::size_t p) {
        for (std::uint32_t k = parts_[p].block; k < parts_[p].lastBlock; ++k) {
            const Block<S>& block = constraints.blocks[blocks_[k]];
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
                const Row<S>& row = constraints.rows[i];
                applyRowImpulse<S>(row, block, row.impulse, velocities[block.a], velocities[block.b]);
            }
        }
    });
}

template <class S>
typename S::Real JointGroup<S>::solve(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) {
    tasks_->forEach(parts_.size(), kGrain,
                    [&](std::size_t p) { found_[p] = solvePart(parts_[p], constraints, velocities); });
    Real found = 0;
    for (const Real x : found_) found = std::max(found, x);
    return found;
}

template <class S>
typename S::Real JointGroup<S>::solvePart(Part& part, ConstraintRows<S>& constraints,
                                          std::span<Velocity<S>> velocities) {
    Real found = 0;
    if (direct_) {
        found = solveEqualities(part, constraints, velocities);
        if (part.bounded == part.lastBounded || solveActing(part, constraints, velocities, found))
            return found;
    }
    return std::max(found, solveInTurn(part, constraints, velocities));
}

/// Bounded rows one by one and equality rows in turn, or all blocks one by one where there are no factors.
template <class S>
typename S::Real JointGroup<S>::solveInTurn(const Part& part, ConstraintRows<S>& constraints,
                                            std::span<Velocity<S>> velocities) {
    Real found = 0;
    const int sweeps = part.lastBlock - part.block > 1 ? kSweeps : 1;
    for (int i = 0; i < sweeps; ++i) {
        Real largest = direct_ ? solveBounded(part, constraints, velocities)
                               : sweep(part, constraints, velocities, i % 2 != 0);
        if (direct_) largest = std::max(largest, solveEqualities(part, constraints, velocities));
        if (i == 0) found = largest;
        if (largest <= kTolerance * found) break;
    }
    return found;
}

template <class S>
typename S::Real JointGroup<S>::solveBounded(const Part& part, ConstraintRows<S>& constraints,
                                             std::span<Velocity<S>> velocities) const {
    Real largest = 0;
    for (std::uint32_t k = part.bounded; k < part.lastBounded; ++k) {
        const Block<S>& block = constraints.blocks[bounded_[k]];
        largest = std::max(largest, satisfyBoundedRow<S>(constraints.rows[block.first], block,
                                                         velocities[block.a], velocities[block.b]));
    }
    return largest;
}

template <class S>
typename S::Real JointGroup<S>::solveEqualities(const Part& part, ConstraintRows<S>& constraints,
                                                std::span<Velocity<S>> velocities) {
    Real largest = 0;
    for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
        const Block<S>& block = constraints.blocks[equalities_[k]];
        const Row<S>* rows = constraints.rows.data() + block.first;
        const Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
        Real* const right = system_.at(k);
        for (int i = 0; i < block.rows; ++i) {
            right[i] = -rowError<S>(rows[i], a, b);
            largest = std::max(largest, std::abs(right[i]));
        }
    }
    for (std::uint32_t k = part.system; k < part.lastSystem; ++k) system_.solve(systems_[k]);
    applyEqualities(part, constraints, velocities);
    return largest;
}

/// Applies the impulses that stand in system_.
template <class S>
void JointGroup<S>::applyEqualities(const Part& part, ConstraintRows<S>& constraints,
                                    std::span<Velocity<S>> velocities) {
    for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
        const Block<S>& block = constraints.blocks[equalities_[k]];
        Row<S>* rows = constraints.rows.data() + block.first;
        const Real* const lambda = system_.at(k);
        typename S::Vec push = S::Vec::Zero();
        typename S::Ang turnA = zeroAng<S>(), turnB = zeroAng<S>();
        for (int i = 0; i < block.rows; ++i) {
            rows[i].impulse += lambda[i];
            push += lambda[i] * rows[i].lin;
            turnA += lambda[i] * rows[i].invIAngA;
            turnB += lambda[i] * rows[i].invIAngB;
        }
        if (block.invMassA > 0) {
            velocities[block.a].v -= block.invMassA * push;
            velocities[block.a].w += turnA;
        }
        if (block.invMassB > 0) {
            velocities[block.b].v += block.invMassB * push;
            velocities[block.b].w += turnB;
        }
    }
}

template <class S>
typename S::Real JointGroup<S>::sweep(const Part& part, ConstraintRows<S>& constraints,
                                      std::span<Velocity<S>> velocities, bool backwards) const {
    Real largest = 0;
    for (std::uint32_t k = part.block; k < part.lastBlock; ++k) {
        const std::uint32_t i = backwards ? part.lastBlock - 1 - (k - part.block) : k;
        const Block<S>& block = constraints.blocks[blocks_[i]];
        Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
        largest = std::max(largest, block.kind == BlockKind::Joint
                                        ? satisfyJointBlock<S>(constraints, block, a, b)
                                        : satisfyBoundedRow<S>(constraints.rows[block.first], block, a, b));
    }
    return largest;
}

RIGOR_INSTANTIATE_CLASS(JointGroup)

}  // namespace rigor::engine
