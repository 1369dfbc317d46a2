// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// TypedWorld: steps, states, snapshots. Part of typed_world.cpp.
#pragma once

#include <chrono>

#include "engine/embedding/body_numbers.hpp"
#include "engine/python/typed_batch.hpp"
#include "engine/python/typed_world.hpp"

namespace rigor::engine::python {

/// Runs work(k) for k = 0 .. steps - 1 without Python's lock while it returns true, and heeds Ctrl-C about fifty times
/// a second. Returns how often it was called.
template <class Work>
py::ssize_t runInterruptibly(py::ssize_t steps, const Work& work) {
    using Clock = std::chrono::steady_clock;
    constexpr auto kPeriod = std::chrono::milliseconds(20);
    const py::gil_scoped_release released;
    auto next = Clock::now() + kPeriod;
    for (py::ssize_t k = 0; k < steps; ++k) {
        if (!work(k)) return k + 1;
        if (Clock::now() < next) continue;
        const py::gil_scoped_acquire held;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        next = Clock::now() + kPeriod;
    }
    return steps;
}

inline void requireSteps(py::ssize_t steps) {
    if (steps < 0) throw EngineError("steps", "found " + std::to_string(steps) + ", expected 0 or more");
}

template <class S>
void TypedWorld<S>::resizeStates() {
    states_.resize({static_cast<py::ssize_t>(bodyIds_.size()), static_cast<py::ssize_t>(kBodyState<S>)});
    changed();
}

template <class S>
void TypedWorld<S>::changed() {
    queriesStale_ = true;
    fillStates();
}

template <class S>
void TypedWorld<S>::fillStates() {
    auto out = states_.numbers().begin();
    for (const BodyId body : bodyIds_) {
        const BodyNumbers<S> numbers = readBody(world_, body);
        out = std::copy(numbers.begin(), numbers.end(), out);
    }
}

template <class S>
py::ssize_t TypedWorld<S>::stepMany(py::ssize_t steps, R h) {
    return runInterruptibly(steps, [this, h](py::ssize_t) {
        if (beforeStep_) beforeStep_(world_, h);
        return !world_.step(h).nonFinite;
    });
}

template <class S>
void TypedWorld<S>::step(py::ssize_t steps, std::optional<double> h) {
    const Turn turn(taken_);
    requireSteps(steps);
    py::ssize_t made = 0;
    try {
        made = stepMany(steps, static_cast<R>(h.value_or(timeStep_)));
    } catch (...) {
        changed();
        throw;
    }
    changed();
    if (steps > 0 && world_.lastStep().nonFinite) {
        PyErr_Format(PyExc_FloatingPointError,
                     "a velocity or pose is no longer a finite number after step %zd of %zd", made, steps);
        throw py::error_already_set();
    }
}

template <class S>
void TypedWorld<S>::applyForce(const Key& body, const Numbers& force, const MaybeNumbers& torque) {
    const Turn turn(taken_);
    world_.applyForce(id(body), toVec<S>(force, "force"), toAng<S>(torque, "torque"));
}

template <class S>
void TypedWorld<S>::applyImpulse(const Key& body, const Numbers& impulse, const MaybeNumbers& angular) {
    const Turn turn(taken_);
    world_.applyImpulse(id(body), toVec<S>(impulse, "impulse"), toAng<S>(angular, "angular_impulse"));
    changed();
}

/// Bodies without a force are left alone: a force wakes what sleeps.
template <class S>
void TypedWorld<S>::applyWrenches(const Numbers& wrenches) {
    const Turn turn(taken_);
    constexpr auto kWidth = static_cast<py::ssize_t>(kBodyWrench<S>);
    requireSize(wrenches, static_cast<py::ssize_t>(bodyIds_.size()) * kWidth, "wrenches");
    const double* numbers = wrenches.data();
    for (const BodyId body : bodyIds_) {
        const bool any = std::any_of(numbers, numbers + kWidth, [](double x) { return x != 0; });
        if (any && world_.constants(body).type == BodyType::Dynamic)
            world_.applyForce(body, toVec<S>(numbers), toAng<S>(numbers + S::dim));
        numbers += kWidth;
    }
}

template <class S>
void TypedWorld<S>::setStates(const Numbers& states) {
    const Turn turn(taken_);
    constexpr std::size_t kWidth = kBodyState<S>;
    requireSize(states, static_cast<py::ssize_t>(bodyIds_.size() * kWidth), "states");
    std::vector<R> numbers(states.data(), states.data() + states.size());
    for (std::size_t i = 0; i < bodyIds_.size(); ++i)
        writeBody<S>(world_, bodyIds_[i], numbers.data() + i * kWidth);
    changed();
}

template <class S>
void TypedWorld<S>::setPose(const Key& body, const Numbers& position, const MaybeNumbers& orientation) {
    const Turn turn(taken_);
    Pose<S> pose = world_.pose(id(body));
    pose.p = toVec<S>(position, "position");
    if (orientation) pose.q = toRot<S>(orientation);
    world_.setPose(id(body), pose);
    changed();
}

template <class S>
void TypedWorld<S>::setVelocity(const Key& body, const Numbers& velocity, const MaybeNumbers& angular) {
    const Turn turn(taken_);
    const auto w = angular ? toAng<S>(angular, "angular_velocity") : world_.angularVelocity(id(body));
    world_.setVelocity(id(body), toVec<S>(velocity, "velocity"), w);
    changed();
}

template <class S>
void TypedWorld<S>::setGravity(const Numbers& gravity) {
    const Turn turn(taken_);
    world_.setGravity(toVec<S>(gravity, "gravity"));
}

template <class S>
py::bytes TypedWorld<S>::snapshot() const {
    const Turn turn(taken_);
    std::vector<unsigned char> bytes;
    world_.saveSnapshot(bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class S>
void TypedWorld<S>::restore(const py::bytes& snapshot) {
    const Turn turn(taken_);
    const std::string_view bytes(snapshot);
    world_.restoreSnapshot({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
    changed();
}

template <class S>
std::uint64_t TypedWorld<S>::stateHash() const {
    const Turn turn(taken_);
    return world_.stateHash();
}

template <class S>
std::shared_ptr<AnyWorld> TypedWorld<S>::copy() const {
    const Turn turn(taken_);
    return std::make_shared<TypedWorld<S>>(*this);
}

template <class S>
std::shared_ptr<AnyWorld> TypedWorld<S>::withEngineWorld(const World<S>& world) const {
    auto other = std::make_shared<TypedWorld<S>>(*this);
    other->world_ = world;
    other->changed();
    return other;
}

template <class S>
std::shared_ptr<AnyBatch> TypedWorld<S>::batch(std::size_t count, int threads) const {
    const Turn turn(taken_);
    return std::make_shared<TypedBatch<S>>(*this, count, threads);
}

template <class S>
std::shared_ptr<AnyBatch> TypedWorld<S>::batchOf(const std::vector<std::shared_ptr<AnyWorld>>& worlds,
                                                 int threads) const {
    std::vector<std::shared_ptr<const TypedWorld<S>>> typed;
    for (const std::shared_ptr<AnyWorld>& world : worlds) {
        typed.push_back(std::dynamic_pointer_cast<const TypedWorld<S>>(world));
        if (!typed.back())
            throw EngineError("batch_worlds", "the worlds of a batch have one dimension and one precision");
    }
    return std::make_shared<TypedBatch<S>>(typed, threads);
}

}  // namespace rigor::engine::python
