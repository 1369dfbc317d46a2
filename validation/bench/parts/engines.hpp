// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions common to the isolated parts of a bench: choice of the engines that take part, and clocks for
// short work.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "validation/bench/meter.hpp"
#include "validation/bench/timed_work.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// Name in place of an engine, for the cost of the interface itself.
inline constexpr const char* kInterface = "interface";

struct PartEngine {
    adapter::EngineSpec spec;
    EngineDescription description;
};
/// The requested engines, or all available ones, each in all its precisions where the spec names none; those
/// that cannot be loaded are left out.
std::vector<PartEngine> partEngines(const BenchRequest& request);

/// The option whose values are an engine's broad phases; empty: it has no choice, or cannot be timed. Called
/// in a child process: engines are not loaded into this one.
std::string broadPhaseOption(const adapter::EngineSpec& spec);

/// The spec once for every value of one of its engine's options; as it is where it names the option, or
/// where `key` is empty.
std::vector<adapter::EngineSpec> everyChoice(const PartEngine& engine, const std::string& key);

/// True if a case of that name is requested: by its name, or because all cases are, or all `usual` ones.
bool isWanted(const BenchRequest& request, const std::string& name, bool usual = true);

/// The command that runs one case again; the interface alone is not to be had.
std::string partCommand(const PlannedBench& planned, const BenchRequest& request);

/// A value with the largest it may have; none: reported, not judged.
results::BenchQuality judged(const std::string& name, const std::string& unit, double value,
                             std::optional<double> max);

/// Medians of the samples into `done`, with `means` means, for work that comes in bursts; and the
/// allocations.
void fillTimes(const CountingStopwatch& watch, bool means, results::BenchRepetition& done);

}  // namespace rigor::validation
