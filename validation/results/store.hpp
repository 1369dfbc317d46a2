// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The results store of a run folder: results.sqlite (schema documented in README.md here) and manifest.json.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::results {

inline constexpr int kSchemaVersion = 15;

/// True if the folder has a store. A run that stopped before it had tables leaves an empty file, or one that becomes empty
/// when its journal is played back; these are none.
bool holdsStore(const std::filesystem::path& directory);

/// True if a run was begun in the folder, whether or not it has stored anything: it can be resumed.
bool wasBegun(const std::filesystem::path& directory);

/// The caller requested that reading a run be given up.
struct ReadingInterrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a run folder. Cases whose rows do not fit their checksum are left out and named in Run::damage. Throws
/// std::runtime_error when it is no run folder or of a newer schema, or when what belongs to the whole run is damaged,
/// and ReadingInterrupted soon after `interrupted`, if there is one, became true.
Run readRun(const std::filesystem::path& directory, const std::atomic<bool>* interrupted = nullptr);

/// The request of a run, and the cases that it holds.
struct RunOutline {
    struct Case {
        std::string id, scenario, spec;
    };
    std::string suite, command;
    std::vector<Case> cases;  ///< in the order of the plan
};

/// Reads that alone: quick where a run is large. No checksum is compared. Throws std::runtime_error when it is no run
/// folder or of a newer schema.
RunOutline readOutline(const std::filesystem::path& directory);

/// Writes a run as it happens. Every call is one transaction: what returned is on disk after a kill. One
/// writer at a time: a second one on the same folder is refused. What the disk refuses is an EnvironmentError.
class RunWriter {
  public:
    /// Creates the folder and store, or opens an existing one (`resume`). Throws std::runtime_error when the
    /// folder holds a run and resume is false, or when resume is true and none was begun in it.
    RunWriter(const std::filesystem::path& directory, bool resume);
    ~RunWriter();
    RunWriter(const RunWriter&) = delete;
    RunWriter& operator=(const RunWriter&) = delete;

    /// Suite, command, environment, engines, scenarios, plannedCases; cases are ignored.
    void writeHeader(const Run& run);
    /// Ids of the cases already stored.
    std::vector<std::string> finishedCases() const;
    /// Forgets stored cases that are not among `ids`: a changed scenario or spec is another case.
    void keepOnly(const std::vector<std::string>& ids);
    /// Replaces a case with the same id.
    void writeCase(const CaseRow& row);
    /// Replaces the orders and fairness rows of the run; the rest of `run` is ignored.
    void writeAnalysis(const Run& run);
    /// Settings and cases of a bench; repetitions of cases that are no longer in it are forgotten.
    void writeBenchPlan(const Bench& bench);
    /// One repetition of a case of the bench, as soon as it has ended.
    void writeBenchRepetition(const std::string& caseId, const BenchRepetition& repetition);
    /// Replaces the summaries and changes of the bench.
    void writeBenchAnalysis(const Bench& bench);
    void finish(const std::string& isoTime);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rigor::results
