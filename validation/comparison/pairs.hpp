// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of cases of two runs, or of the same run.
#pragma once

#include <string>
#include <vector>

#include "validation/results/pairing.hpp"

namespace rigor::validation {

using results::PairBy;

struct CasePair {
    const results::CaseRow *before, *after;
};

/// True if both sides of a comparison are one run: the same object, or the same folder.
bool isOneRun(const results::Run& before, const results::Run& after);

/// All pairs, in the order of `before`. Within one run each pair appears once: a time step with the next finer
/// one; of two specs an engine's default preset is `before`, else the case that the run has first. Of two runs specs of an
/// engine are paired within their preset where the runs have such.
std::vector<CasePair> pairCases(const results::Run& before, const results::Run& after, PairBy by);

/// Content of a run, for the message if nothing can be compared: its scenarios, specs and steps.
std::string contentsOf(const results::Run& run);

}  // namespace rigor::validation
