// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scalar of the references: extended precision (64 bits of mantissa where the machine has them).
#pragma once

#include <numbers>

namespace rigor::validation::numerics {

using Real = long double;

inline constexpr Real kPi = std::numbers::pi_v<Real>;

}  // namespace rigor::validation::numerics
