// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/run_bench.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "adapters/interface/registry.hpp"
#include "validation/bench/exchange.hpp"
#include "validation/bench/process_memory.hpp"
#include "validation/bench/summary.hpp"
#include "validation/hash.hpp"
#include "validation/results/store.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/environment.hpp"
#include "validation/runner/header.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using results::Bench;
using results::BenchCase;
using results::BenchRepetition;

double loadNow() {
    double load = -1.0;
    std::ifstream("/proc/loadavg") >> load;
    return load;
}

BenchCase caseOf(const PlannedBench& p, std::int64_t position) {
    BenchCase c;
    c.id = benchId(p);
    c.position = position;
    c.part = p.part;
    c.name = p.name;
    c.engine = p.engine;
    c.sizeUnit = p.sizeUnit;
    c.size = p.size;
    c.threads = p.threads;
    c.operation = p.operation;
    c.command = p.command;
    c.parameters = p.parameters;
    return c;
}

/// The repetition of a child that gave no result.
BenchRepetition failed(const ProcessResult& result, const PlannedBench& planned) {
    BenchRepetition r;
    if (result.timedOut) {
        r.outcome = "timeout";
        r.reason = "no end within " + std::to_string(static_cast<int>(planned.timeLimit)) + " s";
    } else if (result.exitedWith(kExitOutOfMemory)) {
        r.outcome = "out_of_memory";
        r.reason = "the memory limit was reached";
    } else {
        r.outcome = "crashed";
        r.reason = result.ending();
    }
    if (const std::string said = lastLine(result.outputTail); !said.empty()) r.reason += "; it said: " + said;
    return r;
}

/// One row per scenario name, for the header of the run.
std::vector<CasePlan> scenariosOf(const std::vector<BenchWork>& work) {
    std::vector<CasePlan> plans;
    std::set<std::string> seen;
    for (const BenchWork& w : work)
        if (w.planned.part == kScenePart && seen.insert(w.scenario.name).second)
            plans.push_back({"", w.text, w.scenario, {}, 0.0});
    return plans;
}

class BenchInProgress {
  public:
    BenchInProgress(const std::vector<BenchWork>& work, const BenchOptions& options,
                    const std::function<void(const BenchProgress&)>& onProgress)
        : work_(work),
          options_(options),
          onProgress_(onProgress),
          directory_(fs::absolute(options.directory)),
          writer_(directory_, options.resume),
          pool_(1) {}

    results::Run run(const std::atomic<bool>& interrupted) {
        prepare();
        queueNext();
        const bool complete = pool_.run(interrupted, [&](const std::string& name) { report(name, nullptr); });
        char load[32];
        std::snprintf(load, sizeof load, "%.2f", loadNow());
        header_.environment["load_after"] = load;
        writer_.writeHeader(header_);
        summarise(bench_, options_.target, options_.base);
        writer_.writeBenchAnalysis(bench_);
        if (complete) writer_.finish(isoTime());
        return results::readRun(directory_);
    }

  private:
    void prepare() {
        for (std::size_t i = 0; i < work_.size(); ++i) bench_.cases.push_back(caseOf(work_[i].planned, i));
        bench_.settings = settings();
        header_ = header();
        if (options_.resume) takeStored();
        writer_.writeHeader(header_);
        writeScenarioFiles(scenariosOf(work_), directory_);
        writer_.writeBenchPlan(bench_);
    }

    results::Run header() const {
        std::vector<std::string> engines;
        const std::vector<std::string> known = adapter::availableEngines();
        for (const BenchWork& w : work_) {
            const std::string name = w.planned.engine.substr(0, w.planned.engine.find(':'));
            // The work of an isolated part need not be done by an engine.
            const bool isEngine =
                w.planned.part == kScenePart || std::find(known.begin(), known.end(), name) != known.end();
            if (isEngine && std::find(engines.begin(), engines.end(), name) == engines.end())
                engines.push_back(name);
        }
        RunOptions as;
        as.directory = directory_;
        as.binary = options_.binary;
        as.jobs = 1;
        as.suite = options_.suite;
        as.command = options_.command;
        const auto plan = scenariosOf(work_);
        results::Run run =
            runHeader(plan, as, describeEngines(engines, options_.binary, 1), plannedReferences(plan, as));
        run.plannedCases = 0;
        return run;
    }

    std::map<std::string, std::string> settings() const {
        const BenchTarget& t = options_.target;
        return {{"width", results::exactText(t.width)},
                {"least", std::to_string(t.least)},
                {"most", std::to_string(t.most)},
                {"budget", results::exactText(t.budget)},
                {"seed", std::to_string(t.seed)},
                {"clock", t.clock},
                {"base", options_.base},
                {"build", slowBuild().empty() ? "optimised" : slowBuild()}};
    }

    void takeStored() {
        const results::Run stored = results::readRun(directory_);
        if (!stored.started.empty()) {
            header_.started = stored.started;
            header_.environment["load"] = stored.environment.at("load");
        }
        for (BenchCase& c : bench_.cases)
            for (const BenchCase& old : stored.bench.cases)
                if (old.id == c.id) c.repetitions = old.repetitions;
        for (const BenchCase& c : bench_.cases)
            for (const BenchRepetition& r : c.repetitions) order_ = std::max(order_, r.order + 1);
    }

    void queueNext() {
        const auto next = nextRepetition(bench_, options_.target);
        if (!next) return;
        const BenchWork& w = work_[next->index];
        const fs::path request = scratch_.path() / "request.json", answer = scratch_.path() / "answer.json";
        std::error_code ignored;
        fs::remove(answer, ignored);
        writeJsonFile(request, {{"planned", plannedToJson(w.planned)},
                                {"text", w.text},
                                {"round", next->round},
                                {"answer", answer.string()}});
        std::vector<std::string> command{options_.binary.string(), "__bench", request.string()};
        if (next->round == 0) command = withCountedAllocations(std::move(command));
        const double load = loadNow();
        pool_.add({std::move(command),
                   {w.planned.timeLimit, options_.memoryLimitMiB},
                   w.planned.name + ", " + w.planned.engine,
                   [this, next = *next, answer, load](const ProcessResult& result) {
                       ended(next, answer, load, result);
                       queueNext();
                   }});
    }

    void ended(const NextRepetition& next, const fs::path& answer, double load, const ProcessResult& result) {
        const auto reply = result.exitedWith(0) ? readJsonFile(answer) : std::nullopt;
        BenchRepetition r = reply ? repetitionFromJson(*reply) : failed(result, work_[next.index].planned);
        r.round = next.round;
        r.order = order_++;
        r.load = load;
        r.processSeconds = result.wallSeconds;
        BenchCase& c = bench_.cases[next.index];
        writer_.writeBenchRepetition(c.id, r);
        c.repetitions.push_back(std::move(r));
        report("", &c);
    }

    void report(const std::string& current, const BenchCase* finished) {
        if (!onProgress_) return;
        BenchProgress progress;
        for (const BenchCase& c : bench_.cases)
            progress.done += static_cast<std::int64_t>(c.repetitions.size());
        const BenchForecast coming = forecast(bench_, options_.target);
        progress.coming = coming.repetitions;
        progress.etaSeconds = coming.seconds;
        progress.current = current;
        progress.finished = finished;
        onProgress_(progress);
    }

    const std::vector<BenchWork>& work_;
    const BenchOptions& options_;
    const std::function<void(const BenchProgress&)>& onProgress_;
    fs::path directory_;
    results::RunWriter writer_;
    ScratchFolder scratch_;
    ProcessPool pool_;
    Bench bench_;
    results::Run header_;
    std::int64_t order_ = 0;
};

}  // namespace

std::string slowBuild() {
    if (isSanitized()) return "built with sanitizers";
#ifdef __OPTIMIZE__
    return "";
#else
    return "built without optimisation";
#endif
}

std::string benchId(const PlannedBench& p) {
    Fnv1a hash;
    for (const std::string& word : {p.part, p.name, p.engine, p.operation, p.parameters}) hash.text(word);
    hash.number(p.size);
    hash.word(p.threads);
    return hash.hex();
}

BenchTarget targetOf(const Bench& bench) {
    const auto number = [&](const char* key, double byDefault) {
        const auto it = bench.settings.find(key);
        return it == bench.settings.end() ? byDefault : std::stod(it->second);
    };
    BenchTarget t;
    t.width = number("width", t.width);
    t.budget = number("budget", t.budget);
    t.least = static_cast<int>(number("least", t.least));
    t.most = static_cast<int>(number("most", t.most));
    if (const auto it = bench.settings.find("seed"); it != bench.settings.end())
        t.seed = std::stoull(it->second);
    if (const auto it = bench.settings.find("clock"); it != bench.settings.end()) t.clock = it->second;
    return t;
}

results::Run runBench(const std::vector<BenchWork>& work, const BenchOptions& options,
                      const std::function<void(const BenchProgress&)>& onProgress,
                      const std::atomic<bool>& interrupted) {
    return BenchInProgress(work, options, onProgress).run(interrupted);
}

}  // namespace rigor::validation
