// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion of the bodies over one step, or over each sub-step of one:
//     kick      velocities get what forces, damping and the gyroscopic term add
//     move      poses follow the velocities, which constraints have changed in between
//     finish    angular velocity at the end, from the angular momentum in the new orientation
// Which velocities move the bodies is the integrator's choice, what the body's own rotation does is that of
// the rotation scheme.
#pragma once

#include <span>
#include <vector>

#include "engine/integrators/block_motion.hpp"
#include "engine/integrators/free_flow.hpp"

namespace rigor::engine {

template <class S>
class Motion {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    Motion() = default;
    Motion(const Integrator<S>& integrator, const RotationScheme<S>& rotation, TurnRotation<S> turn)
        : integrator_(integrator), rotation_(rotation), turn_(turn) {}

    /// Constraints of a step already act on the motion of that step.
    bool movesWithSolvedVelocity() const { return integrator_.movesWithSolvedVelocity; }

    /// From now on bodies move in blocks (block_motion.hpp). For those choices alone that it can do, and not
    /// with interrupt().
    void moveInBlocks(bool gyroscopic) {
        blocks_ = BlockMotion<S>(gyroscopic);
        inBlocks_ = true;
    }
    /// Before the first kick() of a step, which may be of several.
    void beginStep() { begun_ = false; }

    /// After a kick(): the world inertia of the beginning of the step is all that the other sub-steps need.
    bool inertiaHolds() const { return kickedInBlocks_ && blocks_.gyroscopic(); }

    /// World inertia of every body at its present pose. Before rows are made and before kick().
    static void setInertia(BodyArrays<S>& bodies, const Tasks& tasks = Tasks::one());

    /// Velocities after h [s] of forces alone. Wrenches are read, not cleared: they last all sub-steps.
    void kick(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks = Tasks::one());
    /// Moves every body over h.
    void move(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());
    /// The velocities of the last move().
    std::span<const Velocity<S>> used() const { return used_; }
    /// Orientations before the last move(), by dense index.
    std::span<const typename S::Rot> startRotations() const { return startRotations_; }
    /// After poses have changed for the last time, by move() of h and position correction.
    void finish(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());

    // --- a body that collides on its way
    /// Between move() and finish(): the body's angular velocity where it is now, part of the way.
    void interrupt(BodyArrays<S>& bodies, std::size_t i);
    /// After its velocity has changed: `rest` [s] of the way are still to go, which the caller does with the
    /// velocity it finds then; finish() is for that rest.
    void resume(BodyArrays<S>& bodies, std::size_t i, Real rest);
    /// used() as it would be for the way that the body has taken in the end.
    void replaceUsed(std::size_t i, const Velocity<S>& velocity) { used_[i] = velocity; }

  private:
    bool goesInBlocks(const Load<S>& load) const {
        return inBlocks_ && (load.forces == nullptr || load.forces->size() == 0);
    }
    void kickOnce(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks);
    void moveAlongFlow(BodyArrays<S>& bodies, Real h, const Tasks& tasks);

    Integrator<S> integrator_{};
    RotationScheme<S> rotation_{};
    TurnRotation<S> turn_ = nullptr;
    // --- recomputed every sub-step
    std::vector<Velocity<S>> start_;  ///< before kick()
    std::vector<Velocity<S>> used_;
    std::vector<Ang> kicked_;     ///< with forces, without the gyroscopic term
    std::vector<Ang> predicted_;  ///< with the gyroscopic term, before constraints
    std::vector<typename S::Rot> startRotations_;
    std::vector<Wrench<S>> wrench_;
    FreeFlow<S> flow_;
    BlockMotion<S> blocks_;
    bool inBlocks_ = false, begun_ = false;
    bool kickedInBlocks_ = false;
};

}  // namespace rigor::engine
