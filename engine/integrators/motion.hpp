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

    /// The first half of each (sub-)step is drift(), before contacts are found.
    bool isAtMidpoint() const { return integrator_.atMidpoint; }
    /// Length of move() in a (sub-)step of h [s].
    Real moveTime(Real h) const { return integrator_.atMidpoint ? Real(0.5) * h : h; }
    /// Constraints of a step already act on the motion of that step.
    bool movesWithSolvedVelocity() const { return integrator_.movesWithSolvedVelocity; }

    /// Makes bodies move in blocks from now on (block_motion.hpp). Allowed only for the choices that block
    /// motion supports, and not with interrupt().
    void moveInBlocks(bool gyroscopic) {
        blocks_ = BlockMotion<S>(gyroscopic);
        inBlocks_ = true;
    }
    /// Must be called before the first kick() of a step, which may be of several.
    void beginStep() { begun_ = false; }

    /// True after a kick() if the other sub-steps need only the world inertia of the beginning of the step.
    bool inertiaHolds() const { return kickedInBlocks_ && blocks_.gyroscopic(); }

    /// World inertia of every body at its present pose. Before rows are made and before kick().
    static void setInertia(BodyArrays<S>& bodies, const Tasks& tasks = Tasks::one());

    /// Moves every body over the first half of h with its own velocity; only where isAtMidpoint().
    void drift(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());
    /// The velocities of the last drift().
    std::span<const Velocity<S>> drifted() const { return drifted_; }
    /// Velocities after h [s] of forces alone. Wrenches are read, not cleared: they last all sub-steps.
    void kick(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks = Tasks::one());
    /// Moves every body over h, or over its second half.
    void move(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());
    /// The velocities of the last move(), over moveTime(h).
    std::span<const Velocity<S>> used() const { return used_; }
    /// Mean velocity of a body's way over the whole (sub-)step.
    Velocity<S> meanUsed(std::size_t i) const {
        if (!integrator_.atMidpoint) return used_[i];
        return {Real(0.5) * (drifted_[i].v + used_[i].v), Real(0.5) * (drifted_[i].w + used_[i].w)};
    }
    /// Orientations before the last move(), by dense index.
    std::span<const typename S::Rot> startRotations() const { return startRotations_; }
    /// Called after poses have changed for the last time, by move() of h and position correction.
    void finish(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());

    // --- a body that collides on its way
    /// Between move() and finish(): the body's angular velocity where it is now, part of the way.
    void interrupt(BodyArrays<S>& bodies, std::size_t i);
    /// Called after a body's velocity has changed with `rest` [s] of its motion left. The caller moves the
    /// body with its new velocity; finish() then refers to that rest.
    void resume(BodyArrays<S>& bodies, std::size_t i, Real rest);
    /// Sets used() so that meanUsed() is that of the way that the body has taken in the end.
    void replaceMeanUsed(std::size_t i, const Velocity<S>& mean) {
        used_[i] = mean;
        if (!integrator_.atMidpoint) return;
        used_[i].v += mean.v - drifted_[i].v;
        used_[i].w += mean.w - drifted_[i].w;
    }

  private:
    bool goesInBlocks(const Load<S>& load) const {
        return inBlocks_ && (load.forces == nullptr || load.forces->size() == 0);
    }
    void kickOnce(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks);
    void evaluateForces(const BodyArrays<S>& bodies, const Load<S>& load, Real h);
    void predictMove(BodyArrays<S>& bodies, Real h, const Tasks& tasks);
    void moveAlongFlow(BodyArrays<S>& bodies, Real h, const Tasks& tasks);

    Integrator<S> integrator_{};
    RotationScheme<S> rotation_{};
    TurnRotation<S> turn_ = nullptr;
    // --- recomputed every sub-step
    std::vector<Velocity<S>> start_;  ///< velocities before kick()
    std::vector<Velocity<S>> used_, drifted_;
    std::vector<Velocity<S>> middle_;  ///< velocities in the middle of the step, for forces
    std::vector<Ang> kicked_;          ///< angular velocities with forces, without the gyroscopic term
    std::vector<Ang> predicted_;       ///< angular velocities with the gyroscopic term, before constraints
    std::vector<typename S::Rot> startRotations_;
    std::vector<Wrench<S>> wrench_;
    FreeFlow<S> flow_;
    BlockMotion<S> blocks_;
    bool inBlocks_ = false, begun_ = false;
    bool kickedInBlocks_ = false;
};

}  // namespace rigor::engine
