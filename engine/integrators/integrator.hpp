// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time integration: how forces change velocities, how velocities move bodies, and what a body's own rotation
// does to its angular velocity.
#pragma once

#include <span>

#include "engine/core/table.hpp"
#include "engine/core/tasks.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Effect of a damping factor and a force on a velocity in one step of h:  v' = kept v + kick a.
template <class R>
struct DampedStep {
    R kept = 1;  ///< factor on the velocity
    R kick = 0;  ///< factor on the acceleration [s]
};
/// The exact solution of v_dot = ln(keptPerSecond) v + a over h; kept = 1 gives exactly {1, h}.
template <class R>
DampedStep<R> dampedStep(R keptPerSecond, R h);

/// q turned by the rotation vector v [rad], world frame: the orientation update.
template <class S>
using TurnRotation = typename S::Rot (*)(const typename S::Rot& q, const typename S::Ang& v);
template <class S>
using OrientationFactory = TurnRotation<S> (*)();
template <class S>
std::span<const AlgorithmEntry<OrientationFactory<S>>> orientationUpdateTable();

/// Linear and rotational motion over one step. `start` are the velocities before the step, the arrays hold
/// those after it. Moves the poses and writes to `used` the velocities that moved them.
template <class S>
using MoveBodies = void (*)(BodyArrays<S>& bodies, std::span<const Velocity<S>> start,
                            std::span<Velocity<S>> used, typename S::Real h, TurnRotation<S> turn,
                            const Tasks& tasks);
template <class S>
class FreeFlow;
/// Integrators that evaluate the forces more than once in a step: advances `flow` by h.
template <class S>
using AdvanceFlow = void (*)(FreeFlow<S>& flow, double begin, typename S::Real h);
/// An integrator has either `move` or `advance`.
template <class S>
struct Integrator {
    MoveBodies<S> move = nullptr;
    bool movesWithSolvedVelocity = true;  ///< constraints of this step already act on this step's motion
    AdvanceFlow<S> advance = nullptr;
    /// Steps lead from midpoint to midpoint (Motion::toMidpoint, toEnd).
    bool atMidpoint = false;
};
template <class S>
using IntegratorFactory = Integrator<S> (*)();
template <class S>
std::span<const AlgorithmEntry<IntegratorFactory<S>>> integratorTable();

/// p += h v, q := turn(q, h w) for every body that may move.
template <class S>
void moveWith(BodyArrays<S>& bodies, std::span<const Velocity<S>> velocities, typename S::Real h,
              TurnRotation<S> turn, const Tasks& tasks);

/// The gyroscopic term of one body. 2D: nothing to do.
template <class S>
struct RotationScheme {
    /// Called before the constraints: computes from the angular velocity w, with forces already applied, the
    /// one that constraints act on and that moves the body.
    typename S::Ang (*predict)(const BodyConstants<S>& body, const typename S::Rot& q,
                               const typename S::Ang& w, typename S::Real h);
    /// Called after the move from q0 to q1: returns the angular velocity at the end of the step. w is the
    /// argument of predict, `predicted` its result, `solved` that result after the constraints. Null:
    /// `solved` stays.
    typename S::Ang (*finish)(const BodyConstants<S>& body, const typename S::Rot& q0,
                              const typename S::Rot& q1, const typename S::Ang& w,
                              const typename S::Ang& predicted, const typename S::Ang& solved);
    bool gyroscopic = true;  ///< false: the law of motion has no gyroscopic term
};
template <class S>
using RotationFactory = RotationScheme<S> (*)();
template <class S>
std::span<const AlgorithmEntry<RotationFactory<S>>> rotationTable();

}  // namespace rigor::engine
