// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One engine run case by case. Every result is written before the next case begins, so that a library that
// ends the process costs one result; an alarm ends a case that hangs.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "adapters/interface/input_check.hpp"
#include "validation/fit/fit.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/line_file.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/simulate.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

/// Data shared by all cases of a batch.
struct Shared {
    adapter::EngineSpec spec;
    adapter::LoadedEngine engine;
    adapter::Settings settings;
    std::vector<std::string> metrics;
};

json measure(const Shared& shared, const scenario::Scenario& s, double dt) {
    adapter::checkScenarioInput(s, dt);
    adapter::checkSupported(s, shared.engine->capabilities(), shared.spec.engine);
    const auto reference = makeReference(s);
    const auto world = shared.engine.build(s, dt, shared.settings);
    const Simulation run = simulate(s, dt, *world, {});
    if (!run.nonFinite.empty()) return "non-finite: " + run.nonFinite;
    json values = json::array();
    for (const std::string& name : shared.metrics) {
        const auto rows = findMetric(name)->evaluate({s, run.trajectory, reference.get(), world->scheme()});
        if (rows.empty()) return "the run shows no " + name;
        values.push_back(numberToJson(rows.front().value));
    }
    return values;
}

json answerTo(const Shared& shared, const std::string& text, const std::vector<std::string>& overrides,
              double batchStep) {
    try {
        const scenario::Scenario s = scenario::loadScenarioText(text, "scenario", overrides).scenario;
        setAlarm(s.timeLimit * timeLimitFactor());
        json answer = measure(shared, s, batchStep > 0.0 ? batchStep : s.timeSteps.front());
        setAlarm(0.0);
        return answer;
    } catch (const std::exception& error) {
        setAlarm(0.0);
        return error.what();
    }
}

}  // namespace

int fitChild(const std::filesystem::path& requestFile) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    const auto batch = readJsonFile(request->at("batch").get<std::string>());
    const auto texts = batch ? readJsonFile(batch->at("scenarios").get<std::string>()) : std::nullopt;
    if (!texts) throw std::runtime_error("the cases can not be read");
    const adapter::EngineSpec spec = adapter::parseSpec(batch->at("spec").get<std::string>());
    Shared shared{spec, adapter::loadEngine(spec), {}, batch->at("metrics")};
    if (shared.engine->dynamics() == nullptr)
        throw adapter::BadInput("engine '" + spec.engine + "' has no dynamics");
    shared.settings = adapter::resolveSettings(spec, *shared.engine);
    const double dt = numberFromJson(batch->at("dt"));
    LineWriter out(request->at("answer").get<std::string>());
    const auto last = request->at("last").get<std::size_t>();
    for (auto k = request->at("first").get<std::size_t>(); k < last; ++k)
        out.add(answerTo(shared, texts->at(k % texts->size()).get<std::string>(),
                         batch->at("points").at(k / texts->size()).get<std::vector<std::string>>(), dt));
    return 0;
}

}  // namespace rigor::validation
