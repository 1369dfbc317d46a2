// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A live session: one scenario, several instances, one clock. Commands and frames are JSON and packets;
// README.md lists them. All functions may be called from any thread.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/embedding/frame_clock.hpp"
#include "validation/live/instance_slot.hpp"
#include "validation/live/packet.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

struct SessionOptions {
    std::filesystem::path binary;      ///< the program itself, run again as `rigor __instance`
    std::filesystem::path saveFolder;  ///< folder in which scenarios are saved
    InstanceLimits limits;
    double dt = 0.0;  ///< [s]; 0: the scenario's first
};

/// A command that can not be done; what() says why.
class CommandError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Session {
  public:
    static constexpr std::size_t kMaxInstances = 8;

    /// Opens the scenario (text as LoadedScenario::text) with an instance for every spec. Throws
    /// scenario::LoadError.
    Session(SessionOptions options, const std::string& text, std::vector<adapter::EngineSpec> specs);
    ~Session();

    /// Another scenario, for the engines that have an instance now (branches apart). Throws
    /// scenario::LoadError.
    void open(const std::string& text);

    /// Executes {"command": ..., ...}; returns its response. Throws CommandError.
    nlohmann::json command(const nlohmann::json& request);

    /// All that is newer than `after`: the session's state and the last frame of every instance that has a newer one.
    /// Waits for it at most `seconds`; then without instances.
    Packet frames(std::uint64_t after, double seconds);

    /// The scenario that an instance runs, which never changes; nothing: no such instance.
    std::optional<scenario::Scenario> scenarioOf(int instance);
    /// {"scenario": what the instance runs with everything said in full, to draw it from, "description": how
    /// its engine was set up}; null: no such instance.
    nlohmann::json scene(int instance);
    /// Bytes of frames that are kept.
    std::size_t keptBytes();

    /// Ends all waiting in frames(); further calls return at once.
    void close();

  private:
    struct Opened {
        std::string text;
        scenario::Scenario scenario;
    };
    using Slots = std::vector<std::unique_ptr<InstanceSlot>>;

    void open(const std::string& text, const std::vector<adapter::EngineSpec>& specs);
    void tick();
    void advanceClock(double seconds);
    nlohmann::json state();
    InstanceSlot* find(int id);
    InstanceSlot& require(const nlohmann::json& request);
    std::unique_ptr<InstanceSlot> makeInstance(InstancePlan plan);
    nlohmann::json insert(InstancePlan plan);
    StateReply nowOf(int id);

    void changePace(const nlohmann::json& request);
    void pause();
    void step(long by);
    void stage();
    void reset();
    void restart(int id);
    /// The clock and all instances that can to a step before this one. Under the clock's lock.
    void goBack(std::size_t step);
    void drag(const nlohmann::json& request, bool release);
    void remove(int id);
    nlohmann::json add(const nlohmann::json& request);
    nlohmann::json branch(const nlohmann::json& request);
    nlohmann::json save(const nlohmann::json& request);

    SessionOptions options_;
    SessionClock clock_;
    // --- under the clock's lock
    Opened opened_;
    Slots instances_;
    bool playing_ = false, closed_ = false;
    double speed_ = 1.0, dt_ = 0.0;
    engine::FrameClock pace_{1.0};  ///< makes steps of the time that passes while the session plays
    double reached_ = 0.0;          ///< the speed that the instances allow, smoothed
    int nextId_ = 0;

    std::atomic<bool> ending_{false};
    std::thread ticker_;
};

}  // namespace rigor::validation
