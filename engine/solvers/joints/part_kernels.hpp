// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cholesky factor of a part of a joint system whose columns are short, block by block, in SIMD. The instruction
// set is chosen when the program runs; every element goes through the same operations in the same order on all
// of them, so that the results are the same to the bit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rigor::engine {

/// Numbers that a column of a block of `rows` rows takes: whole vectors of 16 bytes where that costs little.
template <class R>
constexpr int paddedRows(int rows) {
    constexpr int lanes = 16 / sizeof(R);
    return rows < 3 ? rows : (rows + lanes - 1) / lanes * lanes;
}

/// Blocks of one size, of whose rows only some are there. Positions count from the part's first.
template <class R>
struct JointPart {
    bool full;                    ///< all blocks have as many rows as the largest
    int size;                     ///< rows of a block, 1..6
    std::uint32_t columns;        ///< columns of blocks
    const std::uint8_t* rows;     ///< position -> rows of its item
    const std::size_t* start;     ///< column -> its first entry of `row`, and of one more
    const std::uint32_t* row;     ///< positions of the blocks below the diagonal, plus `first`
    std::uint32_t first;          ///< position that `row` counts from
    const std::uint32_t* target;  ///< block that each pair of entries of a column changes
    R *diagonal, *lower;          ///< blocks of K, then of L with the reciprocals of its diagonal
};

/// Right sides that solveLanes() takes at once: two vectors of 16 bytes, or one of 32.
template <class R>
inline constexpr std::size_t kJointLanes = 32 / sizeof(R);

/// K becomes L. floor[i]: at or below which the pivot of unknown i counts as zero, paddedRows() a block.
template <class R>
void factorPart(const JointPart<R>& part, const R* floor);
/// L L^T x = right side, in place, paddedRows() numbers a block.
template <class R>
void solvePart(const JointPart<R>& part, R* x);
/// The same for kJointLanes right sides, the numbers of one row together.
template <class R>
void solvePartLanes(const JointPart<R>& part, R* x);

}  // namespace rigor::engine
