// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fit/objective.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kChunk = 120;       ///< cases per child: seconds of work against a start of 0.05 s
constexpr std::size_t kMemoryMiB = 4096;  ///< memory limit per child
constexpr double kChunkSeconds = 3600.0;  ///< the alarm of each case comes long before

CaseValues broken(std::size_t metrics, const std::string& problem) {
    return {std::vector<double>(metrics, std::numeric_limits<double>::infinity()), problem};
}

json toJson(const PointValues& values) {
    json list = json::array();
    for (const CaseValues& c : values) {
        if (!c.problem.empty()) {
            list.push_back(c.problem);
            continue;
        }
        json numbers = json::array();
        for (const double v : c.values) numbers.push_back(numberToJson(v));
        list.push_back(numbers);
    }
    return list;
}

CaseValues fromJson(const json& value, std::size_t metrics) {
    if (value.is_string()) return broken(metrics, value.get<std::string>());
    CaseValues c;
    for (const json& number : value) c.values.push_back(numberFromJson(number));
    return c;
}

std::string endingOf(const ProcessResult& result) {
    const bool late = result.timedOut || (WIFSIGNALED(result.status) && WTERMSIG(result.status) == SIGALRM);
    return late ? "timeout" : "crashed: " + result.ending();
}

/// The cases of one call, in chunks; a chunk whose child ended early goes on behind the case that ended it.
class Batch {
  public:
    Batch(ProcessPool& pool, const fs::path& binary, const fs::path& folder, std::size_t metrics,
          std::size_t count, std::function<void(int)> progress)
        : pool_(pool),
          binary_(binary),
          folder_(folder),
          metrics_(metrics),
          progress_(std::move(progress)),
          answers_(count) {}

    void queue(std::size_t first, std::size_t last) {
        if (first >= last) return;
        const std::string stem = "part-" + std::to_string(next_++);
        const fs::path request = folder_ / (stem + ".json"), answer = folder_ / (stem + ".jsonl");
        writeJsonFile(request, {{"batch", (folder_ / "batch.json").string()},
                                {"first", first},
                                {"last", last},
                                {"answer", answer.string()}});
        pool_.add({{binary_.string(), "__fit", request.string()},
                   {kChunkSeconds, kMemoryMiB},
                   stem,
                   [this, first, last, answer](const ProcessResult& result) {
                       ended(first, last, answer, result);
                   }});
    }
    std::vector<CaseValues>& answers() { return answers_; }

  private:
    void ended(std::size_t first, std::size_t last, const fs::path& file, const ProcessResult& result) {
        int finished = 0;
        bool any = false;
        for (const json& line : readJsonLines(file)) {
            if (first == last) break;
            answers_[first++] = fromJson(line, metrics_);
            ++finished;
            any = true;
        }
        if (first < last) {
            // A child that never got to its first result will not do better for the others.
            const bool neverStarted = !any && result.exitedWith(1);
            const std::string said =
                neverStarted ? result.outputTail.substr(0, result.outputTail.find('\n')) : endingOf(result);
            do {
                answers_[first++] = broken(metrics_, said);
                ++finished;
            } while (neverStarted && first < last);
            queue(first, last);
        }
        progress_(finished);
    }

    ProcessPool& pool_;
    fs::path binary_, folder_;
    std::size_t metrics_;
    std::function<void(int)> progress_;
    std::vector<CaseValues> answers_;
    int next_ = 0;
};

}  // namespace

// ---------------------------------------- log
EvaluationLog::EvaluationLog(const fs::path& file, bool resume) {
    if (resume)
        for (const json& line : readJsonLines(file)) {
            PointValues values;
            const auto metrics = line.at("metrics").get<std::size_t>();
            for (const json& v : line.at("values")) values.push_back(fromJson(v, metrics));
            known_[keyOf(line.at("spec"), line.at("part"), line.at("point").get<FitPoint>())] =
                std::move(values);
        }
    // A line that was half written when the fit was interrupted is dropped: the whole lines are written
    // again.
    std::vector<json> whole = resume ? readJsonLines(file) : std::vector<json>{};
    out_ = std::make_unique<LineWriter>(file.string());
    for (const json& line : whole) out_->add(line);
}

std::string EvaluationLog::keyOf(const std::string& spec, const std::string& part, const FitPoint& point) {
    return spec + "|" + part + "|" + json(point).dump();
}

const PointValues* EvaluationLog::find(const std::string& spec, const std::string& part,
                                       const FitPoint& point) const {
    const auto it = known_.find(keyOf(spec, part, point));
    return it == known_.end() ? nullptr : &it->second;
}

const PointValues& EvaluationLog::add(const std::string& spec, const std::string& part, const FitPoint& point,
                                      PointValues values) {
    out_->add({{"spec", spec},
               {"part", part},
               {"point", point},
               {"metrics", values.empty() ? 0 : values.front().values.size()},
               {"values", toJson(values)}});
    return known_[keyOf(spec, part, point)] = std::move(values);
}

// ----------------------------------------------------------------------------------------------------
// objective
std::vector<std::string> overridesAt(const FitTask& task, const FitPoint& point) {
    std::vector<std::string> overrides;
    for (std::size_t i = 0; i < point.size(); ++i)
        overrides.push_back(task.parameters[i].key + "=" + json(point[i]).dump());
    return overrides;
}

Objective::Objective(const FitTask& task, const FitOptions& options, EvaluationLog& log,
                     std::function<void(int)> progress, const std::atomic<bool>& interrupted)
    : task_(task), options_(options), log_(log), progress_(std::move(progress)), interrupted_(interrupted) {
    for (const bool train : {true, false}) {
        json texts = json::array();
        for (const auto& s : train ? task.train : task.test) texts.push_back(s.text);
        writeJsonFile(scratch_.path() / (train ? "train.json" : "test.json"), texts);
    }
}

bool Objective::evaluate(const adapter::EngineSpec& spec, bool train, const std::vector<FitPoint>& points,
                         std::vector<const PointValues*>& results) {
    const std::string part = train ? "train" : "test";
    const std::size_t scenarios = (train ? task_.train : task_.test).size();
    std::vector<FitPoint> open;
    for (const FitPoint& point : points)
        if (log_.find(spec.text(), part, point) == nullptr &&
            std::find(open.begin(), open.end(), point) == open.end())
            open.push_back(point);
    if (!open.empty()) {
        const fs::path folder = scratch_.path() / ("batch-" + std::to_string(next_++));
        fs::create_directory(folder);
        json overrides = json::array();
        for (const FitPoint& point : open) overrides.push_back(overridesAt(task_, point));
        writeJsonFile(folder / "batch.json", {{"scenarios", (scratch_.path() / (part + ".json")).string()},
                                              {"spec", spec.text()},
                                              {"dt", numberToJson(task_.dt)},
                                              {"metrics", task_.metrics},
                                              {"points", overrides}});
        ProcessPool pool(options_.jobs);
        Batch batch(pool, options_.binary, folder, task_.metrics.size(), open.size() * scenarios, progress_);
        const std::size_t total = open.size() * scenarios, jobs = static_cast<std::size_t>(options_.jobs);
        const std::size_t chunk = std::max<std::size_t>(1, std::min(kChunk, (total + jobs - 1) / jobs));
        for (std::size_t first = 0; first < total; first += chunk)
            batch.queue(first, std::min(first + chunk, total));
        if (!pool.run(interrupted_, [](const std::string&) {})) return false;
        for (std::size_t k = 0; k < open.size(); ++k) {
            const auto begin = batch.answers().begin() + (k * scenarios);
            log_.add(spec.text(), part, open[k], {begin, begin + scenarios});
        }
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    results.clear();
    for (const FitPoint& point : points) results.push_back(log_.find(spec.text(), part, point));
    return true;
}

}  // namespace rigor::validation
