// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An order of blocks in which the matrix of their rows has its entries near the diagonal, for DenseLu: bodies level by
// level from one that is far from another (breadth-first, twice) [CuthillMcKee1969], and blocks by the later of
// their two bodies. A stack is then ordered from one end to the other, whichever way it was put together. Bodies that
// impulses do not move connect nothing.
// Cost: O(blocks log blocks).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"

namespace rigor::engine {

class EliminationOrder {
  public:
    /// Orders `part`, indices of `blocks` that are connected by bodies. Blocks of the same two bodies keep their
    /// order, and a moment's block stays behind its contact's.
    template <class S>
    void apply(std::span<const Block<S>> blocks, std::size_t bodies, std::vector<std::uint32_t>& part);
    /// Multiplications that DenseLu needs for the rows in that order at most, without pivoting.
    double cost() const { return cost_; }

  private:
    struct Key {
        std::uint32_t later, earlier, block;
        bool operator<(const Key& other) const;
    };
    template <class S>
    void connect(std::span<const Block<S>> blocks, std::span<const std::uint32_t> part, std::size_t bodies);
    std::uint32_t visitFrom(std::uint32_t start);
    template <class S>
    void estimate(std::span<const Block<S>> blocks);

    std::vector<std::uint32_t> local_;           ///< number of each body within the part
    std::vector<std::uint32_t> first_, second_;  ///< bodies of each block of the part, by that number
    std::vector<std::uint32_t> start_, other_;   ///< neighbours of each body
    std::vector<std::uint32_t> queue_, place_;   ///< bodies in the order of visits, and back
    std::vector<std::uint32_t> lastRow_;         ///< one past the last row of each body
    std::vector<Key> keys_;
    double cost_ = 0;
};

}  // namespace rigor::engine
