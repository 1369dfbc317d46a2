// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a scenario as kinematic trees, for engines with reduced coordinates: every body hangs on at most one
// joint; joints that are left close loops.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

using scenario::kNone;

/// One body of the scenario in the trees. The engine's body frame has its origin in the centre of mass; that of a
/// dynamic body in 3D has the principal axes.
struct Link {
    int parent = kNone;     ///< scenario body that it hangs on; kNone: the world
    int joint = kNone;      ///< scenario joint; kNone: none, a free or static body
    bool reversed = false;  ///< the joint's A hangs on its B
    bool fixed = false;     ///< static
    Pose frame;             ///< the engine's body frame in the scenario's body frame
    Vec3 moments;           ///< moments of inertia about the axes of `frame` [kg m^2]
    Pose rest;              ///< initial pose in the frame of the parent
    std::vector<int> children;
};

struct Forest {
    std::vector<Link> links;  ///< links by scenario body
    std::vector<int> order;   ///< parents before their children
    std::vector<int> loops;   ///< joints that close loops
};

/// `scenario` is three-dimensional; `planar` if it was lifted from two dimensions.
Forest spanningForest(const Scenario& scenario, bool planar);

/// True for joints that points and whole frames can hold (a point, two points on an axis, a weld), so that they may close
/// a loop.
bool canCloseLoop(const scenario::Joint& joint);
/// True for joints with a strength. They are constraints beside the trees, which alone can be switched off.
bool canBreak(const scenario::Joint& joint);
/// Greatest angle between the axes of A and B [rad]; beyond pi where nothing bounds it.
double swingLimit(const scenario::Joint& joint);

/// Motion of a body on a joint against the one that it hangs on.
struct LinkMotion {
    Vec3 anchor;    ///< the joint's anchor in the body's frame [m]
    Pose pose;      ///< the body's frame in the world
    Pose parent;    ///< frame of the one it hangs on; the world's own where there is none
    Pose relative;  ///< the body's frame in its parent's
    Quat turned;    ///< turn since the initial poses, in the body's axes; w >= 0
    Vec3 turn;      ///< relative angular velocity, in the body's axes [rad/s]
    Vec3 speed;     ///< velocity of the anchor against the parent's point there, world frame [m/s]
};
/// `states` are those of all bodies, by scenario index.
LinkMotion motionOf(const Forest& forest, const Scenario& scenario, int body,
                    std::span<const BodyState> states);

/// Coordinate of a travel since the initial poses, and its rate.
struct Travel {
    double length = 0.0, speed = 0.0;  ///< [m], [m/s]
};
/// Travel along `axis` (unit, axes of the body that hangs on the joint, at the initial poses). A link that is not
/// reversed travels before it turns, along axes of its parent; a reversed one turns first and travels along its own.
Travel travelOf(const Link& link, const LinkMotion& motion, const Vec3& axis);
/// The angle plus the number of whole turns that brings it nearest to `now` [rad]: limits and springs count turns.
double nearestTurn(double angle, double now);
/// Angle by which the body has turned since the initial poses, about the unit `axis` [rad].
double turnAbout(const LinkMotion& motion, const Vec3& axis);

/// Force and torque at the centre of mass that damp a body: a step of `dt` with nothing else leaves kept^dt of its
/// velocities.
struct Damping {
    Vec3 force, torque;  ///< world frame [N], [N m]
};
Damping dampingOf(const scenario::Body& body, const Link& link, const BodyState& state, double dt);

/// Anchor and axis of a joint as the child of a link has them, in the link's frame. The axis points so that its
/// coordinate is the scenario's.
Vec3 anchorIn(const Link& link, const scenario::Joint& joint);
Vec3 axisIn(const Link& link, const scenario::Joint& joint);
/// The three axes of a six_dof. `scenario` gives the initial poses.
std::array<Vec3, 3> sixDofAxesIn(const Link& link, const Scenario& scenario, const scenario::Joint& joint);
/// Axis of a wheel's pin. `scenario` gives the initial poses.
Vec3 spinIn(const Link& link, const Scenario& scenario, const scenario::Joint& joint);

}  // namespace rigor::adapter
