// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine's side of exporting: one run up to the step, in a child process.
#include <atomic>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "adapters/interface/options.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/contact_problems/export_step.hpp"
#include "validation/contact_problems/residual.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/forces.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

ExportSummary exportHere(const ExportRequest& request, const std::filesystem::path& file) {
    const scenario::Scenario s =
        scenario::loadScenarioText(request.scenarioText, request.scenarioName).scenario;
    const RecordedStep step = runToStep(s, request);
    ExportedProblem exported = exportStep(s, step);
    ExportSummary summary;
    summary.contacts = exported.problem.contacts();
    summary.bodies = exported.problem.f.size() / (s.dimension == 3 ? 6 : 3);
    summary.time = request.step * request.dt;
    if (!exported.storedR.empty())
        summary.storedResidual = contactResidual(exported.problem, exported.storedR).relative;
    exported.description = "step " + std::to_string(request.step) +
                           " (to t = " + adapter::shown(summary.time) +
                           " s, dt = " + adapter::shown(request.dt) + " s) of " + s.name + " by " +
                           request.spec.text() + "; the stored solution is what that engine did";
    exported.mathInfo =
        "SI units; per dynamic body velocity of the centre of mass and angular velocity, world axes";
    writeFclib(exported, file);
    return summary;
}

}  // namespace

RecordedStep runToStep(const scenario::Scenario& s, const ExportRequest& request) {
    const adapter::LoadedEngine engine = adapter::loadEngine(request.spec);
    if (engine->dynamics() == nullptr)
        throw adapter::Unsupported("engine '" + request.spec.engine + "' simulates nothing");
    const auto world = engine.build(s, request.dt, adapter::resolveSettings(request.spec, *engine));
    RecordedStep recorded;
    recorded.dt = request.dt;
    recorded.before.resize(s.bodies.size());
    recorded.after.resize(s.bodies.size());
    world->readStates(recorded.after);
    for (std::size_t k = 0; k < request.step; ++k) {
        std::swap(recorded.before, recorded.after);
        applyForces(s, k, request.dt, recorded.before, *world);
        world->step();
        world->readStates(recorded.after);
    }
    world->readContacts(recorded.contacts);
    recorded.contactInstant = world->contactInstant();
    recorded.loads = loadsOf(s, request.step - 1, request.dt, recorded.before);
    return recorded;
}

int exportChild(const std::filesystem::path& requestFile) {
    const auto j = readJsonFile(requestFile);
    if (!j) throw std::runtime_error(requestFile.string() + ": no request");
    ExportRequest request{j->at("text"), j->at("scenario"), adapter::parseSpec(j->at("spec")),
                          numberFromJson(j->at("dt")), j->at("step")};
    json answer;
    try {
        const ExportSummary summary = exportHere(request, j->at("file").get<std::string>());
        answer = {{"contacts", summary.contacts},
                  {"bodies", summary.bodies},
                  {"time", numberToJson(summary.time)},
                  {"residual", numberToJson(summary.storedResidual)}};
    } catch (const adapter::Unsupported& error) {
        answer = {{"unsupported", error.what()}};
    } catch (const std::exception& error) {
        answer = {{"problem", error.what()}};
    }
    writeJsonFile(j->at("answer").get<std::string>(), answer);
    return 0;
}

ExportSummary exportToFile(const ExportRequest& request, const std::filesystem::path& binary,
                           const std::filesystem::path& file) {
    const ScratchFolder scratch;
    const auto requestFile = scratch.path() / "request.json", answerFile = scratch.path() / "answer.json";
    writeJsonFile(requestFile, {{"text", request.scenarioText},
                                {"scenario", request.scenarioName},
                                {"spec", request.spec.text()},
                                {"dt", numberToJson(request.dt)},
                                {"step", request.step},
                                {"file", std::filesystem::absolute(file).string()},
                                {"answer", answerFile.string()}});
    ProcessTask task;
    task.arguments = {binary.string(), "__export", requestFile.string()};
    task.limits = {3600.0 * timeLimitFactor(), 4096};
    std::string ending;
    task.done = [&ending](const ProcessResult& result) {
        if (!result.exitedWith(0)) ending = result.ending() + "\n" + result.outputTail;
    };
    ProcessPool pool(1);
    pool.add(std::move(task));
    const std::atomic<bool> never{false};
    pool.run(never, [](const std::string&) {});
    const auto answer = readJsonFile(answerFile);
    if (!ending.empty() || !answer) throw std::runtime_error(request.spec.engine + " ended with " + ending);
    if (answer->contains("unsupported")) throw adapter::Unsupported(answer->at("unsupported"));
    if (answer->contains("problem")) throw adapter::BadInput(answer->at("problem"));
    return {answer->at("contacts"), answer->at("bodies"), numberFromJson(answer->at("time")),
            numberFromJson(answer->at("residual"))};
}

}  // namespace rigor::validation
