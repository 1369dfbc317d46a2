// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One solver on one problem: growing numbers of iterations, each from r = 0, timed here (the solution alone,
// not the reading), judged by the parent. Every result is written before the next, so that a library that
// ends the process loses one.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/contact_problems/problem.hpp"
#include "validation/contact_problems/solve.hpp"
#include "validation/runner/answer.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr int kMostRuns = 15;          ///< maximum number of runs of which the median is taken
constexpr double kTimeOfARung = 0.25;  ///< [s] worth repeating for

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

json climb(adapter::ContactSolve& solve, int iterations, double tolerance) {
    adapter::ContactSolution found = solve.run(iterations, tolerance);  // the first allocates
    std::vector<double> seconds;
    const Clock::time_point begin = Clock::now();
    do {
        const Clock::time_point start = Clock::now();
        found = solve.run(iterations, tolerance);
        seconds.push_back(since(start));
    } while (static_cast<int>(seconds.size()) < kMostRuns && since(begin) < kTimeOfARung);
    json r = json::array();
    for (const double x : found.r) r.push_back(numberToJson(x));
    return {{"allowed", iterations},   {"done", found.iterations},
            {"gave_up", found.gaveUp}, {"seconds", numberToJson(median(seconds))},
            {"runs", seconds.size()},  {"r", std::move(r)}};
}

double largest(const std::vector<double>& x) {
    double most = 0.0;
    for (const double v : x) most = std::max(most, std::abs(v));
    return most;
}

}  // namespace

int solveChild(const std::filesystem::path& requestFile) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    std::ofstream out(request->at("answer").get<std::string>());
    const auto say = [&out](const json& line) { out << line.dump() << std::endl; };
    try {
        const ExportedProblem exported = readContactProblem(request->at("file").get<std::string>());
        const adapter::EngineSpec spec = adapter::parseSpec(request->at("spec"));
        const adapter::LoadedEngine engine = adapter::loadEngine(spec);
        if (engine->contactSolvers() == nullptr)
            throw adapter::Unsupported(spec.engine + " has no solvers for contact problems");
        const auto solve =
            engine->contactSolvers()->take(exported.problem, adapter::resolveSettings(spec, *engine));
        const adapter::FrictionModel model = solve->friction();
        say({{"model", static_cast<int>(model.kind)}, {"corners", model.corners}});
        const double tolerance = numberFromJson(request->at("tolerance")) * largest(exported.problem.q);
        const double limit = numberFromJson(request->at("seconds"));
        const Clock::time_point begin = Clock::now();
        for (const int iterations : request->at("iterations").get<std::vector<int>>()) {
            const json step = climb(*solve, iterations, tolerance);
            say(step);
            // It stopped by itself, and would again.
            if (step.at("done").get<int>() < iterations || since(begin) > limit) break;
        }
    } catch (const adapter::Unsupported& error) {
        say({{"unsupported", error.what()}});
    } catch (const std::exception& error) {
        say({{"problem", error.what()}});
    }
    return 0;
}

}  // namespace rigor::validation
