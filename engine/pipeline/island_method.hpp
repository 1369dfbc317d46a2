// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The method by which a step solves islands and moves their bodies. Most solvers are the method of all
// islands. One whose traits name a solver for large islands (SolverTraits::largeIslands) has two: an island
// with more contacts than WorldDef::islandContacts is large. With joints in it as many contacts as there are joints
// count twice: sweeps over both converge slowly, and mostly make all iterations that they may. An island that is
// large stays so until it has fewer than half as many, so that it does not change to and fro. With large islands there
// is a third method: islands that are not large, but in violent motion, are solved as the others with contacts that are
// found for each half of the step (step_violent.cpp).
//
// Islands do not act on each other within a step, so the step is made up to three times, each time of the islands of
// one method while the bodies of the others are paused (Step::beginIslands). Two bodies that a force connects count
// as one island here.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/contacts/contact_model.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/integrators/motion.hpp"
#include "engine/solvers/solver.hpp"
#include "engine/state/island_kind.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
struct IslandMethod {
    using Real = typename S::Real;

    ClonePtr<Solver<S>> solver;
    SolverStyle<S> style;
    ClonePtr<ContactModel<S>> contactModel;  ///< the one that the solver takes
    Motion<S> motion;
    int substeps = 1;            ///< equal parts of a step
    int velocityIterations = 1;  ///< most iterations of each
    Real contactFrequency = 0;   ///< frequency of soft contacts [Hz]
    bool relinearizedJoints = true;
    int secondSearch = 0;        ///< sub-step before which contacts may be found again; 0: none is
    Real cacheTolerance = 0;     ///< WorldDef's setting of that name [m]
    Real speculativeMotion = 0;  ///< the same; at least 1 where steps lead from midpoint to midpoint
};

/// Number of contacts by which an island is large: one with a joint beside it counts twice.
inline std::size_t countedContacts(std::size_t contacts, std::size_t joints) {
    return contacts + std::min(contacts, joints);
}

/// The islands of a step by kind, and data to pause those that take no part.
template <class S>
struct IslandSort {
    struct Counts {
        std::uint32_t contacts = 0, joints = 0;
        std::uint32_t large = 0;    ///< contacts that were solved as of a large island
        std::uint32_t violent = 0;  ///< contacts whose bodies close in fast
        bool bounces = false;       ///< has contacts with restitution
    };
    // --- by island
    std::vector<Counts> counts;
    std::vector<IslandKind> kind;
    std::vector<IslandKind> joined;  ///< scratch
    // --- by body
    std::vector<IslandKind> before;      ///< kinds in the last step
    std::vector<std::uint8_t> paused;    ///< 1: takes no part in the half of the step that runs
    std::vector<Pose<S>> startPoses;     ///< poses where the step began
    std::vector<std::uint32_t> violent;  ///< indices of contacts whose bodies close in fast
};

}  // namespace rigor::engine
