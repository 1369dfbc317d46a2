// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Steps one world through a scenario and records what it does.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "validation/results/types.hpp"
#include "validation/runner/runner.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

struct Simulation {
    Trajectory trajectory;
    std::size_t steps = 0;                    ///< taken
    std::string nonFinite;                    ///< description of the first value that was not finite and its
                                              ///< time; "" if all were
    std::string stateHash;                    ///< FNV-1a over the bits of the last states
    std::vector<results::TimingRow> timings;  ///< "step" and the engine's phases
    std::vector<results::MetricRow> costs;    ///< values of the engine's counters, kind "cost"
};

/// Number of steps of a case: the duration rounded to whole steps, at least one.
std::size_t stepCount(const scenario::Scenario& scenario, double dt);

/// Steps between recorded frames so that frames * bodies stays near `kMostStates`; a divisor of the number of
/// steps where a near one exists, so that the last step is a frame.
int recordingStride(std::size_t steps, std::size_t bodies);

/// Runs to the end or to the first recorded state that is not finite.
Simulation simulate(const scenario::Scenario& scenario, double dt, adapter::World& world,
                    const LiveOptions& options);

}  // namespace rigor::validation
