// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motors of joints, and the springs of coordinates that no mobilizer has.
#pragma once

#include <optional>
#include <vector>

#include "adapters/simbody/pair_forces.hpp"

namespace rigor::simbody {

/// A coordinate that a motor drives: one of a mobilizer, or one between two bodies.
struct Motor {
    double speed = 0.0, maxForce = 0.0;  ///< [u/s], [N] or [N m]
    SimTK::Constraint hold;              ///< enabled while the motor is strong enough to keep its speed
    SimTK::MobilizedBody mobilizer;      ///< the coordinate is its own if `pair` is null
    const PairPush* pair = nullptr;      ///< coordinate between two bodies

    double rate(const SimTK::State& state) const;
    /// Acceleration by `change` of the accelerations of all coordinates.
    double gain(const SimTK::State& state, const SimTK::Vector& change) const;
    /// Acceleration with the accelerations `all`.
    double acceleration(const SimTK::State& state, const SimTK::Vector& all) const;
    void push(SimTK::State& state, const SimTK::Force::DiscreteForces& discrete, double amount) const;
};

/// A force along a coordinate between two bodies, and the constraint of a motor there.
struct Acting {
    SimTK::Force handle;
    const PairForce* force = nullptr;
    std::optional<SimTK::Constraint> hold;
};

}  // namespace rigor::simbody
