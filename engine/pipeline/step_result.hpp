// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Result of a step.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/ccd/continuous_collision.hpp"
#include "engine/constraints/row.hpp"
#include "engine/contacts/contact_events.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Parts of a step (step.cpp); the first two run once, the others in every sub-step.
enum class Phase : std::uint8_t {
    BroadPhase,
    NarrowPhase,
    Rows,
    Velocities,
    Solve,
    Move,
    Impacts,
    Relax,
    Positions,
    Correct
};
inline constexpr std::size_t kPhases = 10;
const char* phaseName(Phase phase);  ///< "broad_phase", "narrow_phase", ...

enum class ResidualMeasure : std::uint8_t {
    Change,     ///< largest velocity error that the iteration removed from a row or block
    NaturalMap  ///< residual of the natural map of all rows after the iteration (solvers/natural_map.hpp)
};
/// Called after each iteration of the velocity solver with its number in the step, the rows (impulses so far)
/// and its residual as in StepResult.
template <class S>
using IterationObserver = std::function<void(int, const ConstraintRows<S>&, typename S::Real)>;

/// Result of one step. Spans are valid until the next.
template <class S>
struct StepResult {
    bool nonFinite = false;     ///< a velocity or pose has become NaN or infinite
    std::size_t pairTests = 0;  ///< boxes that the broad phase compared
    std::size_t pairs = 0, contacts = 0, rows = 0;
    std::size_t narrowPhaseCalls = 0;  ///< narrow-phase queries: pairs, or pieces of surfaces
    int iterations = 0;                ///< iterations of the solver in all sub-steps
    /// Collisions that continuous_collision = conservative_advancement or the integrator has found at their
    /// own times, in the order of these.
    std::span<const ImpactEvent<S>> impacts;
    std::size_t sleeping = 0;  ///< bodies asleep at the end of the step
    /// Groups of bodies in flight whose impacts the step has treated as those of other bodies, because they
    /// were too many or not of bodies in flight alone (ccd/flight_impacts.hpp).
    int unlocatedImpacts = 0;
    bool impactsCut = false;  ///< a body had too many of them and lost the rest of its time
    /// Quantity in `residuals`, one per iteration [m/s or rad/s].
    ResidualMeasure measure = ResidualMeasure::Change;
    std::span<const typename S::Real> residuals;
    std::span<const Event<S>> events;  ///< contacts that began and ended, in the order of shapes
    bool solverGaveUp = false;         ///< a solver did not reach what it promises and left the best it had
    std::array<double, kPhases> seconds{};  ///< wall time per phase
    std::span<const JointId> broken;        ///< joints that broke in this step; they no longer exist
};

/// A contact point as the last step solved it. A is the body of lower dense index.
template <class S>
struct ContactView {
    BodyId bodyA, bodyB;
    ShapeId shapeA, shapeB;
    typename S::Vec pointA, pointB, normal;  ///< in world coordinates, where contactsAtStepEnd() says; normal
                                             ///< from A to B
    typename S::Real separation;             ///< [m]; < 0: overlap
    typename S::Real normalImpulse;          ///< [N s], >= 0
    typename S::Vec frictionImpulse;         ///< impulse on B [N s]
};

/// A joint where its bodies are now; a null body is the world.
template <class S>
struct JointPlace {
    JointId id;
    JointType type = JointType::Ball;
    BodyId bodyA, bodyB;
    typename S::Vec anchorA, anchorB;  ///< world frame [m]
};

}  // namespace rigor::engine
