// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Dense linear systems in extended precision, by Eigen.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// x with m x = f; empty where m is singular to rounding. LU with full pivoting of the equations scaled to
/// one, so that the units of an equation do not decide.
std::optional<Vector> solveDense(Matrix m, Vector f);

}  // namespace rigor::validation::numerics
