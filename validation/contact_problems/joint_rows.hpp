// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Constraints of joints as rows on velocities:
//     d . (vB + wB x rB - vA - wA x rA) + t . (wB - wA) = 0
// with the arms r from the centres of mass to the anchor. Source: Haug, Computer Aided Kinematics and
// Dynamics of Mechanical Systems, 1989, chapters 3 and 9.
#pragma once

#include <span>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

struct JointRow {
    scenario::Vec3 linear;   ///< d; zero: angular alone
    scenario::Vec3 angular;  ///< t
    scenario::Vec3 armA, armB;
};

/// The rows of one joint at the poses `states`, world axes. Throws adapter::Unsupported, naming the joint,
/// for what is no equation between velocities: limits, motors, springs, ropes, and the joints of several
/// coordinates.
std::vector<JointRow> jointRows(const scenario::Scenario& scenario, const scenario::Joint& joint,
                                std::span<const BodyState> states);

}  // namespace rigor::validation
