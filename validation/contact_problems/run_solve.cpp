// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/contact_problems/problem.hpp"
#include "validation/contact_problems/solve.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

double largestOf(const std::vector<double>& x) {
    double most = 0.0;
    for (const double v : x) most = std::max(most, std::abs(v));
    return most;
}

/// The relative velocities that a file's stored solution means; empty: it has none.
std::vector<double> storedVelocities(const ExportedProblem& exported) {
    if (!exported.storedR.empty()) return relativeVelocities(exported.problem, exported.storedR);
    return exported.storedU;
}

double velocityError(const ExportedProblem& exported, const std::vector<double>& r) {
    const std::vector<double> stored = storedVelocities(exported);
    if (stored.empty()) return -1.0;
    std::vector<double> u = relativeVelocities(exported.problem, r);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] -= stored[i];
    const double scale = std::max(largestOf(stored), largestOf(exported.problem.q));
    return scale > 0.0 ? largestOf(u) / scale : 0.0;
}

SolveStep judge(const json& line, const ExportedProblem& exported, const adapter::FrictionModel& model) {
    std::vector<double> r;
    for (const json& x : line.at("r")) r.push_back(numberFromJson(x));
    SolveStep step;
    step.allowed = line.at("allowed");
    step.done = line.at("done");
    step.gaveUp = line.at("gave_up");
    step.seconds = numberFromJson(line.at("seconds"));
    step.runs = line.at("runs");
    step.residual = contactResidual(exported.problem, r, model);
    step.velocityError = velocityError(exported, r);
    return step;
}

/// Reads the whole lines that the child had written when it ended.
void readAnswer(const std::filesystem::path& file, const ExportedProblem& exported, SolveAnswer& answer) {
    std::ifstream in(file);
    for (std::string text; std::getline(in, text);) {
        const json line = json::parse(text, nullptr, false);
        if (line.is_discarded()) return;
        if (line.contains("unsupported")) {
            answer.outcome = "unsupported";
            answer.message = line.at("unsupported");
        } else if (line.contains("problem")) {
            answer.outcome = "error";
            answer.message = line.at("problem");
        } else if (line.contains("model")) {
            answer.model.kind = static_cast<adapter::FrictionModel::Kind>(line.at("model").get<int>());
            answer.model.corners = line.at("corners");
        } else {
            answer.steps.push_back(judge(line, exported, answer.model));
        }
    }
}

SolvedProblem describe(const std::filesystem::path& file, const ExportedProblem& exported) {
    SolvedProblem problem;
    problem.file = file;
    problem.name = exported.title.empty() ? file.stem().string() : exported.title;
    problem.description = exported.description;
    problem.dimension = exported.problem.dimension;
    problem.contacts = exported.problem.contacts();
    problem.unknowns = exported.problem.f.size();
    if (exported.storedR.empty()) return problem;
    SolveAnswer stored;
    stored.solver = "stored";
    SolveStep step;
    step.residual = contactResidual(exported.problem, exported.storedR);
    step.velocityError = 0.0;
    stored.steps = {step};
    problem.answers.push_back(std::move(stored));
    return problem;
}

}  // namespace

std::vector<adapter::EngineSpec> contactSolverSpecs(const std::vector<adapter::EngineSpec>& requested,
                                                    const std::filesystem::path& binary) {
    std::vector<adapter::EngineSpec> wanted = requested;
    if (wanted.empty())
        for (const std::string& engine : adapter::availableEngines()) wanted.push_back({engine, {}});
    std::vector<adapter::EngineSpec> specs;
    for (const adapter::EngineSpec& spec : wanted) {
        (void)adapter::moduleFor(spec);
        const EngineDescription engine = describeEngine(spec.engine, binary);
        if (!engine.problem.empty() || !engine.capabilities.contactSolvers) {
            if (requested.empty()) continue;
            throw adapter::BadInput(engine.problem.empty()
                                        ? spec.engine + " has no solvers for contact problems"
                                        : spec.engine + ": " + engine.problem);
        }
        checkSettings(spec, engine);
        if (spec.options.count("solver") > 0) {
            specs.push_back(spec);
            continue;
        }
        for (const adapter::Option& option : engine.options) {
            if (option.key != "solver") continue;
            for (const std::string& name : option.values) {
                specs.push_back(spec);
                specs.back().options["solver"] = name;
            }
        }
    }
    return specs;
}

std::vector<SolvedProblem> solveFiles(const std::vector<std::filesystem::path>& files,
                                      const std::vector<adapter::EngineSpec>& specs,
                                      const SolveOptions& options,
                                      const std::function<void(const std::string&)>& onStart,
                                      const std::atomic<bool>& interrupted, bool& complete) {
    std::vector<SolvedProblem> problems;
    std::deque<ExportedProblem> exported;
    for (const auto& file : files) {
        exported.push_back(readContactProblem(file));
        problems.push_back(describe(file, exported.back()));
        for (const auto& spec : specs) {
            problems.back().answers.emplace_back();
            problems.back().answers.back().solver = spec.text();
        }
    }
    const ScratchFolder scratch;
    ProcessPool pool(options.jobs);
    int count = 0;
    for (std::size_t k = 0; k < problems.size(); ++k)
        for (SolveAnswer& answer : problems[k].answers) {
            if (answer.solver == "stored") continue;
            const std::string id = std::to_string(count++);
            const auto request = scratch.path() / (id + ".json"), reply = scratch.path() / (id + ".jsonl");
            writeJsonFile(request, {{"file", std::filesystem::absolute(problems[k].file).string()},
                                    {"spec", answer.solver},
                                    {"iterations", options.iterations},
                                    {"tolerance", numberToJson(options.tolerance)},
                                    {"seconds", numberToJson(options.seconds)},
                                    {"answer", reply.string()}});
            ProcessTask task;
            task.arguments = {options.binary.string(), "__solve", request.string()};
            task.limits = {(20.0 + 20.0 * options.seconds) * timeLimitFactor(), 4096};
            task.name = problems[k].name + ", " + answer.solver;
            task.done = [&answer, &problem = exported[k], reply](const ProcessResult& result) {
                readAnswer(reply, problem, answer);
                if (result.timedOut)
                    answer.outcome = "timeout";
                else if (!result.exitedWith(0)) {
                    answer.outcome = "crashed";
                    answer.message = result.ending();
                }
            };
            pool.add(std::move(task));
        }
    complete = pool.run(interrupted, onStart);
    return problems;
}

bool solveIsGreen(const std::vector<SolvedProblem>& problems) {
    for (const SolvedProblem& problem : problems)
        for (const SolveAnswer& answer : problem.answers) {
            if (adapter::parseSpec(answer.solver).engine != kInHouseEngine) continue;
            if (answer.outcome != "solved" && answer.outcome != "unsupported") return false;
            for (const SolveStep& step : answer.steps)
                if (!std::isfinite(step.residual.relative)) return false;
        }
    return true;
}

}  // namespace rigor::validation
