// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// rigor.WorldBatch: many worlds on threads, for both dimensions and precisions.
#pragma once

#include <memory>
#include <vector>

#include "engine/python/any_world.hpp"

namespace rigor::engine::python {

class AnyBatch {
  public:
    virtual ~AnyBatch() = default;
    virtual std::size_t size() const = 0;
    virtual bool step(py::ssize_t steps, std::optional<double> h) = 0;
    virtual py::array states() const = 0;
    virtual bool setStates(const Numbers& states) = 0;
    virtual bool applyWrenches(const Numbers& wrenches) = 0;
    virtual bool setJointMotors(const Key& joint, int axis, const Numbers& speeds, double maxForce) = 0;
    virtual bool setJointTargets(const Key& joint, int axis, const Numbers& targets) = 0;
    virtual py::array stateHashes() const = 0;
    virtual py::list failures() const = 0;
    virtual void reset(const std::optional<std::vector<std::size_t>>& worlds) = 0;
    virtual std::shared_ptr<AnyWorld> world(std::size_t index) const = 0;
};

void bindBatch(py::module_& module);

}  // namespace rigor::engine::python
