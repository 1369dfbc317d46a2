// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What keeps fast bodies from passing through thin ones: the family `continuous_collision`. A choice may look
// ahead when contacts are found, or look back at the way the bodies have moved, or both.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/ccd/moving_shape.hpp"
#include "engine/contacts/contacts.hpp"
#include "engine/contacts/look_ahead.hpp"
#include "engine/core/table.hpp"
#include "engine/integrators/motion.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// A collision inside a step, at its own time.
template <class S>
struct ImpactEvent {
    BodyId a, b;               ///< A is the body of lower dense index
    typename S::Real time;     ///< since the step began [s]
    typename S::Vec point;     ///< halfway between the closest points, world frame [m]
    typename S::Vec normal;    ///< unit, A to B
    typename S::Real impulse;  ///< along the normal [N s], >= 0
};

/// The world around the move of a (sub-)step.
template <class S>
struct MovedWorld {
    using Real = typename S::Real;
    BodyArrays<S>& bodies;
    const Contacts<S>& contacts;
    Motion<S>& motion;
    const NarrowPhase<S>& narrowPhase;
    FrictionLaw<S> friction;
    Real restitutionThreshold;  ///< [m/s]
    Real h;                     ///< of the (sub-)step [s]
    Real begin;                 ///< since the step began [s]
};

template <class S>
class ContinuousCollision : public LookAhead<S> {
  public:
    using Real = typename S::Real;
    virtual std::unique_ptr<ContinuousCollision> clone() const = 0;

    // --- when contacts are found, once per step
    /// Before the functions of LookAhead: `h` of the whole step.
    virtual void predict(const BodyArrays<S>& bodies, std::span<const ShapeRecord<S>> shapes,
                         const typename S::Vec& gravity, Real h) {
        (void)bodies;
        (void)shapes;
        (void)gravity;
        (void)h;
    }

    // --- around the move, once per sub-step
    /// Where and how fast the bodies are before forces and constraints of the sub-step.
    virtual void remember(const BodyArrays<S>& bodies) { (void)bodies; }
    /// What forces alone have made of the velocities.
    virtual void rememberKick(const BodyArrays<S>& bodies) { (void)bodies; }
    /// After the bodies have moved. Events are appended in the order of time; does what it says to poses and
    /// velocities. False: it had to leave a body behind.
    virtual bool resolve(const MovedWorld<S>& world, std::vector<ImpactEvent<S>>& events) {
        (void)world;
        (void)events;
        return true;
    }
};

template <class S>
using ContinuousCollisionFactory = std::unique_ptr<ContinuousCollision<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable();

}  // namespace rigor::engine
