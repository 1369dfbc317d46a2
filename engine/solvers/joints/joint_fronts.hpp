// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sparse Cholesky by dense pieces, for nets of joints: see joint_fronts.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/solvers/joints/front_kernels.hpp"

namespace rigor::engine {

template <class R>
class JointFronts {
  public:
    /// The pattern of L in blocks of `size` numbers: column k has the rows row[start[k]] .. row[start[k + 1]
    /// - 1], growing, above k; k and the rows count from `first`, and columns are in a postorder of the
    /// elimination tree. Allocates.
    void analyse(std::span<const std::size_t> start, std::span<const std::uint32_t> row, std::uint32_t first,
                 int size);

    /// Offset in numbers() of a block of L, or of K before factor(); its columns are stride(column) apart.
    std::size_t placeOf(std::uint32_t row, std::uint32_t column) const;
    R* numbers() { return panels_.data(); }
    std::size_t stride(std::uint32_t column) const { return fronts_[front_[column]].stride; }
    /// K = 0, to be filled: the lower triangle of blocks, of diagonal blocks that of their numbers.
    void clear();
    /// K becomes L; floor[i]: at or below which the pivot of unknown i counts as zero.
    void factor(const R* floor);
    /// K x = right side, a number per unknown, in place.
    void solve(R* x);

  private:
    /// Columns with the same rows below them.
    struct Front {
        std::uint32_t first, width;    ///< columns, in blocks
        std::uint32_t row, rows;       ///< range in rows_ of the rows below, in blocks
        std::uint32_t run, runs;       ///< range in runs_ of the places of those rows in its parent
        std::uint32_t parent;          ///< kNullIndex: a root
        std::uint32_t child, sibling;  ///< the first that depends on it; the next of its parent
        std::size_t panel, stride;     ///< offset in panels_; distance between its columns
        std::size_t update, work;      ///< offsets in updates_ of its update of the parent, and of the work
                                       ///< space for it
    };
    /// Blocks that follow each other in a front and in its parent.
    struct Run {
        std::uint32_t from, to, count;
    };
    void findFronts(std::span<const std::size_t> start, std::span<const std::uint32_t> row,
                    std::uint32_t first);
    void layOut();
    void findRuns(Front& front);
    std::uint32_t placeIn(const Front& front, std::uint32_t row) const;
    void extend(const Front& child, const Front& parent);
    FrontPanel<R> panelOf(const Front& front);

    std::size_t size_ = 1;
    std::vector<Front> fronts_;
    std::vector<std::uint32_t> front_;  ///< front of each column
    std::vector<std::uint32_t> rows_;
    std::vector<Run> runs_;
    std::vector<R> panels_, updates_, gathered_;
};

}  // namespace rigor::engine
