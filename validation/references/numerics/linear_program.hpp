// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Linear programs, minimise c.x over A x = b, x >= 0, by the two-phase revised simplex method in extended
// precision. Columns may be added between two calls; the basis is kept. Entries of A and b should be of order
// 1. Pivots are bounded, so a call always ends, and what it returns is a candidate: x and the multipliers y
// have to be checked by the caller in exact arithmetic (force_balance.hpp). Pricing takes the
// least reduced cost, each weighted with a random factor, which leaves cycles; the ratio test is that of
// Harris, which chooses the largest pivot among the nearly equal ratios. The inverse of the basis is computed
// anew every 100 pivots and before every result; where it is singular to rounding, the first phase starts
// again with other random factors. Source: Dantzig, Linear Programming and Extensions, 1963; Harris, Math.
// Program. 5 (1973) 1.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <random>
#include <vector>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

class LinearProgram {
  public:
    struct Entry {
        std::size_t row = 0;
        Real value = 0;
    };
    using Column = std::vector<Entry>;

    explicit LinearProgram(std::vector<Real> right);

    /// Adds an unknown with its entries of A; returns its index.
    std::size_t addColumn(Column column);
    std::size_t columns() const { return columns_.size(); }

    enum class Status {
        Optimal,
        Unbounded,
        Stalled  ///< no result within the allowed pivots, or the basis is singular to rounding
    };
    /// Least violation, the sum of |A x - b| over x >= 0. Afterwards y.A_j <= 0 for every column, and y.b is
    /// the violation.
    Status reduceViolation();
    /// Least c.x over the feasible set, from a point that reduceViolation() has found to be feasible.
    /// Afterwards y.A_j <= c_j for every column, and y.b is the value.
    Status minimise(const std::vector<Real>& cost);

    /// Sum of |A x - b| at the last point.
    Real violation() const;
    /// The last point, one value for each column, none negative.
    std::vector<Real> point() const;
    /// The multipliers y of the last call, one for each row.
    std::vector<Real> multipliers() const;

  private:
    using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
    /// A basic unknown: a column, or the artificial unknown of a row.
    struct Basic {
        bool artificial = true;
        std::size_t index = 0;
    };
    enum class Phase { Violation, Cost };

    void restart();
    Status run(Phase phase, const std::vector<Real>& cost);
    bool refactor(Phase phase, const std::vector<Real>& cost);
    Real costOf(Basic basic, Phase phase, const std::vector<Real>& cost) const;
    /// The column to enter, or columns() where none has a negative reduced cost.
    std::size_t entering(Phase phase, const std::vector<Real>& cost, Real& reduced);
    /// The row of the basis to leave, or rows where none limits the step.
    Eigen::Index leaving(Phase phase, const Vector& direction) const;

    Eigen::Index rows_ = 0;
    Vector right_;
    std::vector<Column> columns_;
    std::vector<bool> inBasis_;
    std::vector<Basic> basis_;
    std::vector<Real> sign_;  ///< sign of the artificial unknown of each row
    Matrix inverse_;          ///< inverse of the basis
    Vector value_;            ///< values of the basic unknowns
    Vector y_;
    std::mt19937 random_{20};
};

}  // namespace rigor::validation::numerics
