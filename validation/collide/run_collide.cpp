// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The parent's side: the oracle on threads of this process, every engine in children with a chunk of cases
// each. A child that ends early has written its results up to the case that ended it: that one is recorded as
// crashed or timed out, and another child goes on behind it.
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "validation/collide/exchange.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/line_file.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kChunk = 1000;      ///< cases per child
constexpr std::size_t kMemoryMiB = 4096;  ///< memory limit per child
constexpr double kChunkSeconds = 3600.0;  ///< the alarm of each query comes long before
constexpr const char* kAlgorithmKey = "narrow_phase";

/// Results of a child, in the order of its cases.
std::vector<CollideAnswer> readAnswers(const fs::path& file) {
    std::vector<CollideAnswer> answers;
    for (const json& value : readJsonLines(file)) answers.push_back(answerFromJson(value));
    return answers;
}

CollideAnswer lostAnswer(const ProcessResult& result) {
    CollideAnswer answer;
    const bool late = result.timedOut || (WIFSIGNALED(result.status) && WTERMSIG(result.status) == SIGALRM);
    answer.verdict = late ? CollideVerdict::Timeout : CollideVerdict::Crashed;
    answer.message = late ? "no result within the time limit" : result.ending();
    const auto end = result.outputTail.find_last_not_of(" \r\n");
    if (!late && end != std::string::npos) {
        const auto line = result.outputTail.rfind('\n', end);
        answer.message +=
            ": " + result.outputTail.substr(line == std::string::npos ? 0 : line + 1,
                                            end - (line == std::string::npos ? 0 : line + 1) + 1);
    }
    return answer;
}

class QueryRunner {
  public:
    QueryRunner(CollideRun& run, const CollideOptions& options,
                const std::function<void(std::int64_t, std::int64_t)>& progress)
        : run_(run), options_(options), progress_(progress), pool_(std::max(1, options.jobs)) {
        json questions = json::array();
        for (const CollideCase& c : run_.cases) questions.push_back(c.query.text);
        writeJsonFile(questions_, questions);
        total_ = run_.cases.size() * run_.specs.size();
    }

    bool runAll(const std::atomic<bool>& interrupted) {
        for (std::size_t spec = 0; spec < run_.specs.size(); ++spec)
            for (std::size_t first = 0; first < run_.cases.size(); first += kChunk)
                queue(spec, first, std::min(first + kChunk, run_.cases.size()));
        return pool_.run(interrupted, [](const std::string&) {});
    }

  private:
    void queue(std::size_t spec, std::size_t first, std::size_t last) {
        if (first == last) return;
        const std::string stem = "collide-" + std::to_string(next_++);
        const fs::path request = scratch_.path() / (stem + ".json"),
                       answer = scratch_.path() / (stem + ".jsonl");
        const std::string name = run_.specs[spec].text();
        writeJsonFile(request, {{"questions", questions_.string()},
                                {"spec", name},
                                {"first", first},
                                {"last", last},
                                {"seconds", options_.secondsPerQuery * timeLimitFactor()},
                                {"answer", answer.string()}});
        pool_.add({{options_.binary.string(), "__collide", request.string()},
                   {kChunkSeconds, kMemoryMiB},
                   name,
                   [this, spec, first, last, answer](const ProcessResult& result) {
                       ended(spec, first, last, readAnswers(answer), result);
                   }});
    }

    void ended(std::size_t spec, std::size_t first, std::size_t last, std::vector<CollideAnswer> answers,
               const ProcessResult& result) {
        answers.resize(std::min(answers.size(), last - first));
        for (CollideAnswer& answer : answers) put(spec, first++, std::move(answer));
        if (first < last) {
            put(spec, first++, lostAnswer(result));
            // A child that never got to its first result will not do better for the others.
            const bool neverStarted = answers.empty() && result.exitedWith(1);
            while (neverStarted && first < last) put(spec, first++, lostAnswer(result));
            queue(spec, first, last);
        }
        if (progress_) progress_(done_, total_);
    }

    void put(std::size_t spec, std::size_t index, CollideAnswer answer) {
        run_.cases[index].answers[spec] = std::move(answer);
        ++done_;
    }

    CollideRun& run_;
    const CollideOptions& options_;
    const std::function<void(std::int64_t, std::int64_t)>& progress_;
    ProcessPool pool_;
    ScratchFolder scratch_;
    fs::path questions_ = scratch_.path() / "questions.json";
    int next_ = 0;
    std::int64_t done_ = 0, total_ = 0;
};

/// Truth and judgement of every case: code of this program, on threads, each case by one of them.
void judgeAll(CollideRun& run, int jobs, const std::atomic<bool>& interrupted) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < run.cases.size() && !interrupted; i = next++) {
            CollideCase& c = run.cases[i];
            c.truth.source = "none";
            if (!c.query.unsupported.empty()) continue;
            c.truth = truthOf(c.query, run.tolerance);
            const CollideTolerance single = singleTolerance(c.query, run.tolerance);
            for (std::size_t spec = 0; spec < c.answers.size(); ++spec)
                judgeAnswer(c.query, c.truth, run.isSingle[spec] ? single : run.tolerance, c.answers[spec]);
        }
    };
    std::vector<std::thread> others;
    for (int i = 1; i < jobs; ++i) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
}

/// The precision that a spec chooses, else that of the library.
bool isSingle(const adapter::EngineSpec& spec, const fs::path& binary) {
    const auto chosen = spec.options.find("precision");
    if (chosen != spec.options.end()) return chosen->second == "f32";
    return describeEngine(spec.text(), binary).info.precision == "f32";
}

}  // namespace

std::vector<adapter::EngineSpec> allCollisionSpecs(const fs::path& binary, int jobs) {
    std::vector<adapter::EngineSpec> specs;
    const std::vector<std::string> engines = adapter::availableEngines();
    for (const EngineDescription& d : describeEngines(engines, binary, jobs)) {
        if (!d.problem.empty() || !d.capabilities.collision) continue;
        // Presets that differ in collision queries are both queried.
        const auto differs = [&](const adapter::Option& o) {
            const auto& keys = d.capabilities.queryOptions;
            return std::find(keys.begin(), keys.end(), o.key) != keys.end() &&
                   o.defaultValue != o.matchedValue;
        };
        if (std::any_of(d.options.begin(), d.options.end(), differs))
            specs.push_back({d.info.name, {{"preset", "matched"}}});
        const auto choice = std::find_if(d.options.begin(), d.options.end(),
                                         [](const adapter::Option& o) { return o.key == kAlgorithmKey; });
        if (choice == d.options.end() || choice->values.size() < 2) {
            specs.push_back({d.info.name, {}});
            continue;
        }
        // Another engine's narrow phase is queried as that engine.
        for (const std::string& value : choice->values)
            if (std::find(engines.begin(), engines.end(), value) == engines.end())
                specs.push_back({d.info.name, {{kAlgorithmKey, value}}});
    }
    return specs;
}

void checkCollisionSpec(const adapter::EngineSpec& spec, const fs::path& binary) {
    (void)adapter::moduleFor(spec);
    const EngineDescription d = describeEngine(spec.text(), binary);
    if (!d.problem.empty()) throw adapter::BadInput("engine " + spec.text() + ": " + d.problem);
    if (!d.capabilities.collision)
        throw adapter::BadInput("engine '" + spec.engine + "' has no collision queries");
    checkSettings(spec, d);
}

CollideRun runCollide(const std::vector<scenario::CollisionFile>& files,
                      const std::vector<adapter::EngineSpec>& specs, const CollideOptions& options,
                      const std::function<void(std::int64_t, std::int64_t)>& onProgress,
                      const std::atomic<bool>& interrupted) {
    CollideRun run;
    run.specs = specs;
    run.tolerance = options.tolerance;
    for (const auto& spec : specs) run.isSingle.push_back(isSingle(spec, options.binary));
    for (const auto& file : files)
        for (const auto& c : file.cases)
            run.cases.push_back({c, file.file.string(), {}, std::vector<CollideAnswer>(specs.size())});
    run.complete = QueryRunner(run, options, onProgress).runAll(interrupted);
    judgeAll(run, std::max(1, options.jobs), interrupted);
    run.complete = run.complete && !interrupted;
    for (std::size_t i = 0; i < specs.size(); ++i) run.summaries.push_back(summarise(run, i));
    return run;
}

}  // namespace rigor::validation
