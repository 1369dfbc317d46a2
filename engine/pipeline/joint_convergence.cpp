// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/joint_convergence.hpp"

#include <algorithm>
#include <numeric>

namespace rigor::engine {

template <class S>
void JointConvergence<S>::remember(const JointSet<S>& joints, const ConstraintRows<S>& rows,
                                   std::span<const Velocity<S>> velocities) {
    if (joints.records().empty()) return;
    velocities_.assign(velocities.begin(), velocities.end());
    impulses_.clear();
    for (const Row<S>& row : rows.rows) impulses_.push_back(row.impulse);
}

/// The change of kinetic energy is the sum over all rows of impulse times mean of J v before and after.
template <class S>
void JointConvergence<S>::add(const Record& record, const ConstraintRows<S>& rows,
                              std::span<const Velocity<S>> velocities, bool ideal, Sum& sum) const {
    if (record.isIterated()) {
        sum.change.step = std::max(sum.change.step, record.change.step);
        sum.change.largest = std::max(sum.change.largest, record.change.largest);
    }
    if (!ideal || record.equalities == 0) return;
    const Block<S>& block = rows.blocks[record.block];
    for (std::uint32_t i = record.firstRow; i < record.firstRow + record.equalities; ++i) {
        const Row<S>& row = rows.rows[i];
        sum.work += row.impulse * (rowVelocity<S>(row, velocities_[block.a], velocities_[block.b]) +
                                   rowVelocity<S>(row, velocities[block.a], velocities[block.b]));
    }
    const auto addEnergy = [&](std::uint32_t body, Real invMass) {
        if (invMass > 0)
            sum.energy += (velocities_[body].v.squaredNorm() + velocities[body].v.squaredNorm()) / invMass;
    };
    addEnergy(block.a, block.invMassA);
    addEnergy(block.b, block.invMassB);
}

template <class S>
void JointConvergence<S>::find(const JointSet<S>& joints, const ConstraintRows<S>& rows,
                               std::span<const Velocity<S>> velocities, Real still, bool ideal) {
    working_.clear();
    changing_.clear();
    const auto hasRows = [](const Record& record) { return record.solved && record.rows > 0; };
    // A part works only if one of its joints does.
    const bool suspect =
        std::any_of(joints.records().begin(), joints.records().end(), [&](const Record& record) {
            if (!hasRows(record)) return false;
            Sum sum;
            add(record, rows, velocities, ideal, sum);
            return works(sum) || sum.change.step > still;
        });
    if (!suspect) return;
    units_.resize(rows.blocks.size() + 1);
    std::iota(units_.begin(), units_.end(), std::uint32_t(0));
    parts_.find<S>(rows.blocks, units_, velocities.size());
    sums_.assign(parts_.count(), Sum{});
    for (const Record& record : joints.records())
        if (hasRows(record)) add(record, rows, velocities, ideal, sums_[parts_.partOf(record.block)]);
    for (std::uint32_t block = 0; block < rows.blocks.size(); ++block) {
        const Sum& sum = sums_[parts_.partOf(block)];
        if (works(sum))
            working_.push_back(block);
        else if (sum.change.step > std::max(kSettled * sum.change.largest, still))
            changing_.push_back(block);
    }
}

template <class S>
void JointConvergence<S>::restart(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities) const {
    for (const std::uint32_t k : working_) {
        const Block<S>& block = rows.blocks[k];
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i)
            rows.rows[i].impulse = block.kind == BlockKind::Joint ? Real(0) : impulses_[i];
        if (block.invMassA > 0) velocities[block.a] = velocities_[block.a];
        if (block.invMassB > 0) velocities[block.b] = velocities_[block.b];
    }
}

RIGOR_INSTANTIATE_CLASS(JointConvergence)

}  // namespace rigor::engine
