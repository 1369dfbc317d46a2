// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The rows that are free (equality rows of joints) taken out of an assembled problem: their impulses follow from those
// of the other rows c, so that what is left is a problem of these alone, of the Schur complement of W_ee,
//     W'  = W_cc - W_ce W_ee^-1 W_ec,      w' = w_c - W_ce W_ee^-1 w_e,
//     d_e = -W_ee^-1 (w_e + W_ec d_c)
// [GolubVanLoan2013, section 3.2.6]. With W_ee = L L^T, the columns H = L^-1 W_ec are enough for all of it. A few contacts of
// a long mechanism are then a problem of a few rows. Redundant free rows make W_ee singular, so that its diagonal counts
// (1 + shift) fold; d_e has no part in what W_ee does not see. Where rows are rounded to single precision, so is what makes
// them redundant: a shift far below that takes rounding for stiffness, and impulses grow until nothing else is left of them.
// Cost of eliminate(): (free rows) * (width of W_ee in the order of the rows)^2, and that width for each free row
// and each other row. The rest is linear in the number of their pairs.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/solvers/lcp/assembled.hpp"

namespace rigor::engine {

class FreeRows {
  public:
    /// `shift` for rows in double precision.
    static constexpr double kShift = 1e-10;

    /// Takes the free rows of `whole` out. False: it has none, or no others, or W_ee is not positive
    /// definite.
    bool eliminate(const AssembledProblem& whole, double shift = kShift);
    /// The problem of the other rows, in their order, with the impulses and velocities that `whole` has now.
    const AssembledProblem& reduce(const AssembledProblem& whole);
    /// Impulses of all rows of `whole`, to those of the other rows; `whole` is that of the last reduce().
    void expand(const AssembledProblem& whole, const std::vector<double>& others, std::vector<double>& all);

  private:
    void separate(const AssembledProblem& whole);
    bool factor(const AssembledProblem& whole);
    void solveLower(double* x, std::size_t from) const;
    void solveUpper(double* x) const;
    void dropContradictions(const AssembledProblem& whole);
    void complement(const AssembledProblem& whole);

    /// Pivots of redundant rows are less than this times their shift.
    static constexpr double kMostShift = 100;
    double shift_ = kShift;
    bool redundant_ = false;                  ///< some free rows follow from others
    std::vector<std::size_t> free_, others_;  ///< rows of the whole problem
    std::vector<std::size_t> place_;          ///< row of the whole problem, or its end -> index in others_
    std::vector<double> factor_;  ///< Cholesky factor, row by row, each from its first entry to its diagonal
    std::vector<std::size_t> first_, start_;  ///< column of each row's first entry, and its index in factor_
    std::vector<double> half_;                ///< H, a column for each other row
    std::vector<std::size_t> begin_;          ///< the first entry of each column that is not zero
    std::vector<double> rest_;                ///< L^-1 w_e
    std::vector<double> change_, excess_;     ///< d_e, and its part that changes no w
    AssembledProblem reduced_;
};

}  // namespace rigor::engine
