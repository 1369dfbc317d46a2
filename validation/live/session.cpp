// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The clock of a session and what it shows. Commands: session_commands.cpp.
#include "validation/live/session.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/runner/scenario_settings.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(8);
constexpr double kMostAhead = 1e9;    ///< [steps] of a tick, where no instance sets the pace
constexpr double kLongestTick = 0.1;  ///< [s] a process that was stopped does not run after its clock

}  // namespace

Session::Session(SessionOptions options, const std::string& text, std::vector<adapter::EngineSpec> specs)
    : options_(std::move(options)) {
    open(text, specs);
    ticker_ = std::thread([this] { tick(); });
}

Session::~Session() {
    close();
    ending_ = true;
    clock_.changed.notify_all();
    ticker_.join();
    Slots instances;
    {
        const std::lock_guard lock(clock_.mutex);
        instances.swap(instances_);
    }
}

void Session::close() {
    {
        const std::lock_guard lock(clock_.mutex);
        closed_ = true;
    }
    clock_.changed.notify_all();
}

void Session::open(const std::string& text) {
    std::vector<adapter::EngineSpec> specs;
    {
        const std::lock_guard lock(clock_.mutex);
        for (const auto& instance : instances_)
            if (!instance->plan.branchOf) specs.push_back(instance->plan.requested);
    }
    open(text, specs);
}

/// Replaces the scenario and all instances.
void Session::open(const std::string& text, const std::vector<adapter::EngineSpec>& specs) {
    auto loaded = scenario::loadScenarioText(text, "scenario");
    Slots old;
    {
        const std::lock_guard lock(clock_.mutex);
        old.swap(instances_);
        opened_ = {loaded.text, std::move(loaded.scenario)};
        dt_ = options_.dt > 0.0 ? options_.dt : opened_.scenario.timeSteps.front();
        playing_ = false;
        clock_.target = 0;
        pace_ = engine::FrameClock(dt_);
        reached_ = 0.0;
        for (const adapter::EngineSpec& spec : specs) {
            if (instances_.size() == kMaxInstances) break;
            instances_.push_back(
                makeInstance({nextId_++, spec.text(), opened_.text, opened_.text, spec,
                              withScenarioSettings(spec, opened_.text), dt_, 0, std::nullopt}));
        }
        ++clock_.sequence;
    }
    clock_.changed.notify_all();
}

std::unique_ptr<InstanceSlot> Session::makeInstance(InstancePlan plan) {
    return std::make_unique<InstanceSlot>(std::move(plan), options_.binary, options_.limits, clock_);
}

/// Real time times the speed, but no faster than the slowest instance that responds in time.
void Session::advanceClock(double seconds) {
    const double wanted = seconds * speed_ / dt_;
    double slowest = std::numeric_limits<double>::infinity();
    for (const auto& instance : instances_)
        if (instance->setsThePace()) slowest = std::min(slowest, static_cast<double>(instance->step()));
    const bool any = std::any_of(instances_.begin(), instances_.end(), [](const auto& instance) {
        return instance->state() == InstanceSlot::State::Ready;
    });
    // Steps that the slowest instance could not keep up with are skipped.
    const double most = slowest + std::max(1.0, 4.0 * wanted) - static_cast<double>(clock_.target);
    const double before = static_cast<double>(clock_.target) + pace_.fraction();
    if (any)
        clock_.target += static_cast<std::size_t>(
            pace_.advance(seconds * speed_, static_cast<std::int64_t>(std::clamp(most, 0.0, kMostAhead))));
    const double rate = (static_cast<double>(clock_.target) + pace_.fraction() - before) * dt_ / seconds;
    reached_ += (rate - reached_) * std::min(1.0, 2.0 * seconds);
}

void Session::tick() {
    auto last = Clock::now();
    while (!ending_) {
        std::this_thread::sleep_for(kTick);
        const auto now = Clock::now();
        const double seconds = std::min(kLongestTick, std::chrono::duration<double>(now - last).count());
        last = now;
        bool moved = false;
        {
            const std::lock_guard lock(clock_.mutex);
            const std::size_t before = clock_.target;
            if (playing_) advanceClock(seconds);
            moved = clock_.target != before;
        }
        if (moved) clock_.changed.notify_all();
    }
}

InstanceSlot* Session::find(int id) {
    const auto it = std::find_if(instances_.begin(), instances_.end(),
                                 [id](const auto& instance) { return instance->plan.id == id; });
    return it == instances_.end() ? nullptr : it->get();
}

json Session::state() {
    json instances = json::array();
    for (const auto& instance : instances_) {
        json one{{"id", instance->plan.id},
                 {"title", instance->plan.title},
                 {"spec", instance->plan.spec.text()},
                 {"engine", instance->plan.spec.engine},
                 {"options", instance->plan.spec.options},
                 {"state", instanceStateName(instance->state())},
                 {"message", instance->message()},
                 {"step", instance->step()},
                 {"start_step", instance->plan.startStep},
                 {"has_stages", instance->hasStages()},
                 {"frames", instance->frames()}};
        if (instance->plan.branchOf) one["branch_of"] = *instance->plan.branchOf;
        instances.push_back(std::move(one));
    }
    return {{"scenario", opened_.scenario.name},
            {"title", opened_.scenario.title},
            {"dimension", opened_.scenario.dimension},
            {"duration", opened_.scenario.duration},
            {"dt", dt_},
            {"playing", playing_},
            {"speed", speed_},
            {"reached_speed", playing_ ? reached_ : 0.0},
            {"step", clock_.target},
            {"stages", clock_.stages},
            {"instances", std::move(instances)}};
}

Packet Session::frames(std::uint64_t after, double seconds) {
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    Packet packet;
    {
        std::unique_lock lock(clock_.mutex);
        clock_.changed.wait_until(lock, deadline, [&] { return closed_ || clock_.sequence > after; });
        packet.header["sequence"] = clock_.sequence;
        packet.header["session"] = state();
        json frames = json::array();
        for (const auto& instance : instances_) {
            if (instance->sequence() <= after || instance->frames() == 0) continue;
            json frame = instance->frame().header;
            packet.arrays.take(std::to_string(instance->plan.id) + "/", instance->frame().arrays);
            frame["instance"] = instance->plan.id;
            frame["step"] = instance->step();
            frame["time"] = instance->step() * instance->plan.dt;
            frames.push_back(std::move(frame));
        }
        packet.header["frames"] = std::move(frames);
    }
    return packet;
}

std::optional<scenario::Scenario> Session::scenarioOf(int id) {
    std::string text;
    {
        const std::lock_guard lock(clock_.mutex);
        const InstanceSlot* instance = find(id);
        if (instance == nullptr) return std::nullopt;
        text = instance->plan.text;
    }
    return scenario::loadScenarioText(text, "scenario").scenario;
}

json Session::scene(int id) {
    const std::optional<scenario::Scenario> runs = scenarioOf(id);
    json description;
    {
        const std::lock_guard lock(clock_.mutex);
        const InstanceSlot* instance = find(id);
        if (instance == nullptr || !runs) return nullptr;
        description = instance->description();
    }
    return {{"scenario", json::parse(scenario::scenarioText(*runs))},
            {"description", std::move(description)}};
}

std::size_t Session::keptBytes() {
    const std::lock_guard lock(clock_.mutex);
    std::size_t bytes = 0;
    for (const auto& instance : instances_) bytes += instance->frame().arrays.size();
    return bytes;
}

}  // namespace rigor::validation
