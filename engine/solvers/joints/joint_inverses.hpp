// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Inverse K of every joint block, for solvers that solve joints one by one.
#pragma once

#include "engine/constraints/row.hpp"

namespace rigor::engine {

/// Fills `matrices` for the present directions and softnesses of the rows, and numbers the blocks for them.
template <class S>
void invertJoints(ConstraintRows<S>& constraints) {
    constraints.matrices.clear();
    for (Block<S>& block : constraints.blocks) {
        if (block.kind != BlockKind::Joint) continue;
        block.matrix = static_cast<std::uint32_t>(constraints.matrices.size());
        invertBlock<S>(constraints.rows.data() + block.first, block, constraints.matrices.emplace_back());
    }
}

}  // namespace rigor::engine
