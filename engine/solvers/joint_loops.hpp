// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Closed loops of joints: joints whose two bodies others connect already, if only through bodies that no impulse moves.
// The rows of trees are independent, those of loops may not be.
#pragma once

#include <cstdint>
#include <span>

#include "engine/constraints/row.hpp"
#include "engine/core/disjoint_sets.hpp"

namespace rigor::engine {

class JointLoops {
  public:
    /// Calls closes(k) for each block of equality rows blocks[k] that closes a loop. Cost: O(blocks + bodies) where there
    /// are joints, else O(blocks).
    template <class S, class Use>
    void find(std::span<const Block<S>> blocks, std::size_t bodies, const Use& closes) {
        bool begun = false;
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            const Block<S>& block = blocks[k];
            if (block.kind != BlockKind::Joint) continue;
            if (!begun) sets_.begin(static_cast<std::uint32_t>(bodies) + 1);
            begun = true;
            const auto ground = static_cast<std::uint32_t>(bodies);
            const std::uint32_t a = sets_.rootOf(block.invMassA > 0 ? block.a : ground);
            const std::uint32_t b = sets_.rootOf(block.invMassB > 0 ? block.b : ground);
            if (a == b)
                closes(k);
            else
                sets_.join(a, b);
        }
    }

  private:
    DisjointSets sets_;
};

}  // namespace rigor::engine
