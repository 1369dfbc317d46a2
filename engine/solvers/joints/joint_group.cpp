// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/joints/joint_group.hpp"

#include <algorithm>

#include "engine/solvers/joints/joint_inverses.hpp"
#include "engine/solvers/sequential_impulses.hpp"

namespace rigor::engine {

template <class S>
void JointGroup<S>::begin(ConstraintRows<S>& constraints) {
    all_.clear();
    equalities_.clear();
    bounded_.clear();
    items_.clear();
    for (std::uint32_t i = 0; i < constraints.blocks.size(); ++i) {
        const Block<S>& block = constraints.blocks[i];
        if (block.kind == BlockKind::Contact) continue;
        all_.push_back(i);
        if (block.kind == BlockKind::Bounded) {
            bounded_.push_back(i);
            continue;
        }
        equalities_.push_back(i);
        items_.push_back({&block, constraints.rows.data() + block.first});
    }
    direct_ = equalities_.size() > 1 && system_.factor(items_);
    if (!direct_) invertJoints<S>(constraints);
}

template <class S>
void JointGroup<S>::warmStart(const ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) const {
    for (const std::uint32_t k : all_) {
        const Block<S>& block = constraints.blocks[k];
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = constraints.rows[i];
            applyRowImpulse<S>(row, block, row.impulse, velocities[block.a], velocities[block.b]);
        }
    }
}

template <class S>
typename S::Real JointGroup<S>::solve(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) {
    Real found = 0;
    const int sweeps = (direct_ ? bounded_.size() + 1 : all_.size()) > 1 ? kSweeps : 1;
    for (int i = 0; i < sweeps; ++i) {
        Real largest =
            direct_ ? solveBounded(constraints, velocities) : sweep(constraints, velocities, i % 2 != 0);
        if (direct_) largest = std::max(largest, solveEqualities(constraints, velocities));
        if (i == 0) found = largest;
        if (largest <= kTolerance * found) break;
    }
    return found;
}

template <class S>
typename S::Real JointGroup<S>::solveBounded(ConstraintRows<S>& constraints,
                                             std::span<Velocity<S>> velocities) const {
    Real largest = 0;
    for (const std::uint32_t k : bounded_) {
        const Block<S>& block = constraints.blocks[k];
        largest = std::max(largest, satisfyBoundedRow<S>(constraints.rows[block.first], block,
                                                         velocities[block.a], velocities[block.b]));
    }
    return largest;
}

template <class S>
typename S::Real JointGroup<S>::solveEqualities(ConstraintRows<S>& constraints,
                                                std::span<Velocity<S>> velocities) {
    Real largest = 0;
    for (std::size_t k = 0; k < equalities_.size(); ++k) {
        const Block<S>& block = constraints.blocks[equalities_[k]];
        const Row<S>* rows = constraints.rows.data() + block.first;
        const Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
        Real* const right = system_.at(k);
        for (int i = 0; i < block.rows; ++i) {
            right[i] = -rowError<S>(rows[i], a, b);
            largest = std::max(largest, std::abs(right[i]));
        }
    }
    system_.solve();
    for (std::size_t k = 0; k < equalities_.size(); ++k) {
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
    return largest;
}

template <class S>
typename S::Real JointGroup<S>::sweep(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities,
                                      bool backwards) const {
    Real largest = 0;
    for (std::size_t k = 0; k < all_.size(); ++k) {
        const Block<S>& block = constraints.blocks[all_[backwards ? all_.size() - 1 - k : k]];
        Velocity<S>&a = velocities[block.a], &b = velocities[block.b];
        largest = std::max(largest, block.kind == BlockKind::Joint
                                        ? satisfyJointBlock<S>(constraints, block, a, b)
                                        : satisfyBoundedRow<S>(constraints.rows[block.first], block, a, b));
    }
    return largest;
}

RIGOR_INSTANTIATE_CLASS(JointGroup)

}  // namespace rigor::engine
