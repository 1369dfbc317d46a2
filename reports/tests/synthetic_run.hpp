// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A synthetic run of realistic size and variety: every outcome and verdict, audit, ledger, curves, hostile
// names.
#pragma once

#include "reports/model/trajectory_loader.hpp"
#include "validation/results/types.hpp"

namespace rigor::report::synthetic {

/// A scenario name that would break every format that forgets to escape.
inline constexpr const char* kHostileName = "a</script><img src=x onerror=\"window.hostile=1\">,'\"\n|b&c";

/// `scenarios` x nine engine specs x two time steps. Deterministic.
results::Run makeRun(int scenarios = 25);
/// An unfinished run in which everything that can go wrong did: crashed, timed out, out of memory, refused,
/// without a number, with numbers that are none; a scenario without a survivor, one without a case.
results::Run makeHardRun();
/// Damped swings for every case that has a trajectory file named.
TrajectoryLoader makeLoader(const results::Run& run);

}  // namespace rigor::report::synthetic
