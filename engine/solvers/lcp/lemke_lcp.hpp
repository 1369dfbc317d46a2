// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The linear complementarity problem w = M z + q, 0 <= w _|_ z >= 0, by Lemke's method [Lemke1965],
// [CottlePangStone2009, section 4.4].
//
// An artificial z_0 >= 0 times the covering vector e makes w = M z + q + e z_0 feasible. The method walks
// along the almost complementary solutions (w_i z_i = 0 for all i but one pair): z_0 enters where w would be
// most negative, then the complement of whatever left enters, until z_0 itself leaves (a solution), or
// nothing stops the entering variable (a ray). For copositive-plus M a ray means that there is no solution;
// the matrix of the friction problem is copositive, and has one [AnitescuPotra1997].
//
// Cycle guard: degenerate problems tie in the ratio test. q stands for (q, I) epsilon^k, ties are broken by
// the lexicographic order of the rows of the basis inverse, and no basis occurs twice. The rows of the
// inverse are in the dictionary: the column of w_k where w_k is not basic, a unit vector where it is.
//
// The final basis is solved again from M and q, which undoes the rounding of the pivots.
// Cost: N^2 per pivot, N..3N pivots.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/solvers/lcp/dense.hpp"

namespace rigor::engine {

class LemkeLcp {
  public:
    enum class Outcome { Solved, Ray, TooManyPivots };
    /// M is n x n row by row. z holds the solution; where it is not Solved, the last basis with its negative
    /// parts cut off.
    Outcome solve(std::size_t n, const double* M, const double* q, double* z);
    int pivots() const { return pivots_; }

  private:
    double& T(std::size_t i, std::size_t j) { return dictionary_[i * (n_ + 1) + j]; }
    std::size_t leaving(std::size_t column) const;
    bool lexicographicallyLess(std::size_t a, std::size_t b, std::size_t column) const;
    void pivot(std::size_t row, std::size_t column);
    std::size_t columnOf(std::size_t variable) const;
    void readSolution(const double* M, const double* q, double* z);

    // Variables: w_k is k, z_k is n + k, z_0 is 2n.
    std::size_t n_ = 0;
    std::vector<double> dictionary_;  ///< basic = constant + T nonbasic
    std::vector<double> constant_;
    std::vector<std::size_t> basic_, nonbasic_;
    std::vector<std::size_t> where_;  ///< place of each variable: row if basic, n + column if not
    DenseLu lu_;
    std::vector<double> right_, check_;
    std::vector<std::size_t> in_;
    double noise_ = 0;
    int pivots_ = 0;
};

}  // namespace rigor::engine
