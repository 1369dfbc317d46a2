// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Libraries may abort: what a command does with an engine happens in a child, so that a crash ends in a sentence
// and an exit code.
#pragma once

#include <functional>
#include <string>

#include "validation/runner/reference_guard.hpp"

namespace rigor::cli {

/// Limits the time of this process, a child of runGuarded (validation::TimeLimit) [s; times timeLimitFactor()].
void limitTime(double seconds);

/// Runs `work` in a child, which dies with this process and has the memory limit of a case, and returns its exit code,
/// or one that says how it ended. `engine` and `scenario` are named in the sentence; `limits` are those of the alarm that
/// `work` sets for a reference, if it does.
int runGuarded(const std::string& engine, const std::string& scenario,
               const validation::ReferenceLimits& limits, const std::function<int()>& work);

}  // namespace rigor::cli
