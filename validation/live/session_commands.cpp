// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Commands of a session.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "scenarios/loader/loader.hpp"
#include "validation/live/saved_scene.hpp"
#include "validation/live/session.hpp"
#include "validation/runner/scenario_settings.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr long kMostSteps = 100000;  ///< maximum number of steps of one command
constexpr double kSlowest = 1e-3, kFastest = 1e3;

long wholeNumber(const json& request, const char* key, long otherwise) {
    if (!request.contains(key)) return otherwise;
    if (!request[key].is_number_integer())
        throw CommandError(std::string(key) + ": a whole number is needed");
    return request[key].get<long>();
}

/// Writes a file that is not there yet.
void writeNewFile(const fs::path& file, const std::string& text) {
    const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (out < 0)
        throw CommandError(errno == EEXIST ? "there is a file " + file.string() + " already"
                                           : file.string() + ": " + std::strerror(errno));
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t n = write(out, text.data() + done, text.size() - done);
        if (n <= 0 && errno != EINTR) break;
        if (n > 0) done += n;
    }
    const bool closed = close(out) == 0;
    if (done < text.size() || !closed) {
        unlink(file.c_str());
        throw CommandError(file.string() + ": could not be written");
    }
}

/// The spec of a branch: another engine, or the same with other options; null takes an option away.
adapter::EngineSpec changedSpec(const adapter::EngineSpec& from, const json& request,
                                const std::string& original) {
    adapter::EngineSpec spec = from;
    if (request.contains("spec"))
        spec = withScenarioSettings(adapter::parseSpec(request["spec"].get<std::string>()), original);
    const json options = request.value("options", json::object());
    for (const auto& [key, value] : options.items()) {
        if (value.is_null())
            spec.options.erase(key);
        else
            spec.options[key] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    return spec;
}

}  // namespace

json Session::command(const json& given) {
    json request = given, answer = json::object();
    // Version 0.1 called an instance a lane.
    if (request.is_object() && request.contains("lane")) request.emplace("instance", request["lane"]);
    try {
        const std::string name = request.is_object() ? request.value("command", "") : "";
        if (name == "play" || name == "pause" || name == "speed" || name == "stages")
            changePace(request);
        else if (name == "step")
            step(wholeNumber(request, "steps", 1));
        else if (name == "back")
            step(-wholeNumber(request, "steps", 1));
        else if (name == "stage")
            stage();
        else if (name == "reset")
            reset();
        else if (name == "restart")
            restart(wholeNumber(request, "instance", -1));
        else if (name == "drag" || name == "release")
            drag(request, name == "release");
        else if (name == "add")
            answer = add(request);
        else if (name == "branch")
            answer = branch(request);
        else if (name == "save")
            answer = save(request);
        else if (name == "remove")
            remove(wholeNumber(request, "instance", -1));
        else
            throw CommandError("no command '" + name + "'");
    } catch (const json::exception& error) {
        throw CommandError(error.what());
    } catch (const scenario::LoadError& error) {
        throw CommandError(error.problems().front().text());
    } catch (const adapter::BadInput& error) {
        throw CommandError(error.what());
    }
    {
        const std::lock_guard lock(clock_.mutex);
        ++clock_.sequence;
    }
    clock_.changed.notify_all();
    return answer;
}

void Session::changePace(const json& request) {
    const std::lock_guard lock(clock_.mutex);
    const std::string name = request.at("command");
    if (name == "stages") {
        clock_.stages = request.at("on").get<bool>();
    } else if (name == "speed") {
        const double factor = request.at("factor").get<double>();
        if (!(factor >= kSlowest && factor <= kFastest)) throw CommandError("factor: from 0.001 to 1000");
        speed_ = factor;
    } else {
        playing_ = name == "play";
        reached_ = 0.0;
        if (!playing_) pace_.restart();
    }
}

void Session::pause() {
    playing_ = false;
    pace_.restart();
}

void Session::step(long by) {
    if (by == 0 || std::abs(by) > kMostSteps) throw CommandError("steps: from 1 to 100000");
    const std::lock_guard lock(clock_.mutex);
    pause();
    if (by > 0) {
        clock_.target += static_cast<std::size_t>(by);
        return;
    }
    // Going back from a step that has begun leads to its start.
    const bool inStep = std::any_of(instances_.begin(), instances_.end(),
                                    [](const auto& instance) { return instance->inStep(); });
    const auto back = static_cast<std::size_t>(-by) - (inStep ? 1 : 0);
    goBack(clock_.target - std::min(back, clock_.target));
}

void Session::goBack(std::size_t step) {
    clock_.target = step;
    for (const auto& instance : instances_)
        if (instance->alive()) instance->requestStep(step);
}

void Session::stage() {
    const std::lock_guard lock(clock_.mutex);
    pause();
    bool any = false;
    for (const auto& instance : instances_) {
        if (instance->state() != InstanceSlot::State::Ready || !instance->hasStages()) continue;
        instance->requestStage();
        any = true;
    }
    if (!any) throw CommandError("no engine here shows the stages of its step");
}

/// All instances back to their start; those that have come to an end begin anew.
void Session::reset() {
    const std::lock_guard lock(clock_.mutex);
    pause();
    clock_.target = 0;
    for (const auto& instance : instances_) instance->requestReset();
}

/// A new process for an instance that has ended. It comes to the session's time like one that is added. One that died would
/// come to the step at which it did so once more: the session goes back to its last frame and stands still there.
void Session::restart(int id) {
    const std::lock_guard lock(clock_.mutex);
    InstanceSlot* instance = find(id);
    if (instance == nullptr) throw CommandError("no such instance");
    if (instance->alive() || instance->state() == InstanceSlot::State::Loading)
        throw CommandError("the instance has not ended");
    const bool died = instance->state() == InstanceSlot::State::Crashed ||
                      instance->state() == InstanceSlot::State::TimedOut;
    const std::size_t last = instance->step();
    instance->requestRestart();
    if (!died || last >= clock_.target) return;
    pause();
    goBack(last);
}

void Session::drag(const json& request, bool release) {
    json pull = release ? json()
                        : json{{"body", request.at("body")},
                               {"point", request.at("point")},
                               {"target", request.at("target")},
                               {"stiffness", request.value("stiffness", 0.0)}};
    if (!release)
        for (const char* key : {"point", "target"})
            if (!pull[key].is_array() || pull[key].size() != 3)
                throw CommandError(std::string(key) + ": three numbers are needed");
    const std::lock_guard lock(clock_.mutex);
    const long only = wholeNumber(request, "instance", -1);
    for (const auto& instance : instances_)
        if (instance->alive() && (only < 0 || instance->plan.id == only)) instance->requestDrag(pull);
}

void Session::remove(int id) {
    std::unique_ptr<InstanceSlot> gone;  // ends after the lock: its thread needs it
    const std::lock_guard lock(clock_.mutex);
    const auto it = std::find_if(instances_.begin(), instances_.end(),
                                 [id](const auto& instance) { return instance->plan.id == id; });
    if (it == instances_.end()) throw CommandError("no such instance");
    gone = std::move(*it);
    instances_.erase(it);
}

/// A new instance, once it has loaded; what can not be loaded is an error and no instance.
json Session::insert(InstancePlan plan) {
    const int id = plan.id;
    {
        const std::lock_guard lock(clock_.mutex);
        if (instances_.size() >= kMaxInstances) throw CommandError("no more than 8 instances");
        instances_.push_back(makeInstance(std::move(plan)));
    }
    std::string problem;
    {
        std::unique_lock lock(clock_.mutex);
        clock_.changed.wait(lock, [&] {
            const InstanceSlot* instance = find(id);
            return closed_ || instance == nullptr || instance->state() != InstanceSlot::State::Loading;
        });
        const InstanceSlot* instance = find(id);
        if (instance != nullptr && !instance->alive())
            problem = std::string(instanceStateName(instance->state())) + ": " + instance->message();
    }
    if (!problem.empty()) {
        remove(id);
        throw CommandError(problem);
    }
    return {{"instance", id}};
}

json Session::add(const json& request) {
    InstancePlan plan;
    plan.requested = adapter::parseSpec(request.at("spec").get<std::string>());
    plan.title = plan.requested.text();
    {
        const std::lock_guard lock(clock_.mutex);
        plan.id = nextId_++;
        plan.text = plan.original = opened_.text;
        plan.dt = dt_;
    }
    plan.spec = withScenarioSettings(plan.requested, plan.original);
    return insert(std::move(plan));
}

StateReply Session::nowOf(int id) {
    std::future<StateReply> future;
    {
        const std::lock_guard lock(clock_.mutex);
        InstanceSlot* instance = find(id);
        if (instance == nullptr) throw CommandError("no such instance");
        future = instance->requestState();
    }
    clock_.changed.notify_all();
    StateReply now = future.get();
    if (!now.error.empty()) throw CommandError(now.error);
    return now;
}

json Session::branch(const json& request) {
    const int id = wholeNumber(request, "instance", -1);
    const StateReply now = nowOf(id);
    InstancePlan plan;
    {
        const std::lock_guard lock(clock_.mutex);
        const InstanceSlot* from = find(id);
        if (from == nullptr) throw CommandError("no such instance");
        plan = from->plan;
        plan.id = nextId_++;
    }
    plan.spec = changedSpec(plan.spec, request, plan.original);
    const auto overrides = request.value("set", std::vector<std::string>{});
    plan.text = scenario::loadScenarioText(now.text, "scenario", overrides).text;
    plan.startStep = now.step;
    plan.branchOf = id;
    plan.title = plan.spec.text();
    for (const std::string& change : overrides) plan.title += " " + change;
    json answer = insert(std::move(plan));
    answer["notes"] = now.notes;
    return answer;
}

json Session::save(const json& request) {
    const int id = wholeNumber(request, "instance", -1);
    const StateReply now = nowOf(id);
    SeenScene seen{now.text, now.notes, {}, 0.0};
    std::string original, name;
    {
        const std::lock_guard lock(clock_.mutex);
        const InstanceSlot* instance = find(id);
        if (instance == nullptr) throw CommandError("no such instance");
        seen.spec = instance->plan.spec;
        seen.time = now.step * instance->plan.dt;
        original = instance->plan.original;
        name = opened_.scenario.name;
    }
    const std::string text = savedScenario(seen, original);
    json answer{{"text", text}, {"notes", now.notes}, {"name", savedName(name, seen.time) + ".json"}};
    if (!request.value("write", false)) return answer;
    const fs::path file = options_.saveFolder / answer["name"].get<std::string>();
    writeNewFile(file, text);
    answer["file"] = file.string();
    return answer;
}

}  // namespace rigor::validation
