// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fixed steps under a clock of frames. Frames take what time they take; a world takes steps of one size, so that
// its course does not depend on them:
//
//     frame times     |----|-------|--|------|---
//     steps           |---|---|---|---|---|---|     remainder: from the last step to now
//
// Each frame adds its time to what was left, and runs the steps that fit. Drawn at the last step, bodies would
// jerk by up to a step; pose() is between the last two steps, as far as the remainder is into the next one, so
// that what is seen is one step old and smooth. Where steps take longer than the time that they stand for, each
// frame would have more of them to run than the one before (the "spiral of death"): a frame runs `mostSteps` at
// most, and the time beyond them is skipped and counted. The world then is slower than the clock, and goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/pipeline/world.hpp"

namespace rigor::engine {

struct FrameSettings {
    double step = 1.0 / 60;  ///< size of a step [s], > 0
    int mostSteps = 8;       ///< largest number of steps of a frame, >= 1
};

/// Steps a world, which has to outlive it. Between frames the program may do to the world what it likes.
template <class S>
class FrameStepper {
  public:
    /// Throws EngineError "frame_settings" for values out of range.
    explicit FrameStepper(World<S>& world, const FrameSettings& settings = {});

    /// A frame of `elapsed` [s], >= 0: calls before(world) and world.step() for each step that is due. Returns
    /// their number. Throws EngineError "frame_time" for times that are negative or not finite.
    template <class Before>
    int advance(double elapsed, const Before& before) {
        const int due = takeTime(elapsed);
        for (int i = 0; i < due; ++i) {
            before(world_);
            if (i + 1 == due) rememberPoses();
            world_.step(static_cast<typename S::Real>(settings_.step));
        }
        return due;
    }
    int advance(double elapsed) {
        return advance(elapsed, [](World<S>&) {});
    }

    /// Time since the last step [s], and as a fraction of a step, in [0, 1).
    double remainder() const { return remainder_; }
    double fraction() const { return remainder_ / settings_.step; }
    /// All time that was skipped [s].
    double skipped() const { return skipped_; }
    /// The body frame between the last two steps: the centre of mass on the straight line, the orientation on the
    /// shortest rotation between them. A body that was not in the world before the last step is where it is.
    Pose<S> pose(BodyId body) const;
    /// Forgets the remainder and the poses before the last step: after a snapshot was restored, or bodies were
    /// put elsewhere and shall not be drawn on the way.
    void restart();

  private:
    struct Remembered {
        BodyId body;
        Pose<S> pose;  ///< pose of the body frame
    };
    int takeTime(double elapsed);
    void rememberPoses();

    World<S>& world_;
    FrameSettings settings_;
    double remainder_ = 0, skipped_ = 0;
    std::vector<Remembered> before_;  ///< element k: the body whose handle has index k
};

}  // namespace rigor::engine
