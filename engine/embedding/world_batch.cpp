// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/world_batch.hpp"

#include <algorithm>
#include <utility>

#include "engine/pipeline/require.hpp"

namespace rigor::engine {
namespace {

template <class S>
void requireBodies(const World<S>& world, std::size_t bodies) {
    if (world.bodyCount() == bodies) return;
    throw EngineError("batch_bodies", "a world has " + std::to_string(world.bodyCount()) +
                                          " bodies, the batch " + std::to_string(bodies) +
                                          ": all its worlds have as many");
}

int checkedThreads(int threads) {
    require(threads >= 1 && threads <= 1024, "threads", "a batch has 1 to 1024 threads");
    return threads;
}

}  // namespace

template <class S>
WorldBatch<S>::WorldBatch(const World<S>& world, std::size_t count, const BatchSettings& settings)
    : tasks_(checkedThreads(settings.threads)), start_(std::make_shared<const World<S>>(world)) {
    require(count > 0, "batch_size", "a batch has one world at least");
    worlds_.assign(count, world);
    begin();
}

template <class S>
WorldBatch<S>::WorldBatch(std::size_t count, Builder build, const BatchSettings& settings)
    : tasks_(checkedThreads(settings.threads)), build_(std::move(build)) {
    require(count > 0, "batch_size", "a batch has one world at least");
    worlds_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) worlds_.push_back(build_(i));
    begin();
}

template <class S>
void WorldBatch<S>::begin() {
    bodies_ = worlds_.front().bodyCount();
    for (const World<S>& world : worlds_) requireBodies(world, bodies_);
    errors_.resize(worlds_.size());
    failures_.reserve(worlds_.size());
}

/// Calls work(i, world) for every world that has not failed, on the threads.
template <class S>
template <class Work>
bool WorldBatch<S>::forEachAlive(const Work& work) {
    tasks_.forEach(worlds_.size(), 1, [this, &work](std::size_t i) {
        if (errors_[i]) return;
        try {
            work(i, worlds_[i]);
        } catch (...) {
            errors_[i] = std::current_exception();
        }
    });
    failures_.clear();
    for (std::size_t i = 0; i < errors_.size(); ++i)
        if (errors_[i]) failures_.push_back({i, errors_[i]});
    return failures_.empty();
}

template <class S>
bool WorldBatch<S>::step(Real h, int steps) {
    return forEachAlive([h, steps](std::size_t, World<S>& world) {
        for (int k = 0; k < steps; ++k) world.step(h);
    });
}

template <class S>
bool WorldBatch<S>::step(Real h, int steps, const WorldWork& before) {
    return forEachAlive([h, steps, &before](std::size_t i, World<S>& world) {
        for (int k = 0; k < steps; ++k) {
            before(i, world);
            world.step(h);
        }
    });
}

template <class S>
bool WorldBatch<S>::forEach(const WorldWork& work) {
    return forEachAlive(work);
}

template <class S>
void WorldBatch<S>::reset(std::span<const std::size_t> worlds) {
    for (const std::size_t i : worlds) {
        if (i >= size())
            throw EngineError("batch_world", "there is no world " + std::to_string(i) + ": the batch has " +
                                                 std::to_string(size()));
        World<S> fresh = start_ ? *start_ : build_(i);
        requireBodies(fresh, bodies_);
        worlds_[i] = std::move(fresh);
        errors_[i] = nullptr;
    }
    std::erase_if(failures_, [this](const BatchFailure& failure) { return !errors_[failure.world]; });
}

template <class S>
void WorldBatch<S>::requireSize(std::size_t numbers, std::size_t perWorld) const {
    if (numbers == size() * perWorld) return;
    throw EngineError("batch_array", "the array has " + std::to_string(numbers) + " numbers; " +
                                         std::to_string(size()) + " worlds have " + std::to_string(perWorld) +
                                         " each");
}

template <class S>
void WorldBatch<S>::readStates(std::span<Real> states) const {
    requireSize(states.size(), bodies_ * kBodyState<S>);
    tasks_.forEach(size(), kWorldGrain, [&](std::size_t i) {
        const World<S>& world = worlds_[i];
        requireBodies(world, bodies_);
        auto out = states.begin() + static_cast<std::ptrdiff_t>(i * bodies_ * kBodyState<S>);
        for (const BodyId body : world.bodies()) {
            const BodyNumbers<S> numbers = readBody(world, body);
            out = std::copy(numbers.begin(), numbers.end(), out);
        }
    });
}

template <class S>
bool WorldBatch<S>::writeStates(std::span<const Real> states) {
    requireSize(states.size(), bodies_ * kBodyState<S>);
    return forEachAlive([&](std::size_t i, World<S>& world) {
        requireBodies(world, bodies_);
        const Real* numbers = states.data() + i * bodies_ * kBodyState<S>;
        for (const BodyId body : world.bodies()) {
            writeBody(world, body, numbers);
            numbers += kBodyState<S>;
        }
    });
}

template <class S>
bool WorldBatch<S>::applyWrenches(std::span<const Real> wrenches) {
    requireSize(wrenches.size(), bodies_ * kBodyWrench<S>);
    return forEachAlive([&](std::size_t i, World<S>& world) {
        requireBodies(world, bodies_);
        const Real* numbers = wrenches.data() + i * bodies_ * kBodyWrench<S>;
        for (const BodyId body : world.bodies()) {
            world.applyForce(body, vecAt<S>(numbers), angAt<S>(numbers + S::dim));
            numbers += kBodyWrench<S>;
        }
    });
}

template <class S>
bool WorldBatch<S>::setJointTargets(JointId joint, int axis, std::span<const Real> targets) {
    requireSize(targets.size(), 1);
    return forEachAlive(
        [&](std::size_t i, World<S>& world) { world.setJointTarget(joint, axis, targets[i]); });
}

template <class S>
bool WorldBatch<S>::setJointMotors(JointId joint, int axis, std::span<const Real> speeds, Real maxForce) {
    requireSize(speeds.size(), 1);
    return forEachAlive(
        [&](std::size_t i, World<S>& world) { world.setJointMotor(joint, axis, speeds[i], maxForce); });
}

template <class S>
void WorldBatch<S>::saveSnapshots(std::vector<std::vector<unsigned char>>& snapshots) const {
    snapshots.resize(size());
    tasks_.forEach(size(), 1, [&](std::size_t i) { worlds_[i].saveSnapshot(snapshots[i]); });
}

template <class S>
bool WorldBatch<S>::restoreSnapshots(std::span<const std::vector<unsigned char>> snapshots) {
    requireSize(snapshots.size(), 1);
    return forEachAlive([&](std::size_t i, World<S>& world) { world.restoreSnapshot(snapshots[i]); });
}

RIGOR_INSTANTIATE_CLASS(WorldBatch)

}  // namespace rigor::engine
