// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The parts of a world: what a step works on (step.hpp) and what a program builds (world.hpp).
//
//     def, algorithms     settings, and the algorithms that they name
//     bodies              poses, velocities, masses
//     contacts            shapes, materials, and what touches
//     joints, forces      as added
//     islands             what connects the bodies
//     clock               steps so far
//
// Invariant: a part knows the bodies of the others by their dense index, 0 the world. A function that changes
// dense indices notifies all parts (removeBody).
#pragma once

#include <cstdint>

#include "engine/contacts/contacts.hpp"
#include "engine/core/tasks.hpp"
#include "engine/forces/force_set.hpp"
#include "engine/pipeline/joints.hpp"
#include "engine/pipeline/step_algorithms.hpp"
#include "engine/pipeline/world_bodies.hpp"
#include "engine/pipeline/world_islands.hpp"

namespace rigor::engine {

template <class S>
struct WorldClock {
    double time = 0;                       ///< the sum of all steps [s]
    typename S::Real lastSubstepSize = 0;  ///< length of usual islands' last sub-step [s]; 0: there was none
    std::uint64_t steps = 0;
};

template <class S>
struct WorldParts {
    using Real = typename S::Real;

    /// Throws EngineError for unknown algorithm names and for numbers out of range.
    explicit WorldParts(const WorldDef<S>& definition);

    /// Sub-steps of a step, and most iterations of each: the settings, or the solver's own. Of usual islands.
    int substeps() const { return algorithms.usual.substeps; }
    int velocityIterations() const { return algorithms.usual.velocityIterations; }
    /// Length of the last step [s].
    Real lastStepSize() const {
        return clock.steps == 0 ? Real(0) : clock.lastSubstepSize * Real(substeps());
    }

    void removeBody(BodyId body);
    void removeShape(ShapeId shape);
    /// Adds a shape's mass to its body, which was added last.
    void addShapeMass(std::uint32_t body);
    /// Sums the masses of a body's shapes anew.
    void sumShapeMasses(std::uint32_t body);
    /// Gives a body the mass properties that it should have; shapes, joints and forces follow its centre of mass.
    void updateMass(std::uint32_t body);
    /// Sets whether continuous collision looks at a body. A body that needs it where the world has none brings
    /// conservative_advancement for those that need it.
    void setContinuous(std::uint32_t body, ContinuousMode mode);
    /// Wakes every body, where bodies sleep.
    void wakeAll();
    void removeJoint(JointId joint);
    void jointsChanged() { contacts.setExcluded(joints.exclusions()); }

    /// Islands of the contacts and joints of the last step.
    const Islands& currentIslands() const { return islands.get(links()); }
    /// Wakes all of the island of a body, if the body is asleep: bodies that rest on it must react.
    void wakeIslandOf(std::uint32_t body);
    void wakeNeighboursOf(std::uint32_t body);
    /// Wakes what a new or changed shape of a body may move: its island, or every body if it is not dynamic, since
    /// it may stand in the way of any of them.
    void wakeReachOf(std::uint32_t body);

    WorldDef<S> def;
    StepAlgorithms<S> algorithms;
    Tasks tasks;
    WorldBodies<S> bodies;
    Contacts<S> contacts;
    Joints<S> joints;
    ForceSet<S> forces;
    WorldIslands<S> islands;
    WorldClock<S> clock;
    bool gravityChanged = false;  ///< def.gravity is not what the world was built with

  private:
    typename WorldIslands<S>::Links links() const { return {bodies.arrays(), contacts.list(), joints}; }
};

}  // namespace rigor::engine
