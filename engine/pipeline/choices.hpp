// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The algorithms of a world as constants beside their names, from the tables themselves: a typing mistake does not
// compile.
//
//     def.solver = choices::solver_nsgs;                         the string "nsgs"
//     choose(def, choices::friction_cone, choices::solver_pgs);  each where it belongs
#pragma once

#include <string>

#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Name of an algorithm of one family: `member` of WorldDef.
template <class Family>
struct Choice {
    const char* name;
    operator std::string() const { return name; }
};

namespace choices {

struct BroadPhaseFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::broadPhase;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<BroadPhaseFamily> broad_phase_##known{#known};
#include "engine/broadphase/broadphases.def"

struct NarrowPhaseFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::narrowPhase;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<NarrowPhaseFamily> narrow_phase_##known{#known};
#include "engine/narrowphase/narrowphases.def"

struct ManifoldFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::manifold;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<ManifoldFamily> manifold_##known{#known};
#include "engine/narrowphase/manifolds.def"

struct IntegratorFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::integrator;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<IntegratorFamily> integrator_##known{#known};
#include "engine/integrators/integrators.def"

struct RotationFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::rotation;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<RotationFamily> rotation_##known{#known};
#include "engine/integrators/rotations.def"

struct OrientationUpdateFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::orientationUpdate;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<OrientationUpdateFamily> orientation_update_##known{#known};
#include "engine/integrators/orientation_updates.def"

struct SolverFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::solver;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<SolverFamily> solver_##known{#known};
#include "engine/solvers/solvers.def"

struct FrictionFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::friction;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<FrictionFamily> friction_##known{#known};
#include "engine/solvers/frictions.def"

struct RestitutionFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::restitution;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<RestitutionFamily> restitution_##known{#known};
#include "engine/solvers/restitutions.def"

struct FrictionCombineFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::frictionCombine;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<FrictionCombineFamily> friction_combine_##known{#known};
#include "engine/solvers/combine_rules.def"

struct RestitutionCombineFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::restitutionCombine;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<RestitutionCombineFamily> restitution_combine_##known{#known};
#include "engine/solvers/combine_rules.def"

struct PositionCorrectionFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::positionCorrection;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<PositionCorrectionFamily> position_correction_##known{#known};
#include "engine/solvers/position_corrections.def"

struct FaultFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::fault;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<FaultFamily> fault_##known{#known};
#include "engine/faults/faults.def"

struct ContinuousCollisionFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::continuousCollision;
};
#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<ContinuousCollisionFamily> continuous_collision_##known{#known};
#include "engine/ccd/continuous_collisions.def"

struct SleepingFamily {
    template <class S>
    static constexpr auto member = &WorldDef<S>::sleeping;
};
#define ALGORITHM(known, make, summary) inline constexpr Choice<SleepingFamily> sleeping_##known{#known};
#include "engine/sleeping/sleepings.def"

}  // namespace choices

/// Sets the members that the constants are of.
template <class S, class... Families>
void choose(WorldDef<S>& def, Choice<Families>... choice) {
    ((def.*Families::template member<S> = choice.name), ...);
}

}  // namespace rigor::engine
