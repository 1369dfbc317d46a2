// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Optional interface of a world: its state can be set. A world that offers it is one of these as well
// (dynamic_cast).
#pragma once

#include <span>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

class StateSetting {
  public:
    virtual ~StateSetting() = default;

    /// Gives every dynamic body pose and velocities, by scenario index; the entries of other bodies are not
    /// read. Between steps only. Time and the motion of kinematic bodies go on, bodies that slept are awake,
    /// and the next step finds its contacts where the bodies are now.
    virtual void setStates(std::span<const BodyState> states) = 0;

    /// Warm start of the next step after a state is set: "discarded" if nothing is kept of the impulses of
    /// contacts and joints of the step before, "contacts discarded" if joints keep theirs, "kept".
    virtual const char* warmStart() const = 0;
};

}  // namespace rigor::adapter
