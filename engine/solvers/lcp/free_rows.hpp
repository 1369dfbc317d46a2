// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The rows that are free (equality rows of joints) taken out of an assembled problem: their impulses follow from those
// of the other rows c, so that what is left is a problem of these alone, of the Schur complement of W_ee,
//     W'  = W_cc - W_ce W_ee^-1 W_ec,      w' = w_c - W_ce W_ee^-1 w_e,
//     d_e = -W_ee^-1 (w_e + W_ec d_c)
// [GolubVanLoan2013, section 3.2.6]. A few contacts of a long mechanism are then a problem of a few rows. Redundant free
// rows make W_ee singular, so that its diagonal counts (1 + kShift) fold; d_e has no part in what W_ee does not see.
// Cost of eliminate(): (free rows) * (width of W_ee in the order of the rows)^2, and twice that width for each free row
// and each other row. The rest is linear in the number of their pairs.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/solvers/lcp/assembled.hpp"

namespace rigor::engine {

class FreeRows {
  public:
    /// Takes the free rows of `whole` out. False: it has none, or no others, or W_ee is not positive
    /// definite.
    bool eliminate(const AssembledProblem& whole);
    /// The problem of the other rows, in their order, with the impulses and velocities that `whole` has now.
    const AssembledProblem& reduce(const AssembledProblem& whole);
    /// Impulses of all rows of `whole`, to those of the other rows; `whole` is that of the last reduce().
    void expand(const AssembledProblem& whole, const std::vector<double>& others, std::vector<double>& all);

  private:
    void separate(const AssembledProblem& whole);
    bool factor(const AssembledProblem& whole);
    void solve(double* x) const;
    void dropContradictions(const AssembledProblem& whole);
    void complement(const AssembledProblem& whole);

    static constexpr double kShift = 1e-10;
    std::vector<std::size_t> free_, others_;  ///< rows of the whole problem
    std::vector<std::size_t> place_;          ///< row of the whole problem, or its end -> index in others_
    std::vector<double> factor_;  ///< Cholesky factor, row by row, each from its first entry to its diagonal
    std::vector<std::size_t> first_, start_;  ///< column of each row's first entry, and its index in factor_
    std::vector<double> coupling_;            ///< W_ec, a column for each other row
    std::vector<double> follow_;              ///< W_ee^-1 W_ec, the same
    std::vector<double> rest_;                ///< W_ee^-1 w_e
    std::vector<double> change_, excess_;     ///< d_e, and its part that changes no w
    AssembledProblem reduced_;
};

}  // namespace rigor::engine
