// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/joint_set.hpp"

#include <algorithm>

namespace rigor::engine {
namespace {

// An anchor that swings by up to 0.4 rad in a step gets all of the term beyond the linear one, from 0.6 rad
// none: the end of the step says less and less about the direction to go, and the iteration may diverge.
// Chosen among 0.2..1 on whipping chains of ten links, where 0.9..1 gained energy.
constexpr double kFullSwing = 0.4, kNoSwing = 0.6;

template <class S>
typename S::Real endShare(typename S::Real h, const typename S::Ang& w, const typename S::Vec& arm) {
    using Real = typename S::Real;
    const Real length = arm.norm();
    if (!(length > 0)) return Real(1);
    const Real swing = h * cross(w, arm).norm() / length;
    return std::clamp((Real(kNoSwing) - swing) / Real(kNoSwing - kFullSwing), Real(0), Real(1));
}

}  // namespace

template <class S>
void JointSet<S>::addRows(const BodyArrays<S>& bodies, const JointStep<S>& step, ConstraintRows<S>& rows) {
    startErrors_.resize(records_.size());
    JointRows<S> made;
    for (std::size_t j = 0; j < records_.size(); ++j) {
        Record& record = records_[j];
        const std::uint32_t a = record.joint.a, b = record.joint.b;
        record.evaluate(record.joint, bodies.pose[a], bodies.pose[b], made);
        Block<S> block;
        block.kind = BlockKind::Joint;
        block.rows = static_cast<std::uint8_t>(made.count);
        block.first = static_cast<std::uint32_t>(rows.rows.size());
        block.a = a, block.b = b;
        block.invMassA = bodies.invMass[a], block.invMassB = bodies.invMass[b];
        block.matrix = static_cast<std::uint32_t>(rows.matrices.size());
        for (std::size_t i = 0; i < static_cast<std::size_t>(made.count); ++i) {
            Row<S> row = made.row[i];
            completeRow<S>(row, block, bodies.invInertia);
            row.impulse = step.warmStart * record.impulse[i];
            row.bias = step.biasFactor * made.error[i] / step.h;
            rows.rows.push_back(row);
        }
        startErrors_[j] = made.error;
        invertBlock<S>(rows.rows.data() + block.first, block, rows.matrices.emplace_back());
        record.block = static_cast<std::uint32_t>(rows.blocks.size());
        rows.blocks.push_back(block);
    }
}

template <class S>
void JointSet<S>::updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                               std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const {
    if (!step.curved) return;
    JointRows<S> end;
    const auto moved = [&](std::uint32_t i) -> Pose<S> {
        return {bodies.pose[i].p + step.h * velocities[i].v,
                rotatedBy(bodies.pose[i].q, typename S::Ang(step.h * velocities[i].w))};
    };
    for (std::size_t j = 0; j < records_.size(); ++j) {
        const Record& record = records_[j];
        const Block<S>& block = rows.blocks[record.block];
        const auto shareOf = [&](std::uint32_t i, const typename S::Vec& anchor) {
            return endShare<S>(step.h, velocities[i].w, rotate(bodies.pose[i].q, anchor));
        };
        const Real share =
            std::min(shareOf(block.a, record.joint.anchorA), shareOf(block.b, record.joint.anchorB));
        record.evaluate(record.joint, moved(block.a), moved(block.b), end);
        for (std::size_t i = 0; i < block.rows; ++i) {
            Row<S>& row = rows.rows[block.first + i];
            const Real beyondLinear = (end.error[i] - startErrors_[j][i]) / step.h -
                                      rowVelocity<S>(row, velocities[block.a], velocities[block.b]);
            row.bias = share * beyondLinear + step.biasFactor * startErrors_[j][i] / step.h;
        }
    }
}

template <class S>
void JointSet<S>::storeImpulses(const ConstraintRows<S>& rows) {
    for (Record& record : records_) {
        const Block<S>& block = rows.blocks[record.block];
        for (std::size_t i = 0; i < block.rows; ++i) record.impulse[i] = rows.rows[block.first + i].impulse;
    }
}

template class JointSet<Space2f>;
template class JointSet<Space2d>;
template class JointSet<Space3f>;
template class JointSet<Space3d>;

}  // namespace rigor::engine
