// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/typed_batch.hpp"

namespace rigor::engine::python {
namespace {

template <class S>
const std::vector<std::shared_ptr<const TypedWorld<S>>>& atLeastOne(
    const std::vector<std::shared_ptr<const TypedWorld<S>>>& worlds) {
    if (worlds.empty()) throw EngineError("batch_size", "a batch has one world at least");
    return worlds;
}

/// Numbers as the engine has them.
template <class R>
std::vector<R> numbersOf(const Numbers& numbers) {
    return {numbers.data(), numbers.data() + numbers.size()};
}

std::string textOf(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& known) {
        return known.what();
    } catch (...) {
        return "unknown error";
    }
}

}  // namespace

template <class S>
TypedBatch<S>::TypedBatch(const TypedWorld<S>& world, std::size_t count, int threads)
    : pattern_(std::make_shared<const TypedWorld<S>>(world)),
      batch_(world.engineWorld(), count, BatchSettings{threads}) {
    resizeStates();
}

template <class S>
TypedBatch<S>::TypedBatch(const Worlds& worlds, int threads)
    : pattern_(std::make_shared<const TypedWorld<S>>(*atLeastOne<S>(worlds).front())),
      starts_([&worlds] {
          Worlds copies;
          for (const auto& world : worlds) {
              const Turn turn = world->turn();
              copies.push_back(std::make_shared<const TypedWorld<S>>(*world));
          }
          return copies;
      }()),
      batch_(
          worlds.size(), [this](std::size_t i) { return starts_[i]->engineWorld(); },
          BatchSettings{threads}) {
    resizeStates();
}

template <class S>
void TypedBatch<S>::resizeStates() {
    states_.resize({static_cast<py::ssize_t>(batch_.size()), static_cast<py::ssize_t>(batch_.bodies()),
                    static_cast<py::ssize_t>(kBodyState<S>)});
    fillStates();
}

template <class S>
void TypedBatch<S>::fillStates() {
    batch_.readStates(states_.numbers());
}

template <class S>
bool TypedBatch<S>::step(py::ssize_t steps, std::optional<double> h) {
    const Turn turn(taken_);
    if (steps < 0 || steps > std::numeric_limits<int>::max())
        throw EngineError("steps", "found " + std::to_string(steps) + ", expected 0 or more");
    const R length = static_cast<R>(h.value_or(pattern_->timeStep()));
    const py::gil_scoped_release released;
    const auto schedule = [this, length](std::size_t i, World<S>& world) {
        (starts_.empty() ? *pattern_ : *starts_[i]).beforeStep()(world, length);
    };
    const bool scheduled = static_cast<bool>(pattern_->beforeStep());
    const bool good = scheduled ? batch_.step(length, static_cast<int>(steps), schedule)
                                : batch_.step(length, static_cast<int>(steps));
    fillStates();
    return good;
}

template <class S>
bool TypedBatch<S>::setStates(const Numbers& states) {
    const Turn turn(taken_);
    const bool good = batch_.writeStates(numbersOf<R>(states));
    fillStates();
    return good;
}

template <class S>
bool TypedBatch<S>::applyWrenches(const Numbers& wrenches) {
    const Turn turn(taken_);
    return batch_.applyWrenches(numbersOf<R>(wrenches));
}

template <class S>
JointId TypedBatch<S>::jointId(const Key& joint) const {
    return pattern_->jointIds()[pattern_->joints().find(joint)];
}

template <class S>
std::vector<typename S::Real> TypedBatch<S>::perWorld(const Numbers& numbers, const char* name) const {
    if (numbers.size() == 1) return std::vector<R>(size(), static_cast<R>(*numbers.data()));
    requireSize(numbers, static_cast<py::ssize_t>(size()), name);
    return numbersOf<R>(numbers);
}

template <class S>
bool TypedBatch<S>::setJointMotors(const Key& joint, int axis, const Numbers& speeds, double maxForce) {
    const Turn turn(taken_);
    return batch_.setJointMotors(jointId(joint), axis, perWorld(speeds, "speeds"), static_cast<R>(maxForce));
}

template <class S>
bool TypedBatch<S>::setJointTargets(const Key& joint, int axis, const Numbers& targets) {
    const Turn turn(taken_);
    return batch_.setJointTargets(jointId(joint), axis, perWorld(targets, "targets"));
}

template <class S>
py::array TypedBatch<S>::stateHashes() const {
    const Turn turn(taken_);
    py::array_t<std::uint64_t> hashes(static_cast<py::ssize_t>(size()));
    for (std::size_t i = 0; i < size(); ++i) hashes.mutable_data()[i] = batch_.world(i).stateHash();
    return hashes;
}

template <class S>
py::list TypedBatch<S>::failures() const {
    const Turn turn(taken_);
    py::list result;
    for (const BatchFailure& failure : batch_.failures())
        result.append(py::make_tuple(failure.world, textOf(failure.error)));
    return result;
}

template <class S>
void TypedBatch<S>::reset(const std::optional<std::vector<std::size_t>>& worlds) {
    const Turn turn(taken_);
    std::vector<std::size_t> all(size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    batch_.reset(worlds ? *worlds : all);
    fillStates();
}

template <class S>
std::shared_ptr<AnyWorld> TypedBatch<S>::world(std::size_t index) const {
    const Turn turn(taken_);
    if (index >= size())
        throw py::index_error("world " + std::to_string(index) + ": there are " + std::to_string(size()));
    return (starts_.empty() ? *pattern_ : *starts_[index]).withEngineWorld(batch_.world(index));
}

RIGOR_INSTANTIATE_CLASS(TypedBatch)

}  // namespace rigor::engine::python
