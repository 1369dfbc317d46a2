// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Continuous collision, which keeps fast bodies from passing through thin ones: the family
// `continuous_collision`. A choice may add contacts in advance when contacts are found, or examine the motion
// of the bodies afterwards, or both.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/contacts/contacts.hpp"
#include "engine/contacts/look_ahead.hpp"
#include "engine/contacts/moving_shape.hpp"
#include "engine/core/table.hpp"
#include "engine/integrators/motion.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// A collision inside a step, at its own time.
template <class S>
struct ImpactEvent {
    BodyId a, b;  ///< A is the body of lower dense index
    ShapeId shapeA, shapeB;
    typename S::Real time;     ///< time since the step began [s]
    typename S::Vec point;     ///< halfway between the closest points, world frame [m]
    typename S::Vec normal;    ///< unit, A to B
    typename S::Real impulse;  ///< impulse along the normal [N s], >= 0
    typename S::Vec friction;  ///< impulse of friction on B [N s]
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
    Real h;                     ///< length of the (sub-)step [s]
    Real begin;                 ///< start time of the (sub-)step since the step began [s]
    /// Flag of each body, or empty; 1: it belongs to islands that this half of the step does not move
    /// (pipeline/island_method.hpp). Its inverse mass is zero then.
    std::span<const std::uint8_t> paused = {};

    bool isPaused(std::uint32_t body) const { return !paused.empty() && paused[body] != 0; }
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
    /// Stores the velocities after forces alone have acted.
    virtual void rememberKick(const BodyArrays<S>& bodies) { (void)bodies; }
    /// Called after the bodies have moved. Changes poses and velocities by the impacts; events are appended
    /// in the order of time. False: the rest of a body's motion in this step was lost.
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
