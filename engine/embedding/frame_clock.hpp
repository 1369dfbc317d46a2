// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The accumulator of fixed steps: each piece of time that passes is added to what was left, the whole steps in it
// are due, and the rest is kept.
//
//     time that passes    |----|-------|--|------|---
//     steps               |---|---|---|---|---|---|     remainder: from the last step to now
//
// It knows no world: FrameStepper steps a world of the program by it, and the live view of the testbed all of its
// engines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/error.hpp"

namespace rigor::engine {

class FrameClock {
  public:
    /// A step is `step` [s] long. Throws EngineError "frame_settings" unless it is positive and finite.
    explicit FrameClock(double step) : step_(step) {
        if (!(step > 0 && std::isfinite(step)))
            throw EngineError("frame_settings", "a step must be positive and finite");
    }

    /// Adds `elapsed` [s] >= 0 and returns the number of steps that are due, at most `most` >= 0; the steps beyond are
    /// skipped. Throws EngineError "frame_time" for times that are negative or not finite.
    std::int64_t advance(double elapsed, std::int64_t most) {
        if (!(elapsed >= 0 && std::isfinite(elapsed)))
            throw EngineError("frame_time", "frame time must be >= 0 and finite");
        remainder_ += elapsed;
        // Sums of frame times that mean whole steps fall short of them by rounding.
        const double due = std::floor(remainder_ / step_ + 1e-9);
        const double run = std::min(due, static_cast<double>(most));
        remainder_ = std::max(0.0, remainder_ - due * step_);
        skipped_ += (due - run) * step_;
        return static_cast<std::int64_t>(run);
    }

    double step() const { return step_; }
    /// Time since the last step [s], and as a fraction of a step, in [0, 1).
    double remainder() const { return remainder_; }
    double fraction() const { return remainder_ / step_; }
    /// All time that was skipped [s].
    double skipped() const { return skipped_; }
    /// Forgets the remainder.
    void restart() { remainder_ = 0; }

  private:
    double step_, remainder_ = 0, skipped_ = 0;
};

}  // namespace rigor::engine
