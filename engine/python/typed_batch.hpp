// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// AnyBatch over one Space.
#pragma once

#include <memory>
#include <vector>

#include "engine/embedding/world_batch.hpp"
#include "engine/python/any_batch.hpp"
#include "engine/python/state_array.hpp"
#include "engine/python/typed_world.hpp"

namespace rigor::engine::python {

template <class S>
class TypedBatch final : public AnyBatch {
  public:
    using R = typename S::Real;
    using Worlds = std::vector<std::shared_ptr<const TypedWorld<S>>>;

    TypedBatch(const TypedWorld<S>& world, std::size_t count, int threads);
    TypedBatch(const Worlds& worlds, int threads);

    std::size_t size() const override { return batch_.size(); }
    bool step(py::ssize_t steps, std::optional<double> h) override;
    py::array states() const override { return states_.view(); }
    bool setStates(const Numbers& states) override;
    bool applyWrenches(const Numbers& wrenches) override;
    bool setJointMotors(const Key& joint, int axis, const Numbers& speeds, double maxForce) override;
    bool setJointTargets(const Key& joint, int axis, const Numbers& targets) override;
    py::array stateHashes() const override;
    py::list failures() const override;
    void reset(const std::optional<std::vector<std::size_t>>& worlds) override;
    std::shared_ptr<AnyWorld> world(std::size_t index) const override;

  private:
    std::vector<R> perWorld(const Numbers& numbers, const char* name) const;
    JointId jointId(const Key& joint) const;
    void resizeStates();
    void fillStates();

    std::shared_ptr<const TypedWorld<S>> pattern_;  ///< names, time step and schedule of the worlds
    Worlds starts_;  ///< the worlds as they began, if they were given one by one
    WorldBatch<S> batch_;
    StateArray<R> states_;
    mutable std::atomic_flag taken_ = ATOMIC_FLAG_INIT;
};

}  // namespace rigor::engine::python
