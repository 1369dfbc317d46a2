// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/step_algorithms.hpp"

#include <algorithm>

#include "engine/ccd/traits.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/traits.hpp"
#include "engine/pipeline/require.hpp"
#include "engine/solvers/traits.hpp"
#include "engine/state/prefer_speed.hpp"
#include "engine/state/settings.hpp"

namespace rigor::engine {
namespace {

/// Throws for choices that exclude each other by their traits.
template <class S>
void checkChoices(const WorldDef<S>& def, const StepAlgorithms<S>& chosen) {
    const bool solvesImpacts = chosen.restitution->solvesImpacts();
    require(!chosen.usual.style.positions || !solvesImpacts, "restitution_solver",
            "this restitution needs a solver of velocities");
    const SolverTraits& solver = solverTraits(def.solver);
    if (solver.contacts == ContactForm::Rows) return;
    require(chosen.fault == nullptr, "fault_solver",
            "faults change rows of contacts, which this solver does not have");
    require(frictionShape(def.friction) == solver.friction, "friction_solver",
            "this solver has a friction law of its own, the cone's: friction must be cone");
    require(!solvesImpacts, "restitution_solver",
            "this restitution needs contacts as rows, which this solver does not have");
    require(!def.measureResiduals, "measure_residuals_solver",
            "residuals are measured on rows of contacts, which this solver does not have");
}

/// Bodies move in SIMD where their contacts are solved in SIMD, if all choices can do it.
template <class S>
bool movesInBlocks(const WorldDef<S>& def, const std::string& solver) {
    return solverTraits(solver).contacts == ContactForm::Patches &&
           integratorTraits(def.integrator).inBlocks && orientationTraits(def.orientationUpdate).inBlocks &&
           rotationTraits(def.rotation).inBlocks && !continuousCollisionTraits(def.continuousCollision).acts;
}

/// The other choices can be had with contacts as patches, and while the bodies of other islands are paused.
template <class S>
bool allowsLargeIslands(const WorldDef<S>& def, const StepAlgorithms<S>& chosen) {
    return chosen.fault == nullptr && frictionShape(def.friction) == FrictionShape::Cone &&
           !chosen.restitution->solvesImpacts() && !def.measureResiduals &&
           // They would be found for the midpoints of one half of the step alone.
           !(chosen.usual.motion.isAtMidpoint() &&
             continuousCollisionTraits(def.continuousCollision).givesContacts);
}

template <class S>
IslandMethod<S> makeMethod(const WorldDef<S>& def, const std::string& solver) {
    IslandMethod<S> method;
    const RotationScheme<S> rotation = findAlgorithm(rotationTable<S>(), "rotation", def.rotation).make();
    method.motion = {
        findAlgorithm(integratorTable<S>(), "integrator", def.integrator).make(), rotation,
        findAlgorithm(orientationUpdateTable<S>(), "orientation_update", def.orientationUpdate).make()};
    method.solver = findAlgorithm(solverTable<S>(), "solver", solver).make();
    method.style = method.solver->style();
    method.contactModel = makeContactModel<S>(solverTraits(solver).contacts);
    method.substeps = def.substeps > 0 ? def.substeps : method.style.substeps;
    method.velocityIterations =
        def.velocityIterations > 0 ? def.velocityIterations : method.style.iterations.value_or(50);
    method.contactFrequency = def.contactFrequency;
    method.relinearizedJoints = def.relinearizedJoints;
    method.cacheTolerance = def.cacheTolerance;
    // An impact that a body makes while others hold it is then closed at a midpoint, and not corrected after it.
    const bool findsAhead = method.motion.isAtMidpoint() && !method.style.positions &&
                            solverTraits(solver).contacts == ContactForm::Rows &&
                            findAlgorithm(faultTable<S>(), "fault", def.fault).make() == nullptr;
    method.speculativeMotion =
        findsAhead ? std::max(def.speculativeMotion, typename S::Real(1)) : def.speculativeMotion;
    // Other integrators show contacts where the step began. Continuous collision foresees the way of the whole step.
    if (solverTraits(solver).contacts == ContactForm::Patches && def.secondSearch &&
        method.motion.isAtMidpoint() && !continuousCollisionTraits(def.continuousCollision).acts)
        method.secondSearch = method.substeps / 2;
    if (movesInBlocks<S>(def, solver)) method.motion.moveInBlocks(rotation.gyroscopic);
    return method;
}

/// Springs of contact and sub-steps are those of preferSpeed(); joints are linearised, and hold.
template <class S>
IslandMethod<S> makeLargeMethod(const WorldDef<S>& def) {
    WorldDef<S> fast = def;
    preferSpeed(fast);
    fast.integrator = def.integrator;
    fast.substeps = std::max(fast.substeps, def.substeps);
    fast.velocityIterations = 0;
    fast.cacheTolerance = std::max(fast.cacheTolerance, def.cacheTolerance);
    if (manifoldTraits(def.manifold).remembers) fast.cacheTolerance = 0;
    return makeMethod<S>(fast, std::string(solverTraits(def.solver).largeIslands));
}

/// The usual method with contacts that are found for each half of the step.
template <class S>
IslandMethod<S> makeViolentMethod(const IslandMethod<S>& usual) {
    IslandMethod<S> method = usual;
    method.substeps = 2;
    method.secondSearch = 1;
    return method;
}

}  // namespace

template <class S>
StepAlgorithms<S>::StepAlgorithms(const WorldDef<S>& def) {
    checkSettings<S>(def);
    require(def.gravity.allFinite(), "gravity", "gravity must be finite");
    require(def.cacheTolerance == 0 || !manifoldTraits(def.manifold).remembers, "reuse_manifold",
            "a manifold that remembers needs the narrow phase in every step: reuse distance must be 0");
    usual = makeMethod<S>(def, def.solver);
    broadPhase = findAlgorithm(broadPhaseTable<S>(), "broad_phase", def.broadPhase).make();
    boundingVolume = findAlgorithm(boundingVolumeTable(), "bounding_volume", def.boundingVolume).make;
    correction =
        findAlgorithm(positionCorrectionTable<S>(), "position_correction", def.positionCorrection).make();
    ccd =
        findAlgorithm(continuousCollisionTable<S>(), "continuous_collision", def.continuousCollision).make();
    continuous = continuousCollisionTraits(def.continuousCollision).acts;
    // Contacts that are found ahead act from the midpoints on: on the way there bodies collide by their times of impact.
    if (continuous && usual.motion.isAtMidpoint())
        ccdToMidpoints =
            findAlgorithm(continuousCollisionTable<S>(), "continuous_collision", "conservative_advancement")
                .make();
    sleeping = findAlgorithm(sleepingTable<S>(), "sleeping", def.sleeping).make();
    restitution = findAlgorithm(restitutionTable<S>(), "restitution", def.restitution).make();
    combineFriction = findAlgorithm(combineTable<Real>(), "friction_combine", def.frictionCombine).make;
    combineRestitution =
        findAlgorithm(combineTable<Real>(), "restitution_combine", def.restitutionCombine).make;
    fault = findAlgorithm(faultTable<S>(), "fault", def.fault).make();
    friction = findAlgorithm(frictionTable<S>(), "friction", def.friction).make;
    narrowPhase = def.customNarrowPhase ? def.customNarrowPhase : makeNarrowPhase<S>(def.narrowPhase);
    makeManifold = findAlgorithm(manifoldTable<S>(), "manifold", def.manifold).make;
    checkChoices<S>(def, *this);
    // Its impacts obey Newton's law, and not twice what continuous collision resolves.
    locatesImpacts = usual.motion.isAtMidpoint() &&
                     !continuousCollisionTraits(def.continuousCollision).acts &&
                     !restitution->solvesImpacts() && fault == nullptr;
    if (!solverTraits(def.solver).largeIslands.empty() && allowsLargeIslands<S>(def, *this))
        large = makeLargeMethod<S>(def);
    // Continuous collision may come later, when islands are violent: they have the method, and become usual (step_violent.cpp).
    if (large && def.secondSearch && usual.motion.isAtMidpoint() && usual.substeps == 1)
        violent = makeViolentMethod<S>(usual);
}

#define RIGOR_INSTANTIATE(S) template struct StepAlgorithms<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
