// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_slot.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
using Kind = InstanceProcess::Answer::Kind;

constexpr double kBatchSeconds = 0.03;  ///< wall time of a batch of steps: 30 frames a second at the least
constexpr auto kTimeLimit = std::chrono::milliseconds(500);  ///< time after which the others go on without an
                                                             ///< instance
constexpr int kMostStages = 1000;

InstanceSlot::State stateOf(const InstanceProcess::Answer& answer) {
    using State = InstanceSlot::State;
    switch (answer.kind) {
        case Kind::Crashed:
            return State::Crashed;
        case Kind::TimedOut:
            return State::TimedOut;
        case Kind::Refused:
            if (answer.error == "unsupported") return State::Unsupported;
            return answer.error == "bad_input" ? State::BadInput : State::Error;
        case Kind::Done:
            break;
    }
    return answer.packet.header.value("state", "") == "non_finite" ? State::NonFinite : State::Ready;
}

}  // namespace

const char* instanceStateName(InstanceSlot::State state) {
    switch (state) {
        case InstanceSlot::State::Loading:
            return "loading";
        case InstanceSlot::State::Ready:
            return "ready";
        case InstanceSlot::State::NonFinite:
            return "non_finite";
        case InstanceSlot::State::Unsupported:
            return "unsupported";
        case InstanceSlot::State::BadInput:
            return "bad_input";
        case InstanceSlot::State::Error:
            return "error";
        case InstanceSlot::State::Crashed:
            return "crashed";
        case InstanceSlot::State::TimedOut:
            return "timeout";
    }
    return "?";
}

InstanceSlot::InstanceSlot(InstancePlan p, std::filesystem::path binary, InstanceLimits limits,
                           SessionClock& clock)
    : plan(std::move(p)),
      binary_(std::move(binary)),
      limits_(limits),
      clock_(clock),
      step_(plan.startStep),
      thread_([this] { run(); }) {}

InstanceSlot::~InstanceSlot() {
    {
        const std::lock_guard lock(clock_.mutex);
        closing_ = true;
        if (process_) process_->kill();  // it may be at work for long
        for (auto& promise : nows_) promise.set_value({"", "the instance is closed", {}, 0});
        nows_.clear();
    }
    clock_.changed.notify_all();
    thread_.join();
}

bool InstanceSlot::setsThePace() const {
    if (state_ != State::Ready || catchingUp_) return false;
    return !requestedAt_ || Clock::now() - *requestedAt_ < kTimeLimit;
}

void InstanceSlot::requestStep(std::size_t step) {
    goTo_ = step;
    stages_ = 0;
}
void InstanceSlot::requestReset() {
    if (!alive() && state_ != State::Loading) return beginAnew();
    requestStep(plan.startStep);
    resetting_ = true;
}
void InstanceSlot::requestRestart() {
    beginAnew();
}
void InstanceSlot::requestStage() {
    stages_ = std::min(stages_ + 1, kMostStages);
}
void InstanceSlot::requestDrag(json drag) {
    drag_ = std::move(drag);
}
std::future<StateReply> InstanceSlot::requestState() {
    std::promise<StateReply> promise;
    auto future = promise.get_future();
    if (alive() && !closing_)
        nows_.push_back(std::move(promise));
    else
        promise.set_value({"", std::string("the instance is ") + instanceStateName(state_), {}, 0});
    return future;
}

/// The state of an instance whose process has yet to be started.
void InstanceSlot::beginAnew() {
    state_ = State::Loading;
    message_.clear();
    step_ = plan.startStep;
    inStep_ = resetting_ = false;
    catchingUp_ = toLoad_ = true;
    goTo_.reset();
    stages_ = 0;
    drag_.reset();
    sequence_ = ++clock_.sequence;
}

bool InstanceSlot::hasWork() const {
    if (!alive()) return false;
    if (goTo_ || drag_ || !nows_.empty()) return true;
    return state_ == State::Ready && (stages_ > 0 || step_ < clock_.target);
}

InstanceSlot::Work InstanceSlot::takeWork() {
    Work work;
    json& request = work.request;
    if (drag_) {
        request = drag_->is_null() ? json{{"command", "release"}} : *drag_;
        if (!drag_->is_null()) request["command"] = "drag";
        drag_.reset();
    } else if (goTo_) {
        const std::size_t to = std::max(*goTo_, plan.startStep) - plan.startStep;
        request = {{"command", "go_to"}, {"step", to}};
        goTo_.reset();
    } else if (!nows_.empty()) {
        request = {{"command", "now"}};
        work.now = std::move(nows_.front());
        nows_.erase(nows_.begin());
    } else if (stages_ > 0) {
        --stages_;
        request = {{"command", "stage"}, {"stages", true}};
    } else {
        request = {{"command", "advance"}, {"steps", clock_.target - step_}, {"seconds", kBatchSeconds}};
    }
    if (clock_.stages) request["stages"] = true;
    return work;
}

void InstanceSlot::answerNow(std::promise<StateReply> promise, const InstanceProcess::Answer& answer) {
    StateReply now;
    now.step = step_;
    if (answer.kind == Kind::Done) {
        now.text = answer.packet.header.at("text");
        now.notes = answer.packet.header.at("notes").get<std::vector<std::string>>();
    } else {
        now.error = answer.message;
    }
    promise.set_value(std::move(now));
}

void InstanceSlot::store(InstanceProcess::Answer answer, bool ofStage) {
    // A running instance refuses a request and goes on.
    if (answer.kind == Kind::Refused && alive()) {
        message_ = answer.message;
        sequence_ = ++clock_.sequence;
        return;
    }
    state_ = stateOf(answer);
    message_ = answer.message;
    if (answer.kind == Kind::Done) {
        json& header = answer.packet.header;
        message_ = header.value("message", "");
        step_ = plan.startStep + header.at("step").get<std::size_t>();
        inStep_ = header.at("stage").at("in_step");
        if (header.contains("instance")) {
            description_ = header["instance"];
            header.erase("instance");
        }
        stepSeconds_ = header.value("step_seconds", stepSeconds_);
        frame_ = std::move(answer.packet);
        ++frames_;
        if (step_ >= clock_.target) catchingUp_ = false;
        // A step that was ended by its stages takes the other instances along.
        if (ofStage && !goTo_) clock_.target = std::max(clock_.target, step_);
    } else {
        inStep_ = false;
        for (auto& promise : nows_) promise.set_value({"", message_, {}, 0});
        nows_.clear();
        // It was dying when the reset was requested.
        if (resetting_) return beginAnew();
    }
    sequence_ = ++clock_.sequence;
}

/// Starts a process and loads the scenario into it. `lock` is the clock's; it is released meanwhile.
void InstanceSlot::load(std::unique_lock<std::mutex>& lock) {
    toLoad_ = resetting_ = false;
    auto ended = std::move(process_);
    lock.unlock();
    ended.reset();  // it may have to be waited for
    std::unique_ptr<InstanceProcess> process;
    std::string problem;
    try {
        process = std::make_unique<InstanceProcess>(binary_, limits_.memoryMiB);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    lock.lock();
    if (!process) return store({Kind::Refused, {}, "error", problem});
    process_ = std::move(process);
    if (closing_) return;
    lock.unlock();
    auto answer = process_->send(
        {{"command", "load"}, {"text", plan.text}, {"spec", plan.spec.text()}, {"dt", plan.dt}},
        limits_.loadSeconds);
    lock.lock();
    store(std::move(answer));
}

/// An engine without snapshots goes back by running again from the start.
double InstanceSlot::secondsFor(const json& request) const {
    if (request.at("command") != "go_to") return limits_.answerSeconds;
    return limits_.loadSeconds + 3.0 * stepSeconds_ * request.at("step").get<double>();
}

void InstanceSlot::run() {
    std::unique_lock lock(clock_.mutex);
    while (!closing_) {
        if (toLoad_) {
            load(lock);
            clock_.changed.notify_all();
            continue;
        }
        if (!hasWork()) {
            clock_.changed.wait(lock);
            continue;
        }
        Work work = takeWork();
        requestedAt_ = Clock::now();
        lock.unlock();
        auto answer = process_->send(work.request, secondsFor(work.request));
        lock.lock();
        requestedAt_.reset();
        const std::string command = work.request.at("command");
        if (work.now) answerNow(std::move(*work.now), answer);
        if (!work.now || answer.kind == Kind::Crashed || answer.kind == Kind::TimedOut)
            store(std::move(answer), command == "stage");
        if (command == "go_to" && !goTo_) resetting_ = false;
        clock_.changed.notify_all();
    }
}

}  // namespace rigor::validation
