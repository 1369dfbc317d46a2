// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A spec's settings as the engine's WorldDef, and what they mean for the parity ledger.
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/foreign_narrow_phase.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::adapter {

Capabilities rigorCapabilities();

/// Throws BadInput for settings that are missing or malformed.
template <class S>
engine::WorldDef<S> toWorldDef(const Scenario& scenario, const Settings& settings) {
    using R = typename S::Real;
    engine::WorldDef<S> def;
    def.gravity = toEngineVec<S>(scenario.gravity);
    def.integrator = textSetting(settings, "integrator");
    def.rotation = textSetting(settings, "rotation");
    def.orientationUpdate = textSetting(settings, "orientation_update");
    def.broadPhase = textSetting(settings, "broad_phase");
    def.narrowPhase = textSetting(settings, "narrow_phase");
    def.manifold = textSetting(settings, "manifold");
    if (isForeignNarrowPhase(def.narrowPhase)) {
        if constexpr (S::dim == 3)
            def.customNarrowPhase = makeForeignNarrowPhase<S>(def.narrowPhase);
        else
            throw notInAdapter("rigor", "narrow_phase=" + def.narrowPhase + " in 2D");
    }
    def.solver = textSetting(settings, "solver");
    def.positionCorrection = textSetting(settings, "position_correction");
    def.friction = textSetting(settings, "friction");
    def.fault = textSetting(settings, "fault");
    def.continuousCollision = textSetting(settings, "continuous_collision");
    def.sleeping = textSetting(settings, "sleeping");
    def.sleepLinearVelocity = static_cast<R>(numberSetting(settings, "sleep_linear_velocity"));
    def.sleepAngularVelocity = static_cast<R>(numberSetting(settings, "sleep_angular_velocity"));
    def.timeToSleep = static_cast<R>(numberSetting(settings, "time_to_sleep"));
    def.restitution = textSetting(settings, "restitution");
    def.frictionCombine = textSetting(settings, "friction_combine");
    def.restitutionCombine = textSetting(settings, "restitution_combine");
    def.residualTolerance = static_cast<R>(numberSetting(settings, "residual_tolerance"));
    def.measureResiduals = textSetting(settings, "measure_residuals") == "on";
    def.pyramidDirections = integerSetting(settings, "pyramid_directions");
    def.substeps = integerSetting(settings, "substeps");
    def.threads = integerSetting(settings, "threads");
    def.contactFrequency = static_cast<R>(numberSetting(settings, "contact_frequency"));
    def.contactDampingRatio = static_cast<R>(numberSetting(settings, "contact_damping_ratio"));
    def.jointFrequency = static_cast<R>(numberSetting(settings, "joint_frequency"));
    def.jointDampingRatio = static_cast<R>(numberSetting(settings, "joint_damping_ratio"));
    def.velocityIterations = integerSetting(settings, "velocity_iterations");
    def.velocityTolerance = static_cast<R>(numberSetting(settings, "velocity_tolerance"));
    def.positionIterations = integerSetting(settings, "position_iterations");
    def.firstStepIterations = integerSetting(settings, "first_step_iterations");
    def.warmStarting = textSetting(settings, "warm_starting") == "on";
    def.curvedJoints = textSetting(settings, "curved_joints") == "on";
    def.restitutionThreshold = static_cast<R>(numberSetting(settings, "restitution_threshold"));
    def.slop = static_cast<R>(numberSetting(settings, "slop"));
    def.gapSlop = static_cast<R>(numberSetting(settings, "gap_slop"));
    def.speculativeDistance = static_cast<R>(numberSetting(settings, "speculative_distance"));
    def.reuseDistance = static_cast<R>(numberSetting(settings, "reuse_distance"));
    def.boxMargin = static_cast<R>(numberSetting(settings, "box_margin"));
    return def;
}

/// Whether the combine rules of the settings are those of the scenario format, sqrt(mu_a mu_b) and
/// min(e_a, e_b).
bool combinesAsScenarios(const Settings& settings);

/// The ledger that follows from the settings. `bounces`: some pair has a restitution above zero; `substep`:
/// what the solver steps by [s].
std::vector<LedgerEntry> settingsLedger(const Scenario& scenario, const Settings& settings, bool bounces,
                                        double substep);

}  // namespace rigor::adapter
