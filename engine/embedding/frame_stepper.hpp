// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fixed steps under a clock of frames. Frames take what time they take; a world takes steps of one size, so that
// its course does not depend on them. Each frame runs the whole steps that fit into its time and what was left before
// (frame_clock.hpp). Drawn at the last step, bodies would jerk by up to a step; pose() is between the last two steps,
// as far as the remainder is into the next one, so that what is seen is one step old and smooth. Where steps take
// longer than the time that they stand for, each frame would have more of them to run than the one before (the "spiral
// of death"): a frame runs `mostSteps` at most, and the time beyond them is skipped and counted. The world then is
// slower than the clock, and goes on.
#pragma once

#include <vector>

#include "engine/embedding/frame_clock.hpp"
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
        const int due = static_cast<int>(clock_.advance(elapsed, mostSteps_));
        for (int i = 0; i < due; ++i) {
            before(world_);
            if (i + 1 == due) rememberPoses(before_);
            world_.step(static_cast<typename S::Real>(clock_.step()));
        }
        if (due > 0) rememberPoses(after_);
        return due;
    }
    int advance(double elapsed) {
        return advance(elapsed, [](World<S>&) {});
    }

    /// Time since the last step [s], and as a fraction of a step, in [0, 1).
    double remainder() const { return clock_.remainder(); }
    double fraction() const { return clock_.fraction(); }
    /// All time that was skipped [s].
    double skipped() const { return clock_.skipped(); }
    /// The body frame between the last two steps: the centre of mass on the straight line, the orientation on the
    /// shortest rotation between them. A body that was not in the world before the last step is where it is; so is one
    /// that was put elsewhere since, by World::setPose or a snapshot.
    Pose<S> pose(BodyId body) const;
    /// Forgets the remainder and the poses before the last step.
    void restart();

  private:
    /// Poses of the body frames; element k is of the body whose handle has index k.
    struct Remembered {
        BodyId body;
        Pose<S> pose;
    };
    using Poses = std::vector<Remembered>;
    void rememberPoses(Poses& poses) const;
    static const Pose<S>* find(const Poses& poses, BodyId body);

    World<S>& world_;
    FrameClock clock_;
    int mostSteps_;
    Poses before_, after_;  ///< before and after the last step
};

}  // namespace rigor::engine
