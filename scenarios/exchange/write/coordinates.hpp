// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The coordinates of a joint as slides and turns that act one after the other, as MJCF states them.
#pragma once

#include <optional>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::models {

struct Coordinate {
    enum Kind { Slide, Turn, Ball } kind;
    scenario::Vec3 axis;            ///< unit, in the child's body frame; unused for Ball
    scenario::JointAxis control{};  ///< limits, spring and motor
    const char* suffix = "";        ///< end of its name; "" for the one that has the joint's own
};

/// Coordinates of a joint of the tree, the first is the outermost; none for `Fixed`. Nothing where they can not be
/// stated so: distances, cone_twist, wheels; six_dof with two or three turns, but for a universal joint (the twist and one
/// swing) and a ball (all turns free). `isReversed`: the child is the joint's A.
std::optional<std::vector<Coordinate>> coordinatesOf(const scenario::Scenario& scenario,
                                                     const scenario::Joint& joint, bool isReversed);

/// True for a six_dof joint that leaves a plane free: two travels at right angles to the axis and the turn about it.
bool isPlanar(const scenario::Joint& joint);

}  // namespace rigor::models
