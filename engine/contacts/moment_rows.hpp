// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of rolling and torsional friction at a contact point (BlockKind::Moment). With t the tangents and n the
// normal, w = wB - wA, and the normal impulse lambda_n of the point,
//     rolling     |lambda_t| <= rho_r lambda_n opposes (t . w)           2D: w itself
//     torsional   |lambda_s| <= rho_t lambda_n opposes n . w             3D
// Coulomb's law in moments: where w is zero the moment is what keeps it so, up to the bound. rho_r and rho_t are
// lengths: half the length over which the pressure of the contact may move, and a mean radius of its area.
#pragma once

#include <array>

#include "engine/constraints/row.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Blocks and rows of a point with these coefficients, beside its contact block.
template <class S>
int momentBlocks(const PairCoefficients<S>& pair) {
    return (pair.rollingFriction > 0 ? 1 : 0) + (S::dim == 3 && pair.torsionalFriction > 0 ? 1 : 0);
}
template <class S>
int momentRows(const PairCoefficients<S>& pair) {
    return (pair.rollingFriction > 0 ? S::tangents : 0) + (S::dim == 3 && pair.torsionalFriction > 0 ? 1 : 0);
}

/// One block of rows about `axes`, of a point whose contact block is `contact`. block.first is set before.
template <class S, std::size_t n>
void makeMomentBlock(const Block<S>& contact, const std::array<typename S::Ang, n>& axes,
                     typename S::Real friction, const std::vector<typename S::Inertia>& invInertia,
                     Block<S>& block, Row<S>* rows) {
    using Real = typename S::Real;
    block.kind = BlockKind::Moment;
    block.rows = static_cast<std::uint8_t>(n);
    block.a = contact.a;
    block.b = contact.b;
    block.invMassA = contact.invMassA;
    block.invMassB = contact.invMassB;
    block.friction = friction;
    block.normal = contact.first;
    for (std::size_t i = 0; i < n; ++i) {
        rows[i] = Row<S>{};
        rows[i].angA = -axes[i];
        rows[i].angB = axes[i];
        completeRow<S>(rows[i], block, invInertia);
        rows[i].invK = Real(1) / rowCoupling<S>(rows[i], rows[i], block);
    }
    block.k11 = rowCoupling<S>(rows[0], rows[0], block);
    block.k12 = n > 1 ? rowCoupling<S>(rows[0], rows[n - 1], block) : Real(0);
    block.k22 = n > 1 ? rowCoupling<S>(rows[n - 1], rows[n - 1], block) : Real(1);
}

/// All moment blocks of a point with normal n and tangents t, consecutive like their rows, which begin at
/// `firstRow`.
template <class S>
void makeMomentBlocks(const Block<S>& contact, const PairCoefficients<S>& pair,
                      [[maybe_unused]] const typename S::Vec& n,
                      [[maybe_unused]] const std::array<typename S::Vec, S::tangents>& t,
                      const std::vector<typename S::Inertia>& invInertia, std::uint32_t firstRow,
                      Block<S>* blocks, Row<S>* rows) {
    using Ang = typename S::Ang;
    if (pair.rollingFriction > 0) {
        blocks->first = firstRow;
        if constexpr (S::dim == 2)
            makeMomentBlock<S, 1>(contact, {Ang(1)}, pair.rollingFriction, invInertia, *blocks, rows);
        else
            makeMomentBlock<S, 2>(contact, {t[0], t[1]}, pair.rollingFriction, invInertia, *blocks, rows);
        firstRow += S::tangents;
        rows += S::tangents;
        ++blocks;
    }
    if constexpr (S::dim == 3)
        if (pair.torsionalFriction > 0) {
            blocks->first = firstRow;
            makeMomentBlock<S, 1>(contact, {n}, pair.torsionalFriction, invInertia, *blocks, rows);
        }
}

}  // namespace rigor::engine
