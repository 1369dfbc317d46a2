// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/algorithms.hpp"

#include "engine/broadphase/broad_phase.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/contacts/bounding_volume.hpp"
#include "engine/faults/fault.hpp"
#include "engine/integrators/integrator.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/sleeping/sleeping.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/solvers/position_correction.hpp"
#include "engine/solvers/restitution.hpp"
#include "engine/solvers/solver.hpp"
#include "engine/state/settings.hpp"

namespace rigor::engine {
namespace {

template <class Table>
AlgorithmFamily family(const char* key, Table table) {
    const SettingInfo& info = setting(key);
    AlgorithmFamily result{key, info.help, info.byDefault, {}};
    for (const auto& entry : table) result.algorithms.push_back({entry.name, entry.summary});
    return result;
}

}  // namespace

std::vector<AlgorithmFamily> algorithmFamilies() {
    using S = Space3d;
    return {
        family("broad_phase", broadPhaseTable<S>()),
        family("bounding_volume", boundingVolumeTable()),
        family("narrow_phase", narrowPhases()),
        family("manifold", manifoldTable<S>()),
        family("integrator", integratorTable<S>()),
        family("rotation", rotationTable<S>()),
        family("orientation_update", orientationUpdateTable<S>()),
        family("solver", solverTable<S>()),
        family("friction", frictionTable<S>()),
        family("restitution", restitutionTable<S>()),
        family("friction_combine", combineTable<S::Real>()),
        family("restitution_combine", combineTable<S::Real>()),
        family("position_correction", positionCorrectionTable<S>()),
        family("fault", faultTable<S>()),
        family("continuous_collision", continuousCollisionTable<S>()),
        family("sleeping", sleepingTable<S>()),
    };
}

}  // namespace rigor::engine
