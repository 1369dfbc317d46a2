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

    /// Steps lead from midpoint to midpoint: toMidpoint() before anything else, toEnd() after it.
    bool isAtMidpoint() const { return integrator_.atMidpoint; }
    /// Moves bodies from the end of the last step to their midpoints: `half` [s] on, for each kind of
    /// islands. The midpoints that are known count if `same`: the last (sub-)step was as long. True: some were
    /// not known.
    bool toMidpoint(BodyArrays<S>& bodies, const PerIslandKind<Real>& half, bool same,
                    const Tasks& tasks = Tasks::one());
    /// The way of the flagged bodies to midpoints `half` [s] on, as the move of a (sub-)step without forces: for
    /// continuous collision, which may change it until finish(). Other bodies stay where they are.
    void flyToMidpoint(BodyArrays<S>& bodies, std::span<const std::uint8_t> flies, Real half);
    /// Moves a body by `time` [s], which may be negative, as free motion does without forces.
    void coast(BodyArrays<S>& bodies, std::size_t i, Real time) const;
    /// Takes the poses and velocities of the bodies of islands of one kind for their next midpoints and moves
    /// the bodies back by `half` [s]: to the end of the step. `way` are their velocities since the midpoint
    /// before; of kinematic bodies their own.
    void toEnd(BodyArrays<S>& bodies, IslandKind islands, std::span<const Velocity<S>> way, Real half,
               const Tasks& tasks = Tasks::one());
    // --- free rotation of one body over h [s] from the orientation q and the angular velocity w there
    /// Mean angular velocity.
    Ang freeRotation(const BodyConstants<S>& body, const typename S::Rot& q, const Ang& w, Real h) const {
        return rotation_.predict(body, q, w, h);
    }
    /// Angular velocity in the orientation q1 that the mean velocity leads to.
    Ang rotatedVelocity(const BodyConstants<S>& body, const typename S::Rot& q, const typename S::Rot& q1,
                        const Ang& w, const Ang& mean) const {
        return rotation_.finish ? rotation_.finish(body, q, q1, w, mean, mean) : mean;
    }
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

    /// Velocities after h [s] of forces alone. Wrenches are read, not cleared: they last all sub-steps.
    void kick(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks = Tasks::one());
    /// Moves every body over h.
    void move(BodyArrays<S>& bodies, Real h, const Tasks& tasks = Tasks::one());
    /// Moves a pose over h with a constant velocity, as move() does kinematic bodies.
    void carry(Pose<S>& pose, const Velocity<S>& velocity, Real h) const {
        pose.p += h * velocity.v;
        pose.q = turn_(pose.q, Ang(h * velocity.w));
    }
    /// The velocities of the last move().
    std::span<const Velocity<S>> used() const { return used_; }
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
    /// used() as it would be for the way that the body has taken in the end.
    void replaceUsed(std::size_t i, const Velocity<S>& velocity) { used_[i] = velocity; }

  private:
    bool goesInBlocks(const Load<S>& load) const {
        return inBlocks_ && (load.forces == nullptr || load.forces->size() == 0);
    }
    void kickOnce(BodyArrays<S>& bodies, const Load<S>& load, Real h, const Tasks& tasks);
    void evaluateForces(const BodyArrays<S>& bodies, const Load<S>& load, Real h);
    Ang halfwayRotation(const BodyArrays<S>& bodies, std::size_t i, Real time) const;
    void moveAlongFlow(BodyArrays<S>& bodies, Real h, const Tasks& tasks);

    Integrator<S> integrator_{};
    RotationScheme<S> rotation_{};
    TurnRotation<S> turn_ = nullptr;
    // --- recomputed every sub-step
    std::vector<Velocity<S>> start_;  ///< velocities before kick()
    std::vector<Velocity<S>> used_;
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
