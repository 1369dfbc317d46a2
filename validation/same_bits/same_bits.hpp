// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs of one case that must end in the same bits: a second time, with more threads, and with the state taken back at
// random steps. The last hash is that which `validate` stores for the case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

/// "box_stack rigor:precision=f32,preset=default 0.016666666666666666": what a case is called in files of hashes.
std::string caseKey(const std::string& scenario, const std::string& spec, double dt);

struct SameBitsCase {
    scenario::Scenario scenario;
    adapter::EngineSpec spec;
    double dt = 0.0;
    std::size_t mostSteps = 0;  ///< 0: as many as the scenario lasts

    std::string key() const { return caseKey(scenario.name, spec.text(), dt); }
};

/// Hash of the states after each step.
using StateHashes = std::vector<std::string>;

StateHashes statesOf(const SameBitsCase& one);
/// The same run, but three times the state is saved at a random step, some more steps are taken, and the state is restored.
/// Nothing for an engine without snapshots.
std::optional<StateHashes> restoredStatesOf(const SameBitsCase& one, unsigned seed);
/// The case on two threads; nothing for an engine without the option.
std::optional<SameBitsCase> onTwoThreads(const SameBitsCase& one);

/// First step after which the states differ, from 1; nothing if none does.
std::optional<std::size_t> firstDifference(const StateHashes& a, const StateHashes& b);

}  // namespace rigor::validation
