// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The engine's side of freezing: one run up to the step, in a child process.
#include <atomic>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "adapters/interface/options.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/contact_problems/freeze.hpp"
#include "validation/contact_problems/residual.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/forces.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

Frozen freezeHere(const FreezeRequest& request, const std::filesystem::path& file) {
    const scenario::Scenario s =
        scenario::loadScenarioText(request.scenarioText, request.scenarioName).scenario;
    const ToldStep step = runToStep(s, request);
    FrozenProblem frozen = freezeStep(s, step);
    Frozen told;
    told.contacts = frozen.problem.contacts();
    told.bodies = frozen.problem.f.size() / (s.dimension == 3 ? 6 : 3);
    told.time = static_cast<double>(request.step) * request.dt;
    if (!frozen.storedR.empty())
        told.storedResidual = contactResidual(frozen.problem, frozen.storedR).relative;
    frozen.description = "step " + std::to_string(request.step) + " (to t = " + adapter::shown(told.time) +
                         " s, dt = " + adapter::shown(request.dt) + " s) of " + s.name + " by " +
                         request.spec.text() + "; the stored solution is what that engine did";
    frozen.mathInfo =
        "SI units; per dynamic body velocity of the centre of mass and angular velocity, world axes";
    writeFclib(frozen, file);
    return told;
}

}  // namespace

ToldStep runToStep(const scenario::Scenario& s, const FreezeRequest& request) {
    const adapter::LoadedEngine engine = adapter::loadEngine(request.spec);
    if (engine->dynamics() == nullptr)
        throw adapter::Unsupported("engine '" + request.spec.engine + "' simulates nothing");
    const auto world =
        engine->dynamics()->build(s, request.dt, adapter::resolveSettings(request.spec, *engine));
    ToldStep told;
    told.dt = request.dt;
    told.before.resize(s.bodies.size());
    told.after.resize(s.bodies.size());
    world->readStates(told.after);
    for (std::size_t k = 0; k < request.step; ++k) {
        std::swap(told.before, told.after);
        applyForces(s, k, request.dt, told.before, *world);
        world->step();
        world->readStates(told.after);
    }
    world->readContacts(told.contacts);
    told.loads = loadsOf(s, request.step - 1, request.dt, told.before);
    return told;
}

int freezeChild(const std::filesystem::path& requestFile) {
    const auto j = readJsonFile(requestFile);
    if (!j) throw std::runtime_error(requestFile.string() + ": no request");
    FreezeRequest request{j->at("text"), j->at("scenario"), adapter::parseSpec(j->at("spec")),
                          numberFromJson(j->at("dt")), j->at("step")};
    json answer;
    try {
        const Frozen told = freezeHere(request, j->at("file").get<std::string>());
        answer = {{"contacts", told.contacts},
                  {"bodies", told.bodies},
                  {"time", numberToJson(told.time)},
                  {"residual", numberToJson(told.storedResidual)}};
    } catch (const adapter::Unsupported& error) {
        answer = {{"unsupported", error.what()}};
    } catch (const std::exception& error) {
        answer = {{"problem", error.what()}};
    }
    writeJsonFile(j->at("answer").get<std::string>(), answer);
    return 0;
}

Frozen freezeToFile(const FreezeRequest& request, const std::filesystem::path& binary,
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
    task.arguments = {binary.string(), "__freeze", requestFile.string()};
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
