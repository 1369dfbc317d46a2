// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Studies: from a study file to cases for the runner, and from stored cases to tables side by side and
// verdicts on symptoms.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/loader/study.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// The row's case run again in a way that must come back the same.
struct SymmetricCase {
    std::string symmetry;
    std::string caseId;   ///< "" where there is none
    std::string problem;  ///< reason why there is none
    std::function<Trajectory(const Trajectory&)> back;
};

/// One line of a study's table: a case and where in the grid it stands.
struct StudyRow {
    std::size_t part = 0;
    std::string scenario;                                         ///< name as run: unique for its values
    std::string base;                                             ///< name in the file
    std::vector<std::pair<std::string, std::string>> parameters;  ///< scenario and spec keys of this place
    std::string variant, spec, caseId;
    double dt = 0.0;
    int bodies = 0;  ///< number of moving bodies of the scenario
    /// The scenario written in full: what symmetric cases are held against, so that the bits are comparable.
    std::string plainCase;
    std::vector<SymmetricCase> symmetric;  ///< several of a name: the worst counts
    std::vector<std::string> members;      ///< cases of the ensemble
};

struct StudyPlan {
    scenario::Study study;
    std::vector<StudyRow> rows;
    std::vector<CasePlan> cases;  ///< each once, also where several rows show it
};

using ScenarioLoader = std::function<scenario::LoadedScenario(const std::string& nameOrFile,
                                                              const std::vector<std::string>& overrides)>;

/// Keys of the spec of an engine.
using OptionLookup = std::function<std::vector<adapter::Option>(const std::string& engine)>;

/// Takes the variants of engines that are not installed out of the study, with the findings about them, symptoms that
/// need them, and parts of which nothing is left. Returns a line for each engine. Only where the study requests it.
std::vector<std::string> leaveOutAbsent(scenario::Study& study);

/// Lays out the grid. A spec without a preset runs in the preset `default`. `options` gives the engines that
/// have threads, if the study has the symmetry `threads`. Throws LoadError and BadInput.
StudyPlan planStudy(const scenario::Study& study, const ScenarioLoader& load,
                    const OptionLookup& options = {});

/// Adds the cases that need to know how others ended (time reversal) and have ended in the folder; false when
/// there is none to add.
bool extendPlan(StudyPlan& plan, const results::Run& stored);
/// The same from a run folder, which may be unfinished or unreadable: then nothing is added.
void extendFromFolder(StudyPlan& plan, const std::filesystem::path& folder);

/// Runs all cases, then those that follow from them.
results::Run runStudyCases(StudyPlan& plan, RunOptions options,
                           const std::function<void(const Progress&)>& onProgress,
                           const std::atomic<bool>& interrupted);

struct StudyValue {
    std::optional<double> value;
    std::string unit;
    std::string note = {};                      ///< subject, an interval, or the reason why there is no value
    std::optional<double> low = {}, high = {};  ///< 95 % interval, where it is a median over runs
};

struct StudyResultRow {
    StudyRow row;
    results::Outcome outcome = results::Outcome::Completed;
    bool ran = false;  ///< false: interrupted before its case
    std::string reason;
    std::vector<StudyValue> values;  ///< values by metric of the part
};

/// Result of a symptom.
struct SymptomVerdict {
    std::size_t part = 0;
    double fault = 0.0,
           cure = 0.0;  ///< values or exponents; infinite for a run that did not survive, NaN: none
    bool shown = false, cured = false;
    std::vector<std::string> switched;  ///< settings in which the two differ: "solver: single_pass -> pgs"
};

/// Result of a finding.
struct FindingVerdict {
    std::size_t part = 0, finding = 0;      ///< index into the part's findings
    std::optional<double> least, greatest;  ///< values of the rows it is about; infinite if a run broke
    bool holds = false;                     ///< false also when a row has no value or there is no row
};

struct StudyResult {
    scenario::Study study;
    std::vector<StudyResultRow> rows;
    std::vector<SymptomVerdict> symptoms;
    std::vector<FindingVerdict> findings;
};

/// Reads the rows' values from the cases of a run.
StudyResult evaluateStudy(const StudyPlan& plan, const results::Run& run);

/// A column over several cases: "order.METRIC", the observed order of the time-step refinement of a row.
inline const std::string kOrderPrefix = "order.";

/// A column of the contact audit: "audit.FIELD", of the contacts that the run acted upon.
inline const std::string kAuditPrefix = "audit.";
std::vector<std::string> auditFields();
/// A part has such a column: its cases have to be audited.
bool requestsAudit(const scenario::Study& study);

/// A column of one case: a metric "name" or "name:subject", "quantity.NAME" (what a reference measures in the
/// run), "time.PHASE" (median wall time of a phase of the step) or "audit.FIELD".
StudyValue studyValue(const results::CaseRow& row, const std::string& metric);

/// False when a symptom is not shown or not cured, a finding does not hold, or a case crashed, hung, failed
/// to run or gave numbers that are not finite, unless it is the fault of a symptom.
bool studyIsGreen(const StudyResult& result);

}  // namespace rigor::validation
