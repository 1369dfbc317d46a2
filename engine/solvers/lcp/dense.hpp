// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Dense linear systems in double precision, in storage that is kept: solvers that treat all rows at once
// factor a matrix or more in every step and must not allocate. (Eigen's decompositions of dynamic size
// allocate their permutations; sizes here are a few hundred at most.)
#pragma once

#include <cstddef>
#include <vector>

namespace rigor::engine {

/// LU with partial pivoting of an n x n matrix, row by row in memory [GolubVanLoan2013, section 3.4]. Zeros
/// before the first entry of a row and behind its last cost nothing: a matrix whose entries are near the diagonal takes n
/// times the square of its band width.
class DenseLu {
  public:
    /// Makes room for n x n and returns the first entry, to be filled before factor().
    double* reset(std::size_t n);
    /// False where the matrix is singular to rounding (a pivot below 1e-14 of the largest entry of its
    /// column); such unknowns are then solved to zero.
    bool factor();
    /// b := A^-1 b.
    void solve(double* b) const;

  private:
    void measure();

    std::size_t n_ = 0;
    std::vector<double> a_;
    std::vector<std::size_t> swap_;
    // --- by row
    std::vector<std::size_t> first_;  ///< its first column that is not zero
    std::vector<std::size_t> end_;    ///< one past the last
    /// One past the last row that has an entry in a column or in one before it.
    std::vector<std::size_t> below_;
    std::vector<double> scale_;
};

/// Cholesky factor of the rows and columns F of a symmetric positive definite matrix, F growing at its end
/// and shrinking anywhere [GillGolubMurraySaunders1974].
class GrowingCholesky {
  public:
    void reset(std::size_t capacity);
    std::size_t size() const { return members_.size(); }
    std::size_t member(std::size_t k) const { return members_[k]; }
    /// Takes row i of A (row-major, n wide, `shift[i]` added to the diagonal) into F. O(size^2).
    void append(const double* A, std::size_t n, const double* shift, std::size_t i);
    /// Removes the k-th member by Givens rotations. O(size^2).
    void remove(std::size_t k);
    /// x := A_FF^-1 x, x in the order of the members.
    void solve(double* x) const;

  private:
    double& L(std::size_t i, std::size_t j) { return l_[i * capacity_ + j]; }
    double L(std::size_t i, std::size_t j) const { return l_[i * capacity_ + j]; }

    std::size_t capacity_ = 0;
    std::vector<double> l_;
    std::vector<std::size_t> members_;
};

}  // namespace rigor::engine
