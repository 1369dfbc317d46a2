// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A tree of bounding boxes with eight children per node, and the search for its pairs of overlapping leaves
// (wide_tree.cpp has the algorithm and the sources). Nodes are stored level by level in arrays, without
// pointers: child j of node k of level l is node 8k + j of level l - 1; the children of level 0 are the
// leaves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rigor::engine {

/// The boxes of the children of a node, axis by axis [m]. A child that is not there is not a number: no test
/// against it holds.
template <int dim>
struct alignas(64) WideNode {
    static constexpr std::size_t kChildren = 8;
    float lo[dim][kChildren], hi[dim][kChildren];
};

/// One bit per child: whether below it is a leaf of a movable proxy; of one that has changed.
struct WideMarks {
    std::uint8_t movable = 0, changed = 0;
};

/// Data that a search reads.
template <int dim>
struct WideTreeView {
    static constexpr std::size_t kMaxLevels = 12;  ///< 8^11 is more than there are proxies
    struct Level {
        const WideNode<dim>* nodes = nullptr;
        const WideMarks* marks = nullptr;
        std::size_t count = 0;
    };
    std::array<Level, kMaxLevels> levels;
    std::size_t top = 0;  ///< the level of the root, which is its only node

    /// The level whose nodes are the units of a search: each is one part of the work.
    std::size_t unitLevel() const { return top < 1 ? top : 1; }
    std::size_t units() const { return levels[unitLevel()].count; }
};

/// Cost of a search.
struct WideSearchCost {
    std::size_t tests = 0;   ///< box tests, eight at a time
    std::size_t visits = 0;  ///< pairs of nodes of level 0 that were compared
};

/// Two leaves.
struct LeafPair {
    std::uint32_t a, b;
};

/// Appends to `pairs` the pairs of leaves that overlap, at least one of them movable (and, with
/// `changedOnly`, at least one of them changed), with the first in the units [begin, end) and the second in
/// the same unit or a later one. The same pairs in the same order on every instruction set.
WideSearchCost searchWideTree(const WideTreeView<2>& tree, bool changedOnly, std::size_t begin,
                              std::size_t end, std::vector<LeafPair>& pairs);
WideSearchCost searchWideTree(const WideTreeView<3>& tree, bool changedOnly, std::size_t begin,
                              std::size_t end, std::vector<LeafPair>& pairs);

}  // namespace rigor::engine
