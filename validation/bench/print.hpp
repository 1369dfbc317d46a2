// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A bench as text for a terminal, and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// One table for each kind of timed work. An invalid timing is struck out and says why.
std::string benchText(const results::Run& run, bool colour);

/// Everything that was measured, whole.
nlohmann::ordered_json benchJson(const results::Run& run);

/// Changes since a baseline, slower ones first, with what differs between the machines.
std::string changesText(const results::Run& run, const std::string& baseline,
                        const std::vector<std::string>& machine);

/// A case in few words: "box_pyramid 1240 bodies, ode:preset=matched, 2 threads".
std::string benchCaseName(const results::BenchCase& c);

/// The mean of a count over the repetitions that report it, or -1.
double countOf(const results::BenchCase& c, const std::string& name);

}  // namespace rigor::validation
