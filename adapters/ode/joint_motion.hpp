// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Coordinates of a scenario's joint at the present poses of its bodies: the values that the adapter sets in
// those of ODE's joints that do not measure by themselves (AMotor in user mode, contact joints), and what a
// spring swings.
#pragma once

#include <ode/ode.h>

#include <span>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::ode {

/// One end of a joint.
struct JointEnd {
    dBodyID body = nullptr;  ///< null for the world and for static bodies
    adapter::Pose pose;      ///< initial pose of the body frame; constant if `body` is null
    adapter::Vec3 com;       ///< centre of mass in the body frame [m]

    adapter::Pose now() const;     ///< pose of the body frame
    adapter::Vec3 center() const;  ///< centre of mass in the world [m]
    bool hasMass() const;          ///< true if forces move it: it is neither static nor kinematic
};

/// The rate of a coordinate: lin . (vB - vA) + angA . wA + angB . wB, of the centres of mass, world axes.
struct Rate {
    adapter::Vec3 lin, angA, angB;
};
struct Coordinate {
    double value = 0.0;  ///< [m] or [rad]
    Rate rate;
};

enum class Angle {
    Turn,   ///< angle about the joint's turning axis: hinge, wheel, six_dof in 2D
    Twist,  ///< angle about A's axis, of a wheel its pin, after the swing is taken back, see
            ///< scenarios/FORMAT.md
    Cone,   ///< angle between the axes of A and B, >= 0
    SwingY,
    SwingZ  ///< components of the swing vector along A's normals
};

/// Coordinates and held directions of one joint. All angles are zero at the initial poses.
class JointMotion {
  public:
    JointMotion(const scenario::Joint& joint, const JointEnd& a, const JointEnd& b);

    void update();                       ///< takes the poses of the bodies as they are now
    Coordinate travel(int k) const;      ///< displacement of B's anchor along A's axis (0) and its normals
                                         ///< (1, 2)
    Coordinate length() const;           ///< distance of the anchors
    Coordinate angle(Angle kind) const;  ///< Turn and Twist in (-pi, pi]
    adapter::Vec3 axis(int k) const { return axes_[k]; }    ///< A's axis and normals, world
    adapter::Vec3 turningAxis() const { return turning_; }  ///< axis of Angle::Turn, fixed in A, world
    adapter::Vec3 anchorA() const { return anchorA_; }      ///< world [m]
    adapter::Vec3 anchorB() const { return anchorB_; }
    adapter::Vec3 centerA() const { return centerA_; }  ///< centre of mass, world [m]
    adapter::Vec3 centerB() const { return centerB_; }

  private:
    Coordinate point(const adapter::Vec3& direction) const;
    static Rate turning(const adapter::Vec3& about) { return {{}, -about, about}; }

    scenario::Joint joint_;
    JointEnd a_, b_;
    adapter::Vec3 localAxes_[3], localTurnAxes_[3], localTurning_, localTurningNormal_;  ///< axes in A
    adapter::Vec3 axisInB_, normalInB_, turningNormalInB_;  ///< the same at the start, in B
    adapter::Vec3 axes_[3], turnAxes_[3], turning_, turningNormal_, axisOfB_, normalOfB_, turningNormalOfB_;
    adapter::Vec3 anchorA_, anchorB_, centerA_, centerB_;
};

/// ERP and CFM of the implicit spring of stiffness k and damping c over steps of dt: h k/(h k + c) and
/// 1/(h k + c) (ODE manual, "How to use ERP and CFM").
struct SpringTerms {
    double erp = 0.0, cfm = 0.0;
};
SpringTerms springTerms(const scenario::JointAxis& axis, double dt);

}  // namespace rigor::ode
