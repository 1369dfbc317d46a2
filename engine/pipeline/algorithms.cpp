// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/algorithms.hpp"

#include "engine/broadphase/broad_phase.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/faults/fault.hpp"
#include "engine/integrators/integrator.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/sleeping/sleeping.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/solvers/position_correction.hpp"
#include "engine/solvers/restitution.hpp"
#include "engine/solvers/solver.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {
namespace {

template <class Table>
AlgorithmFamily family(const char* name, const char* summary, const std::string& defaultChoice, Table table) {
    AlgorithmFamily result{name, summary, defaultChoice, {}};
    for (const auto& entry : table) result.algorithms.push_back({entry.name, entry.summary});
    return result;
}

}  // namespace

std::vector<AlgorithmFamily> algorithmFamilies() {
    using S = Space3d;
    const WorldDef<S> def;
    return {
        family("broad_phase", "which bounding boxes overlap", def.broadPhase, broadPhaseTable<S>()),
        family("narrow_phase", "where two shapes touch", def.narrowPhase, narrowPhases()),
        family("manifold", "which of the touching points the solver gets", def.manifold, manifoldTable<S>()),
        family("integrator", "how velocities move bodies", def.integrator, integratorTable<S>()),
        family("rotation", "gyroscopic term of free rotation", def.rotation, rotationTable<S>()),
        family("orientation_update", "how angular velocities turn bodies", def.orientationUpdate,
               orientationUpdateTable<S>()),
        family("solver", "impulses of contacts and joints", def.solver, solverTable<S>()),
        family("friction", "the friction law of one contact point", def.friction, frictionTable<S>()),
        family("restitution", "what a contact does that is hit", def.restitution, restitutionTable<S>()),
        family("friction_combine", "friction of two materials whose pair has none of its own",
               def.frictionCombine, combineTable<S::Real>()),
        family("restitution_combine", "restitution of two materials whose pair has none of its own",
               def.restitutionCombine, combineTable<S::Real>()),
        family("position_correction", "what removes overlap and joint drift", def.positionCorrection,
               positionCorrectionTable<S>()),
        family("fault", "deliberate mistakes, for study", def.fault, faultTable<S>()),
        family("continuous_collision", "what keeps fast bodies from passing through thin ones",
               def.continuousCollision, continuousCollisionTable<S>()),
        family("sleeping", "whether bodies at rest are left out", def.sleeping, sleepingTable<S>()),
    };
}

}  // namespace rigor::engine
