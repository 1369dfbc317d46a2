// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Predictions that need no engine: what an engine has to be better than.
#pragma once

#include "validation/fit/fit.hpp"

namespace rigor::validation {

/// `frozen`: every body stays as it starts. `slide`: the one recorded body, a box, flies without turning
/// until its centre is half a width above a fixed half-space, and slides to rest there with the friction of
/// the scenario. `slide_to_final_attitude`: the same in the attitude in which the recording ends. The latter
/// two are left out where a scenario is not of that kind.
std::vector<Baseline> baselines(const FitTask& task);

}  // namespace rigor::validation
