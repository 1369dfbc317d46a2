// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases that `rigor bench` can time: whole scenes and isolated parts alike. A part of a bench is a family
// that plans its cases in the parent, without loading an engine, and makes one of them in a child process of
// its own for each repetition. Order, repetitions, statistics, store and report are the bench's; a family
// only does the work.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "validation/results/bench_types.hpp"

namespace rigor::validation {

/// Request of the command line to a family.
struct BenchRequest {
    std::vector<std::string> engines;  ///< specs as given; empty: every engine that can take part
    std::vector<std::string> only;     ///< names of cases, usual or not; empty: all of them
    std::vector<double> sizes;         ///< instead of the family's own; empty: its own
    bool full = false;                 ///< everything there is; false: the most informative cases in some
                                       ///< minutes
    std::vector<int> threads{1};       ///< thread counts of engines that have threads
    unsigned long long seed = 1;       ///< seed of the random parts of the work
    std::string preset;  ///< preset of specs that name none, if it matters; empty: each one's default
    std::string binary;  ///< this program, to describe engines with (describeEngine)
};

/// One case before it is run. Cases of the same part, name, size and threads are compared with each other.
struct PlannedBench {
    std::string part;      ///< the family's name
    std::string name;      ///< name of the timed work: "box-box face"
    std::string engine;    ///< spec, or the name of what does the work
    std::string sizeUnit;  ///< "boxes"; "" where there is no size
    double size = 0.0;
    int threads = 1;
    std::string operation = "step";  ///< name of one operation
    std::string parameters = "{}";   ///< JSON, for make(); part of the identity of the case
    std::string command;             ///< runs this case alone again: "./rigor bench ..."
    double timeLimit = 120.0;        ///< wall-time limit of one repetition [s]
};

/// Work that is ready to be done, in the child.
class TimedWork {
  public:
    virtual ~TimedWork() = default;

    /// Warms up, does the work and times it: wall and cpu are medians over its operations (or over batches of
    /// them where one is too short for the clock), always more than 0. Fills samples, counts, quality, and
    /// phases and stateHash where there are any; `peakMemoryKiB`, `ownMemoryKiB` and allocations may be left
    /// to the bench. `round` 0 is the look: not timed in any statistic, so more may be checked (against brute
    /// force, say). Throws adapter::Unsupported with what is lacking.
    virtual results::BenchRepetition run(int round) = 0;
};

struct BenchFamily {
    std::string name;   ///< snake_case, of `rigor bench --parts NAME`
    std::string title;  ///< one line
    std::vector<PlannedBench> (*plan)(const BenchRequest& request);
    std::unique_ptr<TimedWork> (*make)(const PlannedBench& planned);
};

/// The isolated parts, in the order of families.def; scenes are not among them.
const std::vector<BenchFamily>& benchFamilies();

}  // namespace rigor::validation
