// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "validation/live/drag.hpp"

namespace rigor::validation {
namespace {

using adapter::BadInput;
using scenario::Scenario;
using scenario::Vec3;

}  // namespace

InstanceWorld::InstanceWorld(Scenario scenario, adapter::EngineSpec spec, double dt)
    : scenario_(std::move(scenario)),
      spec_(std::move(spec)),
      dt_(dt),
      engine_(adapter::prepareEngine(spec_, scenario_, dt_)),
      coordinates_(scenario_) {
    build();
}

void InstanceWorld::build() {
    stepper_.reset();
    world_ = engine_.build(scenario_, dt_);
    stepper_.emplace(scenario_, dt_, *world_);
    before_.clear();
    coordinates_ = JointCoordinates(scenario_);
    nonFinite_ = stepper_->nonFinite();
    lastStage_.clear();
    watched_ = false;
    keep();
}

bool InstanceWorld::inStep() const {
    return world_->staged() != nullptr && world_->staged()->stepping();
}

void InstanceWorld::beginStep() {
    start_.assign(stepper_->states().begin(), stepper_->states().end());
    const auto force = drag_ ? std::optional(dragForce(scenario_, *drag_, stepper_->states(), dt_))
                             : std::optional<DragPull>();
    stepper_->begin();
    if (force) world_->applyForce(drag_->body, force->force, force->torque);
    const auto last = drags_.upper_bound(stepper_->steps());
    if (last == drags_.begin() ? drag_.has_value() : std::prev(last)->second != drag_)
        drags_[stepper_->steps()] = drag_;
    lastStage_.clear();
    startImpulses_.clear();
}

void InstanceWorld::endStep() {
    stepper_->end();
    before_.swap(start_);
    coordinates_.follow(stepper_->states());
    nonFinite_ = stepper_->nonFinite();
    if (nonFinite_.empty()) keep();
}

void InstanceWorld::advance(std::size_t steps, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    for (std::size_t i = 0; i < steps && nonFinite_.empty(); ++i) {
        if (i > 0 && Clock::now() >= end) return;
        if (inStep()) {
            while (inStep()) world_->staged()->runStage();
        } else {
            watch(false);
            beginStep();
            world_->step();
        }
        endStep();
    }
}

/// Keeping the impulses of every iteration costs more than the rest of what is read: only for display.
void InstanceWorld::watch(bool on) {
    if (watched_ == on || world_->staged() == nullptr) return;
    world_->staged()->watchIterations(on);
    watched_ = on;
}

bool InstanceWorld::stage() {
    adapter::StagedWorld* staged = world_->staged();
    if (staged == nullptr) return false;
    if (!nonFinite_.empty()) return true;
    if (!staged->stepping()) {
        watch(true);
        beginStep();
        staged->beginStep();
    }
    lastStage_ = staged->nextStage();
    const bool untouched = staged->iterations().empty();
    const std::vector<adapter::StagedRow> before =
        untouched ? staged->rows() : std::vector<adapter::StagedRow>();
    staged->runStage();
    if (untouched && !staged->iterations().empty())
        for (const adapter::StagedRow& row : before) startImpulses_.push_back(row.impulse);
    if (!staged->stepping()) endStep();
    return true;
}

/// A snapshot of now, where the engine takes them. Over the budget every second one goes, so that any moment
/// stays within reach.
void InstanceWorld::keep() {
    const std::size_t at = stepper_->steps();
    if (world_->snapshots() == nullptr || at % keepEvery_ != 0 || snapshots_.contains(at)) return;
    StoredSnapshot& now = snapshots_[at];
    world_->snapshots()->save(now.bytes);
    now.bytes.shrink_to_fit();
    now.coordinates = coordinates_.values();
    now.before = before_;
    keptBytes_ += now.size();
    while (keptBytes_ > kMostKeptBytes && snapshots_.size() > 2) {
        keepEvery_ *= 2;
        std::erase_if(snapshots_, [this](const auto& one) {
            if (one.first % keepEvery_ == 0) return false;
            keptBytes_ -= one.second.size();
            return true;
        });
    }
}

std::optional<InstanceWorld::History> InstanceWorld::history() const {
    if (world_->snapshots() == nullptr) return std::nullopt;
    return History{keptBytes_, keepEvery_};
}

/// Restores the last snapshot up to `steps`. False: there is none, or the world does not accept it any more.
bool InstanceWorld::restore(std::size_t steps) {
    if (world_->snapshots() == nullptr) return false;
    const auto after = snapshots_.upper_bound(steps);
    if (after == snapshots_.begin()) return false;
    const auto& [at, kept] = *std::prev(after);
    if (!world_->snapshots()->restore(kept.bytes)) return false;
    stepper_->jumpTo(at);
    coordinates_.restore(kept.coordinates);
    before_ = kept.before;
    return true;
}

void InstanceWorld::goTo(std::size_t steps) {
    const std::optional<Drag> held = drag_;
    if (steps <= stepper_->steps()) {
        while (inStep()) world_->staged()->runStage();
        watch(false);
        // The step that ends there is taken again: contacts and counts are those of the world's last step.
        if (steps == 0) {
            build();
        } else if (!restore(steps - 1)) {
            build();
            restore(steps - 1);  // a joint may have broken since
        }
    }
    nonFinite_.clear();
    lastStage_.clear();
    while (stepper_->steps() < steps && nonFinite_.empty()) {
        const auto next = drags_.upper_bound(stepper_->steps());
        drag_ = next == drags_.begin() ? std::nullopt : std::prev(next)->second;
        beginStep();
        world_->step();
        endStep();
    }
    drags_.erase(drags_.lower_bound(steps), drags_.end());
    for (auto it = snapshots_.upper_bound(steps); it != snapshots_.end(); it = snapshots_.erase(it))
        keptBytes_ -= it->second.size();
    drag_ = held;
}

void InstanceWorld::drag(const std::optional<Drag>& drag) {
    if (drag) {
        const bool known = drag->body >= 0 && static_cast<std::size_t>(drag->body) < scenario_.bodies.size();
        if (!known || scenario_.bodies[drag->body].type != scenario::BodyType::Dynamic)
            throw BadInput("only a dynamic body can be dragged");
        if (!isFinite(drag->point) || !isFinite(drag->target) || !std::isfinite(drag->stiffness))
            throw BadInput("a drag must be finite");
    }
    drag_ = drag;
}

std::optional<InstanceWorld::Pull> InstanceWorld::pull() {
    if (!drag_ || !nonFinite_.empty()) return std::nullopt;
    const adapter::BodyState& s = stepper_->states()[drag_->body];
    return Pull{s.position + rotate(s.orientation, drag_->point),
                dragForce(scenario_, *drag_, stepper_->states(), dt_).force};
}

SceneNow InstanceWorld::now() {
    if (!nonFinite_.empty()) throw BadInput(nonFinite_);
    if (inStep()) throw BadInput("a step is under way: end it first");
    Moment moment{dt_, stepper_->steps(), stepper_->states(), &coordinates_, {}};
    for (std::size_t j = 0; j < scenario_.joints.size(); ++j) moment.holds.push_back(world_->jointHolds(j));
    return sceneNow(scenario_, moment);
}

}  // namespace rigor::validation
