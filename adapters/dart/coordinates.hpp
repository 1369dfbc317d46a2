// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A joint of the scenario as a chain of DART's joints, one for each coordinate that it leaves free.
#pragma once

#include <vector>

#include "adapters/dart/convert.hpp"
#include "adapters/interface/joint_trees.hpp"

namespace dart::dynamics {
class Joint;
}

namespace rigor::dart_adapter {

enum class CoordinateKind {
    Travel,  ///< PrismaticJoint
    Turn,    ///< RevoluteJoint
    Ball,    ///< BallJoint: all turns, without stops, springs and motors
};

struct Coordinate {
    CoordinateKind kind = CoordinateKind::Turn;
    Vec3 axis;  ///< unit; axes of the body that hangs on the joint, at the initial poses; unused by a ball
    const scenario::JointAxis* use = nullptr;  ///< stops, spring and motor; null for a ball
    dart::dynamics::Joint* joint = nullptr;    ///< set once it is built
};

/// Coordinates of the joint that a body hangs on, that nearest to the parent first; none where it holds everything.
/// The body that hangs on the joint moves by the last one, whose axis it carries. Throws Unsupported.
std::vector<Coordinate> coordinatesOf(const adapter::Link& link, const adapter::Scenario& scenario,
                                      bool planar);

/// True where successive turns stand for the twist and the swing vector of a six_dof, which they equal only to first
/// order: both swings are open, and not all turns are free.
bool hasEulerAngles(const scenario::Joint& joint);

/// Angles of one to three successive turns about orthogonal axes, whose product is `turned`, and their rates, which
/// together are the angular velocity `turn`. What the turns can not give is lost.
struct Angles {
    std::vector<double> angles, rates;  ///< [rad], [rad/s]
};
Angles anglesOf(const std::vector<Vec3>& axes, const Quat& turned, const Vec3& turn);

}  // namespace rigor::dart_adapter
