// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Dense pieces of a sparse Cholesky factor, in SIMD. Matrices stand column by column, `stride` numbers from
// one column to the next. The instruction set is chosen when the program runs; every element goes through the
// same operations in the same order on all of them, so that the results are the same to the bit.
#pragma once

#include <cstddef>

namespace rigor::engine {

/// `columns` columns of `rows` rows: a lower triangle on top, the rows below it under that.
template <class R>
struct FrontPanel {
    R* at = nullptr;
    std::size_t stride = 0, rows = 0, columns = 0;
};

/// The first columns of a symmetric matrix become those of its Cholesky factor, with the reciprocals of its
/// diagonal. A pivot at its `floor` or below is one that rounding has spoilt: its unknown is left out, with
/// zeros in its column.
template <class R>
void factorPanel(const FrontPanel<R>& panel, const R* floor);
/// C -= A A^T for the rows A below the triangle, in the lower triangle of C.
template <class R>
void subtractSquare(const FrontPanel<R>& panel, R* C, std::size_t stride);
/// Number of elements behind a panel's last one, and behind y, that the next two functions may read, or write
/// in y.
inline constexpr std::size_t kFrontSlack = 64;
/// y, a number per row: its upper part becomes the solution for the triangle, whose products are subtracted
/// from the rest.
template <class R>
void solveForward(const FrontPanel<R>& panel, R* y);
/// The upper part of y becomes the solution for the transpose, with the rest given.
template <class R>
void solveBackward(const FrontPanel<R>& panel, R* y);

}  // namespace rigor::engine
