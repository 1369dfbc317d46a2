// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/types.hpp"

#include <array>
#include <stdexcept>
#include <utility>

namespace rigor::results {
namespace {

constexpr std::array<std::pair<Outcome, const char*>, 7> kOutcomes{{{Outcome::Completed, "completed"},
                                                                    {Outcome::Unsupported, "unsupported"},
                                                                    {Outcome::Crashed, "crashed"},
                                                                    {Outcome::Timeout, "timeout"},
                                                                    {Outcome::NonFinite, "non_finite"},
                                                                    {Outcome::OutOfMemory, "out_of_memory"},
                                                                    {Outcome::Error, "error"}}};

constexpr std::array<std::pair<Verdict, const char*>, 8> kVerdicts{
    {{Verdict::Pass, "pass"},
     {Verdict::Fail, "fail"},
     {Verdict::KnownDeviation, "known deviation"},
     {Verdict::Unsupported, "unsupported"},
     {Verdict::Crashed, "crashed"},
     {Verdict::Timeout, "timeout"},
     {Verdict::NonFinite, "non-finite"},
     {Verdict::NoReference, "no reference"}}};

constexpr std::array<std::pair<Regression, const char*>, 4> kRegressions{
    {{Regression::NoRecord, "no record"},
     {Regression::Unchanged, "unchanged"},
     {Regression::Better, "better"},
     {Regression::Worse, "worse"}}};

constexpr std::array<std::pair<OrderDependence, const char*>, 5> kDependences{
    {{OrderDependence::Unknown, ""},
     {OrderDependence::None, "no"},
     {OrderDependence::Value, "value"},
     {OrderDependence::Grade, "grade"},
     {OrderDependence::Verdict, "verdict"}}};

template <class Table, class Value>
const char* nameIn(const Table& table, Value value) {
    for (const auto& [entry, name] : table)
        if (entry == value) return name;
    throw std::invalid_argument("results: value outside of its enumeration");
}

template <class Table>
auto valueIn(const Table& table, const std::string& name, const char* what) {
    for (const auto& [entry, text] : table)
        if (name == text) return entry;
    std::string known;
    for (const auto& [entry, text] : table) known += (known.empty() ? "" : ", ") + std::string(text);
    throw std::runtime_error(std::string("results: found ") + what + " '" + name + "', expected one of " +
                             known);
}

}  // namespace

const char* outcomeName(Outcome outcome) {
    return nameIn(kOutcomes, outcome);
}
const char* verdictName(Verdict verdict) {
    return nameIn(kVerdicts, verdict);
}
const char* regressionName(Regression regression) {
    return nameIn(kRegressions, regression);
}
const char* orderDependenceName(OrderDependence d) {
    return nameIn(kDependences, d);
}
OrderDependence parseOrderDependence(const std::string& name) {
    return valueIn(kDependences, name, "dependence on the order of insertion");
}
Outcome parseOutcome(const std::string& name) {
    return valueIn(kOutcomes, name, "outcome");
}
Verdict parseVerdict(const std::string& name) {
    return valueIn(kVerdicts, name, "verdict");
}
Regression parseRegression(const std::string& name) {
    return valueIn(kRegressions, name, "regression");
}

}  // namespace rigor::results
