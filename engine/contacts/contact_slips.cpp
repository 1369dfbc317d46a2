// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Friction that opposes the mean slip of a step and not that at its end: for integrators of second order.
#include <algorithm>

#include "engine/contacts/contact_rows.hpp"

namespace rigor::engine {
namespace {

/// A slip u at the end of a step plus this bias has the direction of the mean slip, and the length of u: a
/// contact sticks where it would without. Where the slip turns far or nearly ends within the step there is no
/// bias: the mean says little then, and the iteration that renews the bias might not converge.
template <class R, int N>
Eigen::Matrix<R, N, 1> slipBias(const Eigen::Matrix<R, N, 1>& before, const Eigen::Matrix<R, N, 1>& after) {
    const R length = after.norm(), first = before.norm();
    if (!(length > R(0.1) * first) || !(first > 0)) return Eigen::Matrix<R, N, 1>::Zero();
    const R cosine = before.dot(after) / (first * length);
    const R share = std::min({R(1), R(5) * (length / first - R(0.1)), R(4) * (cosine - R(0.5))});
    if (!(share > 0)) return Eigen::Matrix<R, N, 1>::Zero();
    const Eigen::Matrix<R, N, 1> mean = before + after;
    return share * (mean * (length / mean.norm()) - after);
}

}  // namespace

/// Slips that forces make and unmake within a step are left out: contacts that stick. In 2D all slips of a
/// contact have one direction.
template <class S>
void RowContacts<S>::findSlips(const ContactList<S>& contacts, const BodyArrays<S>& bodies,
                               const ContactStep<S>& step, const ConstraintRows<S>& rows) {
    slips_.clear();
    slipOf_.clear();
    if (S::dim == 2 || !step.meanSlip) return;
    const Real slowest = Real(0.05) * step.restingGap / step.h;
    for (const std::uint32_t k : own_) {
        const Contact<S>& contact = contacts[k];
        for (std::size_t i = 0; contact.blocks > 0 && i < contact.block.size(); ++i) {
            if (contact.block[i] == kNullIndex) continue;
            const Block<S>& block = rows.blocks[contact.block[i]];
            if (block.rows < 2) continue;
            Slip slip{contact.block[i], {}, {}};
            const auto basis = tangentBasis<S>(contact.manifold.normal);
            for (std::size_t t = 0; t < slip.before.size(); ++t) {
                const Row<S>& row = rows.rows[block.first + 1 + t];
                slip.surface[t] = row.bias;
                slip.before[t] = rowVelocity<S>(row, bodies.velocity[block.a], bodies.velocity[block.b]);
                if (row.bias != 0) slip.before[t] += row.bias;
                if (step.rowsLag) slip.before[t] -= Real(2) * lags_[k][i].slip.dot(basis[t]);
            }
            const Real first = slip.before.front(), second = slip.before.back();
            if (first * first + second * second > slowest * slowest) slips_.push_back(slip);
        }
    }
    if (slips_.empty()) return;
    slipOf_.resize(rows.blocks.size(), kNullIndex);
    for (std::size_t k = 0; k < slips_.size(); ++k) slipOf_[slips_[k].block] = static_cast<std::uint32_t>(k);
}

template <class S>
void RowContacts<S>::updateSlips(std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const {
    for (const Slip& slip : slips_) updateSlip(slip, velocities, rows);
}

template <class S>
void RowContacts<S>::updateSlips(std::span<const Velocity<S>> velocities,
                                 std::span<const std::uint32_t> blocks, ConstraintRows<S>& rows) const {
    for (const std::uint32_t block : blocks)
        if (hasSlip(block)) updateSlip(slips_[slipOf_[block]], velocities, rows);
}

template <class S>
void RowContacts<S>::updateSlip(const Slip& slip, std::span<const Velocity<S>> velocities,
                                ConstraintRows<S>& rows) const {
    const Block<S>& block = rows.blocks[slip.block];
    Row<S>* tangents = rows.rows.data() + block.first + 1;
    Eigen::Matrix<Real, S::tangents, 1> before, after;
    for (int i = 0; i < S::tangents; ++i) {
        before[i] = slip.before[static_cast<std::size_t>(i)];
        after[i] = rowVelocity<S>(tangents[i], velocities[block.a], velocities[block.b]);
        if (slip.surface[static_cast<std::size_t>(i)] != 0)
            after[i] += slip.surface[static_cast<std::size_t>(i)];
    }
    const Eigen::Matrix<Real, S::tangents, 1> bias = slipBias<Real, S::tangents>(before, after);
    for (int i = 0; i < S::tangents; ++i) {
        tangents[i].bias = bias[i];
        if (slip.surface[static_cast<std::size_t>(i)] != 0)
            tangents[i].bias += slip.surface[static_cast<std::size_t>(i)];
        tangents[i].relaxedBias = tangents[i].bias;
    }
}

#define RIGOR_INSTANTIATE(S)                                                                                \
    template void RowContacts<S>::findSlips(const ContactList<S>&, const BodyArrays<S>&,                    \
                                            const ContactStep<S>&, const ConstraintRows<S>&);               \
    template void RowContacts<S>::updateSlips(std::span<const Velocity<S>>, ConstraintRows<S>&) const;      \
    template void RowContacts<S>::updateSlips(std::span<const Velocity<S>>, std::span<const std::uint32_t>, \
                                              ConstraintRows<S>&) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
