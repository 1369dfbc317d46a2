// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of cases of two runs, or of the same run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// Deliberate difference of the two cases of a pair; everything else of scenario, spec and time step is
/// equal.
enum class PairBy {
    Nothing,  ///< the same case of two runs
    Engine,   ///< another engine, the same preset
    Spec,     ///< another spec, of the same engine or of another
    TimeStep  ///< another time step; within one run each with the next finer one
};
const char* pairByName(PairBy by);  ///< "", "engine", "spec", "dt"
std::optional<PairBy> parsePairBy(const std::string& name);

struct CasePair {
    const results::CaseRow *before, *after;
};

/// All pairs, in the order of `before`. Within one run (`before` and `after` are the same object, or name the
/// same folder) each pair appears once, the case that the run has first as `before`.
std::vector<CasePair> pairCases(const results::Run& before, const results::Run& after, PairBy by);

/// Content of a run, for the message if nothing can be compared: its scenarios, specs and steps.
std::string contentsOf(const results::Run& run);

}  // namespace rigor::validation
