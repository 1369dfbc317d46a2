// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries of a case in frequent use, and numbers as text.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "validation/results/types.hpp"

namespace rigor::results {

/// The metric of the whole scene; null when the case has none.
const MetricRow* wholeScene(const CaseRow& row, const std::string& metric);

/// The scenario of this name; null where the run has none.
const ScenarioRow* scenarioOf(const Run& run, const std::string& name);

/// True if a metric is an error, whose ideal is zero. Costs and outcomes are none. Nor is the motion left at the
/// end of a scene (kind rest) for which nothing says that it comes to rest: the scenario has no reference, does
/// not name the metric and sets it no bound.
bool isError(const MetricRow& metric, const ScenarioRow& scenario);

/// Wall time of all steps [s]: the median of a step times their number. Empty where it was not measured.
std::optional<double> steppingTime(const CaseRow& row);

/// "2.4.0", or "2.4.0 (package 2.4.1)" where library and package do not agree.
std::string versionText(const EngineRow& engine);

/// The first word of a run's stored command: the program or, of a source tree, its launcher.
std::string programOf(const Run& run);

/// "not a number", "infinite", "minus infinite"; "" for a finite value.
const char* nonFiniteWords(double value);

/// The shortest text that reads back as the same double; "nan", "inf", "-inf".
std::string exactText(double value);

/// The same for tables that other programs read: empty for what is not finite, of which a text makes a whole column
/// text.
std::string finiteText(double value);
std::string finiteText(const std::optional<double>& value);

/// Values that finiteText left out of a row, "value is not a number; high is infinite"; "" for none.
using NamedNumber = std::pair<const char*, std::optional<double>>;
std::string nonFiniteNote(std::initializer_list<NamedNumber> numbers);

}  // namespace rigor::results
