// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits of integrators, rotation schemes and orientation updates (core/traits.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/traits.hpp"

namespace rigor::engine {

/// A scheme of free flight that is known by name, to compare with an ideal run of it.
enum class FlightScheme : std::uint8_t {
    Other,
    SymplecticEuler,
    ExplicitEuler,
    MoreauMidpoint,
    VelocityVerlet,
    RungeKutta4
};

/// Times in a step at which the forces are evaluated.
enum class ForceTimes : std::uint8_t { Start, Middle, StartAndEnd, Stages };

struct IntegratorTraits {
    FlightScheme scheme = FlightScheme::Other;
    int order = 1;  ///< order for smooth motion without constraints
    ForceTimes forces = ForceTimes::Start;
    bool ownsRotation = false;  ///< integrates the gyroscopic term itself, where the rotation scheme has one
    bool inBlocks = false;      ///< block_motion.hpp has the same law
};
std::span<const TraitsEntry<IntegratorTraits>> integratorTraitsTable();

struct RotationTraits {
    int order = 1;               ///< order for free rotation; 0: another law
    bool keepsMomentum = false;  ///< angular momentum of free rotation, to rounding
    bool keepsEnergy = false;    ///< keeps the energy of free rotation, to rounding
    bool inBlocks = false;       ///< block_motion.hpp has the same law
};
std::span<const TraitsEntry<RotationTraits>> rotationTraitsTable();

struct OrientationTraits {
    bool exact = false;     ///< exact for a constant angular velocity
    bool inBlocks = false;  ///< block_motion.hpp has the same law
};
std::span<const TraitsEntry<OrientationTraits>> orientationTraitsTable();

inline const IntegratorTraits& integratorTraits(const std::string& name) {
    return findTraits(integratorTraitsTable(), "integrator", name);
}
inline const RotationTraits& rotationTraits(const std::string& name) {
    return findTraits(rotationTraitsTable(), "rotation", name);
}
inline const OrientationTraits& orientationTraits(const std::string& name) {
    return findTraits(orientationTraitsTable(), "orientation_update", name);
}

}  // namespace rigor::engine
