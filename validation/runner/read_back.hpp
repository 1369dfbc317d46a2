// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parity is proved, not assumed: what the engine says it was given against what the scenario says.
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/types.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Relative tolerance of a comparison: 1e-9 for "f64", 1e-5 for "f32".
double readBackTolerance(const std::string& precision);

/// One row per quantity and body (large scenes: the worst body of each quantity, and every mismatch up to a
/// limit), one per quantity and pair of materials.
std::vector<results::ReadBackRow> compareReadBack(const scenario::Scenario& scenario,
                                                  const adapter::ReadBack& readBack, double tolerance);

/// The first mismatch that the ledger does not announce (an entry whose topic is the quantity and which is
/// not exact); "" when there is none.
std::string readBackProblem(const std::vector<results::ReadBackRow>& rows,
                            const std::vector<results::LedgerRow>& ledger);

}  // namespace rigor::validation
