// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases that are compared with each other: the same case of two runs, or two that differ on purpose.
#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "validation/results/types.hpp"

namespace rigor::results {

/// Deliberate difference of two compared cases; everything else of scenario, spec and time step is equal.
enum class PairBy {
    Nothing,  ///< the same case of two runs
    Engine,   ///< another engine, the same preset
    Spec,     ///< another spec of the same engine
    TimeStep  ///< another time step
};
const char* pairByName(PairBy by);  ///< "", "engine", "spec", "dt"
std::optional<PairBy> parsePairBy(const std::string& name);

/// The properties that compared cases have in common: the scenario; the spec, its engine (Spec) or its preset
/// (Engine); the time step [s], 0 for TimeStep.
using PairKey = std::tuple<std::string, std::string, double>;
PairKey pairKey(const CaseRow& c, PairBy by);

/// True if two cases with the same key differ in what `by` names; always true for Nothing.
bool differBy(const CaseRow& a, const CaseRow& b, PairBy by);

/// True for the spec of an engine's default preset without any other option.
bool isDefaultSpec(const CaseRow& c);

}  // namespace rigor::results
