// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A lane of a session: a thread that asks the lane's process for what is wished, and keeps the last frame.
// Nothing queues up: of every kind of wish there is at most the last one, of frames the last one.
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
#include "validation/live/lane_process.hpp"

namespace rigor::validation {

/// What all lanes of a session share, under one lock.
struct SessionClock {
    std::mutex mutex;
    std::condition_variable changed;
    double target = 0.0;         ///< where the lanes are to be, in steps from the start of the session
    std::uint64_t sequence = 0;  ///< counts everything that somebody may want to see
    bool stages = false;         ///< frames carry what stages have made
};

struct LaneLimits {
    double loadSeconds = 30.0, answerSeconds = 10.0;
    std::size_t memoryMiB = 4096;
};

/// What a lane runs. Steps of the session are those of its first scenario; a branch starts at a later one.
struct LanePlan {
    int id = 0;
    std::string title;           ///< for people
    std::string text, original;  ///< the scenario it runs; the one that the session opened
    adapter::EngineSpec asked;   ///< as somebody wrote it
    adapter::EngineSpec spec;    ///< with what the scenario says of its engine
    double dt = 0.0;
    std::size_t startStep = 0;
    std::optional<int> branchOf;
};

/// A scene and its notes, from `LaneProcess` "now"; error: why there is none.
struct NowAnswer {
    std::string text, error;
    std::vector<std::string> notes;
    std::size_t step = 0;  ///< of the session
};

class LaneSlot {
  public:
    LaneSlot(LanePlan plan, std::filesystem::path binary, LaneLimits limits, SessionClock& clock);
    /// Ends the process and the thread; the clock must not be locked.
    ~LaneSlot();

    const LanePlan plan;

    // --- all that follows under the clock's lock
    enum class State { Loading, Ready, NonFinite, Unsupported, BadInput, Error, Crashed, TimedOut };
    State state() const { return state_; }
    bool alive() const { return state_ == State::Ready || state_ == State::NonFinite; }
    const std::string& message() const { return message_; }
    std::size_t step() const { return step_; }  ///< of the session
    bool inStep() const { return inStep_; }
    bool hasStages() const { return description_.value("has_stages", false); }
    const nlohmann::json& description() const { return description_; }
    const Packet& frame() const { return frame_; }
    std::uint64_t sequence() const { return sequence_; }  ///< of the clock when the frame came
    std::uint64_t frames() const { return frames_; }      ///< that came so far
    /// Whether the session's clock waits for it: not while it loads, catches up, or has not answered for
    /// long.
    bool setsThePace() const;

    void wishGoTo(std::size_t step);
    void wishStage();
    void wishDrag(nlohmann::json drag);  ///< null: release
    std::future<NowAnswer> wishNow();

  private:
    struct Work {
        nlohmann::json request;
        std::optional<std::promise<NowAnswer>> now;
    };
    void run();
    bool load();
    bool hasWork() const;
    Work takeWork();
    void store(LaneProcess::Answer answer, bool ofStage = false);
    double secondsFor(const nlohmann::json& request) const;
    void answerNow(std::promise<NowAnswer> promise, const LaneProcess::Answer& answer);
    std::size_t target() const;

    std::filesystem::path binary_;
    LaneLimits limits_;
    SessionClock& clock_;
    State state_ = State::Loading;
    std::string message_;
    std::size_t step_ = 0;
    double stepSeconds_ = 0.0;  ///< written and read by the thread alone
    bool inStep_ = false, catchingUp_ = true, closing_ = false;
    std::optional<std::chrono::steady_clock::time_point> askedAt_;
    nlohmann::json description_ = nlohmann::json::object();
    Packet frame_;
    std::uint64_t sequence_ = 0, frames_ = 0;

    std::optional<std::size_t> goTo_;
    int stages_ = 0;
    std::optional<nlohmann::json> drag_;
    std::vector<std::promise<NowAnswer>> nows_;

    std::unique_ptr<LaneProcess> process_;  ///< made and asked by the thread alone
    std::thread thread_;
};

const char* laneStateName(LaneSlot::State state);

}  // namespace rigor::validation
