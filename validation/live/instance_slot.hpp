// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An instance of a session: a thread that sends the requests of the session to the instance's process and
// keeps the last frame. Nothing queues up: the last request of each kind waits, older ones are dropped.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "validation/live/instance_process.hpp"

namespace rigor::validation {

/// Data shared by all instances of a session, under one lock.
struct SessionClock {
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t target = 0;      ///< target of the instances in steps from the start of the session
    std::uint64_t sequence = 0;  ///< counts every change that a client may show
    bool stages = false;         ///< frames carry what stages have made
};

struct InstanceLimits {
    double loadSeconds = 30.0, answerSeconds = 10.0;
    std::size_t memoryMiB = 4096;
};

/// Scenario and engine of an instance. Steps of the session are those of its first scenario; a branch starts
/// at a later one.
struct InstancePlan {
    int id = 0;
    std::string title;              ///< title that is displayed
    std::string text, original;     ///< the scenario it runs; the one that the session opened
    adapter::EngineSpec requested;  ///< spec as given by the user
    adapter::EngineSpec spec;       ///< spec with the engine settings of the scenario
    double dt = 0.0;
    std::size_t startStep = 0;
    std::optional<int> branchOf;
};

/// A scene and its notes, from `InstanceProcess` "now"; error: why there is none.
struct StateReply {
    std::string text, error;
    std::vector<std::string> notes;
    std::size_t step = 0;  ///< step of the session
};

class InstanceSlot {
  public:
    InstanceSlot(InstancePlan plan, std::filesystem::path binary, InstanceLimits limits, SessionClock& clock);
    /// Ends the process and the thread; the clock must not be locked.
    ~InstanceSlot();

    const InstancePlan plan;

    // --- all that follows under the clock's lock
    enum class State { Loading, Ready, NonFinite, Unsupported, BadInput, Error, Crashed, TimedOut };
    State state() const { return state_; }
    bool alive() const { return state_ == State::Ready || state_ == State::NonFinite; }
    const std::string& message() const { return message_; }
    std::size_t step() const { return step_; }  ///< step of the session
    bool inStep() const { return inStep_; }
    bool hasStages() const { return description_.value("has_stages", false); }
    const nlohmann::json& description() const { return description_; }
    const Packet& frame() const { return frame_; }
    std::uint64_t sequence() const {
        return sequence_;
    }                                                 ///< sequence number of the clock when the frame
                                                      ///< arrived
    std::uint64_t frames() const { return frames_; }  ///< number of frames that have arrived
    /// True if the session's clock waits for it: not while it loads, catches up, or has not responded for
    /// long.
    bool setsThePace() const;

    void requestStep(std::size_t step);
    /// Back to the start; in a new process if this one has ended, or ends before it is there.
    void requestReset();
    /// A new process for an instance that has ended; it comes to the session's time.
    void requestRestart();
    void requestStage();
    void requestDrag(nlohmann::json drag);  ///< null: release
    std::future<StateReply> requestState();

  private:
    struct Work {
        nlohmann::json request;
        std::optional<std::promise<StateReply>> now;
    };
    void run();
    void load(std::unique_lock<std::mutex>& lock);
    void beginAnew();
    bool hasWork() const;
    Work takeWork();
    void store(InstanceProcess::Answer answer, bool ofStage = false);
    double secondsFor(const nlohmann::json& request) const;
    void answerNow(std::promise<StateReply> promise, const InstanceProcess::Answer& answer);

    std::filesystem::path binary_;
    InstanceLimits limits_;
    SessionClock& clock_;
    State state_ = State::Loading;
    std::string message_;
    std::size_t step_ = 0;
    double stepSeconds_ = 0.0;  ///< last known time of a step, written and read by the thread alone
    bool inStep_ = false, catchingUp_ = true, closing_ = false;
    bool toLoad_ = true;      ///< the thread starts a new process
    bool resetting_ = false;  ///< a reset was requested and the instance is not at its start yet
    std::optional<std::chrono::steady_clock::time_point> requestedAt_;
    nlohmann::json description_ = nlohmann::json::object();
    Packet frame_;
    std::uint64_t sequence_ = 0, frames_ = 0;

    std::optional<std::size_t> goTo_;
    int stages_ = 0;
    std::optional<nlohmann::json> drag_;
    std::vector<std::promise<StateReply>> nows_;

    std::unique_ptr<InstanceProcess> process_;  ///< made and called by the thread alone
    std::thread thread_;
};

const char* instanceStateName(InstanceSlot::State state);

}  // namespace rigor::validation
