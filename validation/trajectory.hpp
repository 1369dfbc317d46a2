// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Record of a run: the input of references, metrics, audit and store alike.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::validation {

using adapter::BodyState;
using adapter::ContactPoint;

/// Recorded frames of one case. Frame 0 is the initial state as the engine reports it; frame k is the state
/// after step k * stride. `times` are exact multiples of dt from 0.
struct Trajectory {
    double dt = 0.0;
    int stride = 1;  ///< steps between frames
    std::size_t bodyCount = 0;
    std::vector<double> times;      ///< [s], one per frame
    std::vector<BodyState> states;  ///< frame-major: states[frame * bodyCount + body]
    /// Contacts of the step that begins (StepStart) or ends (StepEnd) at each frame, at the frame's poses; the last
    /// frame begins no step, the first one ends none.
    std::vector<std::vector<ContactPoint>> contacts;
    adapter::ContactInstant contactInstant = adapter::ContactInstant::StepStart;

    std::size_t frames() const { return times.size(); }
    const BodyState& state(std::size_t frame, int body) const { return states[frame * bodyCount + body]; }
    std::span<const BodyState> frame(std::size_t f) const {
        return {states.data() + f * bodyCount, bodyCount};
    }
};

}  // namespace rigor::validation
