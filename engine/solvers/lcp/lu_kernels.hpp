// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The step of Gaussian elimination that costs n^2, in SIMD. The instruction set is chosen when the program runs; every
// element goes through the same operations in the same order on all of them, so that the results are the same to the bit.
#pragma once

#include <cstddef>

namespace rigor::engine {

/// A row-major matrix that is n wide, one past the last row to change, and of each row one past its last column that is not
/// zero.
struct LuRows {
    double* at = nullptr;
    std::size_t n = 0;
    std::size_t below = 0;
    std::size_t* end = nullptr;
};

/// Subtracts multiples of row k from the rows below it, so that column k is zero there, where the multiples are stored.
void eliminateColumn(const LuRows& rows, std::size_t k);

}  // namespace rigor::engine
