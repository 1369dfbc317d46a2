// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small linear programs: minimise c.x over A x = b, x >= 0, by the two-phase simplex method on a dense
// tableau in extended precision, with Bland's rule, which cannot cycle. Source: Dantzig, Linear Programming
// and Extensions, 1963; Bland, Math. Oper. Res. 2 (1977) 103.
#pragma once

#include <vector>

#include "validation/references/numerics/elliptic.hpp"

namespace rigor::validation::numerics {

class LinearProgram {
  public:
    /// `rows` equations of `columns` unknowns each. Looks for a feasible point at once.
    LinearProgram(std::vector<std::vector<Real>> rows, std::vector<Real> right);

    /// Least sum of violations |A x - b| over x >= 0: 0 where feasible, up to rounding.
    Real infeasibility() const { return infeasibility_; }
    bool feasible(Real tolerance) const { return infeasibility_ <= tolerance; }
    /// A feasible point (after minimise: the last optimum).
    std::vector<Real> point() const;

    enum class Status { Optimal, Unbounded };
    struct Result {
        Status status = Status::Optimal;
        Real value = 0;
    };
    /// Least c.x over the feasible set. To be asked only where feasible.
    Result minimise(const std::vector<Real>& cost);

  private:
    void pivot(std::size_t row, std::size_t column);
    Status run(std::vector<Real> cost, std::size_t columns, Real& value);

    std::size_t columns_ = 0;
    std::vector<std::vector<Real>> table_;  ///< rows of (A | artificials | b), basis columns are unit vectors
    std::vector<std::size_t> basis_;
    Real infeasibility_ = 0;
};

}  // namespace rigor::validation::numerics
