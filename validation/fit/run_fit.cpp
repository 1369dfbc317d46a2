// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engine by engine: search on the training part, score on the other, then an ordinary run of the scored
// scenarios with the fitted values, so that every toss can be viewed.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/fit/baselines.hpp"
#include "validation/fit/objective.hpp"
#include "validation/fit/search.hpp"
#include "validation/metrics/metric.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;

Losses lossesOf(const PointValues& values, std::size_t metric) {
    Losses losses;
    for (const CaseValues& c : values) losses.push_back(c.values[metric]);
    return losses;
}

class Fitting {
  public:
    Fitting(const FitTask& task, const FitOptions& options,
            const std::function<void(const FitProgress&)>& onProgress, const std::atomic<bool>& interrupted)
        : task_(task),
          options_(options),
          onProgress_(onProgress),
          interrupted_(interrupted),
          log_(options.directory / "evaluations.jsonl", options.resume),
          objective_(
              task, options, log_, [this](int cases) { advance(cases); }, interrupted) {
        perEngine_ = static_cast<std::int64_t>(task.train.size()) * task.budget +
                     static_cast<std::int64_t>(task.test.size()) * (options.runs ? 3 : 2);
        progress_.total = perEngine_ * static_cast<std::int64_t>(task.specs.size());
    }

    FitOutcome run() {
        FitOutcome outcome;
        FitResult& r = outcome.result;
        r.name = task_.name;
        r.title = task_.title;
        r.command = options_.command;
        r.metric = task_.metric;
        r.summary = task_.summary;
        r.metrics = task_.metrics;
        r.parameters = task_.parameters;
        r.seed = task_.seed;
        for (const std::string& name : task_.metrics) r.units.push_back(findMetric(name)->unit);
        r.train = task_.train.size();
        r.test = task_.test.size();
        r.baselines = baselines(task_);
        for (std::size_t k = 0; k < task_.specs.size(); ++k) {
            auto fitted = fitEngine(task_.specs[k], outcome.runFolders);
            if (!fitted) return outcome;
            r.engines.push_back(std::move(*fitted));
            progress_.done = perEngine_ * static_cast<std::int64_t>(k + 1);
            advance(0);
        }
        outcome.complete = true;
        return outcome;
    }

  private:
    void advance(int cases) {
        progress_.done += cases;
        ran_ += cases;
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
        if (ran_ > 0) progress_.etaSeconds = seconds / ran_ * (progress_.total - progress_.done);
        if (onProgress_) onProgress_(progress_);
    }

    std::optional<EngineFit> fitEngine(const adapter::EngineSpec& spec, std::vector<fs::path>& runFolders) {
        progress_.current = "fit " + spec.text();
        const LossFunction losses =
            [&](const std::vector<FitPoint>& points) -> std::optional<std::vector<Losses>> {
            std::vector<const PointValues*> values;
            if (!objective_.evaluate(spec, true, points, values)) return std::nullopt;
            std::vector<Losses> all;
            for (const PointValues* v : values) all.push_back(lossesOf(*v, 0));
            return all;
        };
        const auto search = searchMinimum(task_.parameters, task_.summary, task_.budget, task_.seed, losses);
        if (!search) return std::nullopt;
        EngineFit fit;
        fit.spec = spec.text();
        fit.evaluations = search->all.size();
        const FitPoint best = search->all[search->best].point;
        const auto intervals = minimiserIntervals(*search, task_.parameters, task_.summary, task_.seed);
        for (std::size_t i = 0; i < best.size(); ++i) fit.parameters.push_back({best[i], intervals[i]});
        if (!score(spec, best, fit)) return std::nullopt;
        if (options_.runs && !runTest(spec, best, fit, runFolders)) return std::nullopt;
        return fit;
    }

    bool score(const adapter::EngineSpec& spec, const FitPoint& best, EngineFit& fit) {
        progress_.current = "score " + spec.text();
        FitPoint start;
        for (const FitParameter& p : task_.parameters) start.push_back(p.start);
        for (const bool train : {true, false}) {
            std::vector<const PointValues*> values;
            if (!objective_.evaluate(spec, train, {start, best}, values)) return false;
            for (std::size_t m = 0; m < task_.metrics.size(); ++m)
                for (const int k : {0, 1})
                    fit.scores.push_back({train ? "train" : "test", k == 0 ? "unfitted" : "fitted",
                                          task_.metrics[m], scoreOf(lossesOf(*values[k], m), task_.seed)});
            if (!train)
                std::tie(fit.change, fit.changeInterval) =
                    meanChange(lossesOf(*values[0], 0), lossesOf(*values[1], 0), task_.seed);
        }
        return true;
    }

    /// A run folder like any other: the scored scenarios with the fitted values.
    bool runTest(const adapter::EngineSpec& spec, const FitPoint& best, EngineFit& fit,
                 std::vector<fs::path>& folders) {
        std::string name = spec.text();
        for (char& c : name)
            if (c == ':' || c == ',' || c == '=' || c == '/') c = '-';
        fit.run = "test/" + name;
        const fs::path folder = options_.directory / fit.run;
        std::vector<std::pair<scenario::Scenario, std::string>> scenarios;
        for (const auto& s : task_.test) {
            auto loaded = scenario::loadScenarioText(s.text, s.scenario.name, overridesAt(task_, best));
            loaded.scenario.timeSteps.resize(1);
            scenarios.emplace_back(std::move(loaded.scenario), std::move(loaded.text));
        }
        const auto plan = planCases(scenarios, {spec},
                                    task_.dt > 0.0 ? std::vector<double>{task_.dt} : std::vector<double>{});
        RunOptions options;
        options.directory = folder;
        options.binary = options_.binary;
        options.jobs = options_.jobs;
        options.resume = options_.resume && fs::exists(folder / "results.sqlite");
        options.audit = false;
        options.suite = task_.name;
        options.command = options_.command;
        fs::create_directories(folder);
        std::int64_t before = 0;
        runCases(
            plan, options,
            [&](const Progress& p) {
                advance(p.done - before);
                before = p.done;
            },
            interrupted_);
        folders.push_back(folder);
        return !interrupted_;
    }

    const FitTask& task_;
    const FitOptions& options_;
    const std::function<void(const FitProgress&)>& onProgress_;
    const std::atomic<bool>& interrupted_;
    EvaluationLog log_;
    Objective objective_;
    FitProgress progress_;
    std::int64_t perEngine_ = 0, ran_ = 0;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// The baselines evaluate the references in this process: they have to be known to finish.
void requireReferences(const FitTask& task, const FitOptions& options) {
    std::vector<ReferenceQuestion> questions;
    for (const auto* part : {&task.train, &task.test})
        for (const auto& s : *part)
            questions.push_back({s.text, s.scenario.name, s.scenario.reference.has_value()});
    const auto checks = checkReferences(questions, ReferenceLimits{}, options.binary, options.jobs);
    for (std::size_t i = 0; i < checks.size(); ++i)
        if (checks[i].brokeDown()) throw adapter::BadInput(questions[i].name + ": " + checks[i].text());
}

}  // namespace

FitOutcome runFit(const FitTask& task, const FitOptions& options,
                  const std::function<void(const FitProgress&)>& onProgress,
                  const std::atomic<bool>& interrupted) {
    requireReferences(task, options);
    fs::create_directories(options.directory);
    FitOutcome outcome = Fitting(task, options, onProgress, interrupted).run();
    if (!outcome.complete) return outcome;
    std::ofstream(options.directory / "fit.json")
        << fitToJson(outcome.result).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    std::ofstream(options.directory / "fit.csv") << fitCsv(outcome.result);
    std::ofstream(options.directory / "fit.md") << fitMarkdown(outcome.result);
    return outcome;
}

}  // namespace rigor::validation
