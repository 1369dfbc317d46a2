// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A world on its way through a scenario, one fixed step after the other: every caller that runs a scenario,
// to its end or live, does it with this.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::validation {

/// A step is begin(), the world's step in whatever way, end(). Neither the scenario nor the world is owned.
class Stepper {
  public:
    Stepper(const scenario::Scenario& scenario, double dt, adapter::World& world);

    /// Applies the scenario's forces and events of the step that comes.
    void begin();
    /// The step has been taken.
    void end();
    /// The world has been put where it was after `steps` steps.
    void jumpTo(std::size_t steps);

    std::size_t steps() const { return steps_; }                       ///< taken
    double time() const { return static_cast<double>(steps_) * dt_; }  ///< [s]
    /// Current states; read from the world on demand.
    std::span<const adapter::BodyState> states();
    /// Sentence on the first state that is not finite; "" if all are finite.
    std::string nonFinite();
    /// Hash of the bits of states(): equal for two runs that end in the same states.
    std::string stateHash();

  private:
    const scenario::Scenario& scenario_;
    double dt_;
    adapter::World& world_;
    bool needsStates_;
    bool statesRead_ = false;  ///< states_ are those of now
    std::size_t steps_ = 0;
    std::vector<adapter::BodyState> states_;
};

}  // namespace rigor::validation
