// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fits values of scenarios (friction, restitution) to measured motions, engine by engine: on one part of the
// recordings, scored on the other, beside the values that the scenarios came with and beside predictions that
// need no engine.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"
#include "validation/runner/runner.hpp"
#include "validation/statistics/statistics.hpp"

namespace rigor::validation {

struct FitParameter {
    std::string name, key;  ///< key: as for --set
    double low = 0.0, high = 1.0, start = 0.0;
};

enum class Summary { Mean, Median };  ///< summary of the metric over the recordings that is minimised
const char* summaryName(Summary summary);

/// A fit file with its scenarios loaded.
struct FitTask {
    std::string name, title;
    std::vector<scenario::LoadedScenario> train, test;
    std::vector<adapter::EngineSpec> specs;  ///< specs with presets
    std::vector<FitParameter> parameters;
    std::string metric;                ///< minimised; smaller is better
    std::vector<std::string> metrics;  ///< reported, `metric` among them
    Summary summary = Summary::Mean;
    int budget = 140;  ///< points at which the training scenarios are run, per engine
    std::uint64_t seed = 1;
    double dt = 0.0;  ///< [s]; 0: the first of each scenario
};
/// `engines`: specs instead of the file's, both presets where a spec names none. Throws LoadError, BadInput.
FitTask loadFit(const std::filesystem::path& file, const std::vector<adapter::EngineSpec>& engines = {});

/// One value per parameter.
using FitPoint = std::vector<double>;

/// Summary over recordings with distribution-free 95 % intervals: bootstrap percentiles of the mean, order
/// statistics of the median. Runs that broke count as infinite.
struct ScoreSummary {
    double mean = 0.0, median = 0.0;
    Interval meanInterval, medianInterval;
    int runs = 0, broken = 0;
};

struct FitScore {
    std::string part;   ///< "train", "test"
    std::string point;  ///< "unfitted", "fitted"
    std::string metric;
    ScoreSummary score;
};
struct FittedParameter {
    double value = 0.0;
    Interval interval;  ///< 95 %, bootstrap over the training recordings and half a grid step on either side
};
struct EngineFit {
    std::string spec;
    std::vector<FittedParameter> parameters;
    std::vector<FitScore> scores;
    double change = 0.0;  ///< fitted - unfitted, mean over the test recordings of the fitted metric
    Interval changeInterval;
    int evaluations = 0;  ///< points
    std::string run;      ///< run folder of the fitted test scenarios, relative; "" when none was made
};
/// A prediction that needs no engine.
struct Baseline {
    std::string name, title;
    std::vector<FitScore> scores;
};
struct FitResult {
    std::string name, title, command, metric;
    Summary summary = Summary::Mean;
    std::vector<std::string> metrics, units;
    std::vector<FitParameter> parameters;
    int train = 0, test = 0;
    std::uint64_t seed = 0;
    std::vector<Baseline> baselines;
    std::vector<EngineFit> engines;
};

struct FitOptions {
    std::filesystem::path directory, binary;
    int jobs = 1;
    bool resume = false;
    bool runs = true;  ///< true: also writes a run folder with the fitted test scenarios of each engine
    std::string command;
};
struct FitProgress {
    std::int64_t done = 0, total = 0;  ///< runs of one scenario
    double etaSeconds = -1.0;
    std::string current;
};
/// Fits and scores every engine; every evaluation is kept in `evaluations.jsonl` of the folder, from which a
/// resumed fit goes on. `complete` is false when it was interrupted. Writes fit.json, fit.csv and fit.md.
struct FitOutcome {
    FitResult result;
    bool complete = false;
    std::vector<std::filesystem::path> runFolders;  ///< run folders to make reports of
};
FitOutcome runFit(const FitTask& task, const FitOptions& options,
                  const std::function<void(const FitProgress&)>& onProgress,
                  const std::atomic<bool>& interrupted);

std::string fitText(const FitResult& result);      ///< text for the terminal
std::string fitMarkdown(const FitResult& result);  ///< fit.md
std::string fitCsv(const FitResult& result);
nlohmann::ordered_json fitToJson(const FitResult& result);

/// The child's side: `__fit <request.json>`.
int fitChild(const std::filesystem::path& request);

}  // namespace rigor::validation
