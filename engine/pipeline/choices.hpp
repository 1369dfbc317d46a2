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

#define CHOICE_FAMILY(key, memberOfDef)                           \
    struct family_##key {                                         \
        template <class S>                                        \
        static constexpr auto member = &WorldDef<S>::memberOfDef; \
    };
#include "engine/pipeline/choice_families.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_broad_phase> broad_phase_##known{#known};
#include "engine/broadphase/broadphases.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_bounding_volume> bounding_volume_##known{#known};
#include "engine/contacts/bounding_volumes.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_narrow_phase> narrow_phase_##known{#known};
#include "engine/narrowphase/narrowphases.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_manifold> manifold_##known{#known};
#include "engine/narrowphase/manifolds.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_integrator> integrator_##known{#known};
#include "engine/integrators/integrators.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_rotation> rotation_##known{#known};
#include "engine/integrators/rotations.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_orientation_update> orientation_update_##known{#known};
#include "engine/integrators/orientation_updates.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_solver> solver_##known{#known};
#include "engine/solvers/solvers.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_friction> friction_##known{#known};
#include "engine/solvers/frictions.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_restitution> restitution_##known{#known};
#include "engine/solvers/restitutions.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_friction_combine> friction_combine_##known{#known};
#include "engine/solvers/combine_rules.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_restitution_combine> restitution_combine_##known{#known};
#include "engine/solvers/combine_rules.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_position_correction> position_correction_##known{#known};
#include "engine/solvers/position_corrections.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_fault> fault_##known{#known};
#include "engine/faults/faults.def"

#define ALGORITHM(known, make, summary) \
    inline constexpr Choice<family_continuous_collision> continuous_collision_##known{#known};
#include "engine/ccd/continuous_collisions.def"

#define ALGORITHM(known, make, summary) inline constexpr Choice<family_sleeping> sleeping_##known{#known};
#include "engine/sleeping/sleepings.def"

}  // namespace choices

/// Sets the members that the constants are of.
template <class S, class... Families>
void choose(WorldDef<S>& def, Choice<Families>... choice) {
    ((def.*Families::template member<S> = choice.name), ...);
}

}  // namespace rigor::engine
