// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs a bench: one child process for each repetition, never two at a time, every repetition in the store the
// moment it ends.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "validation/bench/scenes.hpp"
#include "validation/bench/schedule.hpp"

namespace rigor::validation {

struct BenchOptions {
    std::filesystem::path directory;
    std::filesystem::path binary;  ///< the `rigor` program itself
    bool resume = false;
    std::size_t memoryLimitMiB = 8192;  ///< memory limit per child
    BenchTarget target;
    std::string base;  ///< spec or engine that ratios are to; "": the first that is valid
    std::string suite, command;
};

/// Data of the progress line.
struct BenchProgress {
    std::int64_t done = 0, coming = 0;             ///< repetitions; `coming` is a guess
    double etaSeconds = -1.0;                      ///< -1: not known
    std::string current;                           ///< name of the case that runs now
    const results::BenchCase* finished = nullptr;  ///< case whose last repetition has just ended, or null
};

/// This build is worth timing: optimised, without sanitizers; else what is wrong with it.
std::string slowBuild();

/// Stable id of a case.
std::string benchId(const PlannedBench& planned);

/// Returns when the target is met or `interrupted` became true (the run can be resumed then); summaries are
/// stored either way. Throws std::runtime_error.
results::Run runBench(const std::vector<BenchWork>& work, const BenchOptions& options,
                      const std::function<void(const BenchProgress&)>& onProgress,
                      const std::atomic<bool>& interrupted);

/// Target of a stored bench, for going on with it or for a new summary.
BenchTarget targetOf(const results::Bench& bench);

}  // namespace rigor::validation
