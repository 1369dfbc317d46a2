// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Coordinates of a joint, from the poses of its bodies alone.
#pragma once

#include <cmath>
#include <optional>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

struct JointCoordinate {
    double value = 0.0;  ///< [m], or [rad] within one turn
    bool turn = false;   ///< an angle about one axis: counted over turns

    /// The value over turns, nearest to the `last` one.
    double after(double last) const {
        return turn ? last + std::remainder(value - last, 6.283185307179586) : value;
    }
};

/// Coordinate k of a joint as the scenario format counts it, zero at the scenario's own poses (distance: the
/// distance of the anchors). `a` and `b` are the poses of its bodies now, the identity for the world. Empty
/// if it has no such coordinate, or if an angle depends on the order of several free turns.
std::optional<JointCoordinate> jointCoordinate(const scenario::Scenario& scenario,
                                               const scenario::Joint& joint, std::size_t k,
                                               const scenario::Pose& a, const scenario::Pose& b);

}  // namespace rigor::validation
