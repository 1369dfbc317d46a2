// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results of a bench as they are stored and reported: cases, their repetitions, and the summary of the
// repetitions.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rigor::results {

/// Amount of work of an operation ("contacts", "pairs", "iterations"), a mean over the timed operations.
struct BenchCount {
    std::string name;
    double value = 0.0;
};

/// A part of an operation that the engine itself timed.
struct BenchPhase {
    std::string name;
    double seconds = 0.0;  ///< wall time, median over the timed operations
};

/// One number by which the work is judged. A timing whose quality is out of bounds is invalid.
struct BenchQuality {
    std::string name, unit;
    double value = 0.0;
    std::optional<double> min, max;  ///< bounds; neither: reported, not judged
    bool ok = true;                  ///< true if the value is within the bounds; NaN never is
};

/// One repetition: one process, one timing.
struct BenchRepetition {
    std::int64_t round = 0;             ///< 0: the look, which counts allocations and enters no statistic
    std::int64_t order = 0;             ///< time of the run: place among all repetitions of the run
    std::string outcome = "completed";  ///< outcome as of a case (types.hpp)
    std::string reason;                 ///< reason of another outcome
    double wall = 0.0;                  ///< [s] an operation, median over the timed ones
    double cpu = 0.0;                   ///< [s] of all threads together, likewise
    std::int64_t samples = 0;           ///< timed operations
    std::string stateHash;              ///< hash of the result, "" if there is none
    std::int64_t peakMemoryKiB = 0;     ///< peak memory of the process, to the last timed operation
    std::int64_t ownMemoryKiB = 0;      ///< part of it that was added since the engine began to build its
                                        ///< world
    std::optional<double>
        allocations;  ///< calls of the system's allocator in an operation, mean; the look alone
    std::optional<double> allocatedBytes;  ///< requested by these calls [B], mean
    double processSeconds = 0.0;           ///< wall time of the whole process
    double load = -1.0;                    ///< load of the machine (mean of the last minute) before it; -1
                                           ///< unknown
    std::vector<BenchCount> counts;
    std::vector<BenchPhase> phases;
    std::vector<BenchQuality> quality;
};

/// Summary of the repetitions of a case; statistics over rounds 1, 2, ...
struct BenchSummary {
    std::int64_t repetitions = 0;  ///< number of repetitions that count
    std::string clock;             ///< "cpu" or "wall": which of the two the intervals and ratios are of
    double wall = 0.0, cpu = 0.0;  ///< medians [s]
    std::optional<double> low,
        high;                     ///< 95 % interval of the median of `clock` [s]; none below six repetitions
    bool converged = false;       ///< the interval is as narrow as requested
    bool valid = false;           ///< completed, and all quality within bounds
    std::string reason;           ///< reason why not
    std::string base;             ///< id of the case that it is compared with, "" where there is none
    std::optional<double> ratio;  ///< median over rounds of time / base's time in the same round
    std::optional<double> ratioLow, ratioHigh;  ///< 95 % interval of that median
};

struct BenchCase {
    std::string id;             ///< stable hash of all that makes the work
    std::int64_t position = 0;  ///< place in the plan
    std::string part;           ///< "scene", or an isolated part: "broad_phase", ...
    std::string name;           ///< name of the timed work: the scenario, "box-box face", ...
    std::string engine;         ///< spec with all requested options
    std::string sizeUnit;       ///< unit of `size`: "bodies", "boxes"; "" if there is no size
    double size = 0.0;
    std::int64_t threads = 1;
    std::string operation;                     ///< name of one operation: "step", "pair", ...
    std::string command;                       ///< runs this case alone again
    std::string parameters;                    ///< parameters of the part, JSON
    std::vector<BenchRepetition> repetitions;  ///< repetitions by round
    BenchSummary summary;
};

/// A case against the same case of another run.
struct BenchChange {
    std::string caseId;
    double before = 0.0, after = 0.0;           ///< medians [s]
    double ratio = 1.0, low = 1.0, high = 1.0;  ///< ratio after / before with its 95 % interval (bootstrap)
    double p = 1.0;       ///< Mann and Whitney, corrected for the number of cases (Holm)
    std::string verdict;  ///< "slower", "faster", "same", "not compared"
    std::string reason;   ///< reason why it is not compared
};

/// Everything of `rigor bench` in a run folder; empty in a run of `rigor validate`.
struct Bench {
    std::map<std::string, std::string> settings;  ///< seed, target, budget, baseline, build, ...
    std::vector<BenchCase> cases;
    std::vector<BenchChange> changes;  ///< changes against settings["baseline"], if it was given
    bool empty() const { return cases.empty(); }
};

}  // namespace rigor::results
