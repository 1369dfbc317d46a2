// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario as it is seen now: the scene of a moment of a run as a scenario of its own, to go on from
// elsewhere (another engine, other choices) or to keep as a file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "adapters/interface/types.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

/// Coordinates of the joints of a run, angles counted over turns from step to step.
class JointCoordinates {
  public:
    /// All at their values at the scenario's own poses.
    explicit JointCoordinates(const scenario::Scenario& scenario);
    /// Updates the coordinates after a step; `states` are of all bodies.
    void follow(std::span<const adapter::BodyState> states);
    /// Coordinate k of a joint; NaN where it is not known (see jointCoordinate).
    double value(std::size_t joint, std::size_t k) const {
        return values_[joint * scenario::kMaxJointAxes + k];
    }
    const std::vector<double>& values() const { return values_; }
    void restore(std::vector<double> values) { values_ = std::move(values); }

  private:
    const scenario::Scenario* scenario_;
    std::vector<double> values_;  ///< joints * kMaxJointAxes
};

/// A moment of a run.
struct Moment {
    double dt = 0.0;                             ///< [s]
    std::size_t steps = 0;                       ///< taken so far
    std::span<const adapter::BodyState> states;  ///< states of all bodies, finite
    const JointCoordinates* coordinates = nullptr;
    std::vector<bool> holds;  ///< flag of each joint: false once broken; empty: all hold
};

struct SceneNow {
    scenario::Scenario scenario;
    std::vector<std::string> notes;  ///< properties that could not be kept, one sentence each
};

/// Bodies that move have the poses and velocities of the moment. Joints keep their meaning: anchors are where
/// they are, limits and targets of springs are counted from the new poses. Forces and events are those still
/// to come. The reference, bounds and deviations no longer hold and are dropped; the engines' memory
/// (impulses of the warm start, sleeping bodies) is no part of a scenario.
SceneNow sceneNow(const scenario::Scenario& scenario, const Moment& moment);

}  // namespace rigor::validation
