// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include <deque>
#include <vector>

#include "adapters/ode/joint_motion.hpp"

namespace rigor::ode {

/// A scenario's joint as one or several ODE joints, and the values that those need before each step. The ODE
/// objects belong to the world and go with it.
class OdeJoint {
  public:
    /// Makes a joint between bodies at their initial poses, for steps of dt, in a world whose ERP and CFM are
    /// set. `planar`: lifted from two dimensions. Throws adapter::Unsupported for features that ODE or this
    /// adapter does not have.
    OdeJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b, double dt,
             bool planar);
    OdeJoint(const OdeJoint&) = delete;
    OdeJoint& operator=(const OdeJoint&) = delete;

    /// Angles, axes and springs that depend on the poses. Must be called at the poses that the step starts
    /// from.
    void beforeStep();
    /// Detaches a joint whose mean force or torque over the last step was too large; true if it did.
    bool breakIfOverloaded();
    bool holds() const { return holds_; }

    /// Numbers that the next step depends on beyond the poses: angles counted over turns.
    std::vector<double> memory() const;
    void setMemory(const std::vector<double>& memory);

  private:
    struct Part {
        dJointID id = nullptr;   ///< null: at present none
        bool firstForce = true;  ///< true: f1 is the force on B (on A if B does not move); false: f2 is
        dJointFeedback feedback{};
    };
    /// One AMotor about one axis in user mode: stops (or a spring, which is two stops in one place) and
    /// motor.
    struct AngleMotor {
        dJointID id = nullptr;
        Angle kind = Angle::Turn;
        scenario::JointAxis axis;
        bool spring = false;
        double seen = 0.0;  ///< last angle, counted over turns
    };
    /// Kind of a row along the line of B's anchor.
    enum class PointRow { Holds, Stops, Drives, Springs };
    /// One row that acts at B's anchor: a contact joint, made anew before each step.
    struct PointJoint {
        Part* part = nullptr;
        int along = 0;  ///< axis of A, or kAlongLine
        scenario::JointAxis axis;
        PointRow does = PointRow::Holds;
    };
    static constexpr int kAlongLine = -1;  ///< direction from A's anchor to B's
    using SetParam = void (*)(dJointID, int, dReal);

    void build();
    void buildDistance();
    void buildHinge();
    void buildSlider();
    void buildWheel();
    void buildLeaningWheel();
    void buildSixDof();
    bool buildSixDofTravels();
    void add(dJointID id, bool firstForce = true);
    void addBall();
    void addFixed();
    void addTurn(const scenario::JointAxis& axis, Angle kind);
    void addAngleMotor(const scenario::JointAxis& axis, Angle kind, bool spring);
    void addPointRow(const scenario::JointAxis& axis, int along, PointRow does);
    void setStops(const scenario::JointAxis& axis, dJointID id, SetParam set);
    void setMotor(const scenario::JointAxis& axis, dJointID id, SetParam set);
    void setSpring(const scenario::JointAxis& axis, dJointID id, SetParam set);
    void softenSpring(const scenario::JointAxis& axis, dJointID id, SetParam set, int erp, int cfm);
    void update(AngleMotor& motor);
    void update(const PointJoint& row);
    bool stopAt(const Coordinate& now, const scenario::JointAxis& axis, dContact& contact) const;
    void driveAt(const Coordinate& now, const PointJoint& row, dContact& contact) const;
    dBodyID standIn(const JointEnd& end, const adapter::Vec3& at);

    dWorldID world_ = nullptr;
    scenario::Joint joint_;
    JointEnd a_, b_;
    double dt_ = 0.0;
    bool planar_ = false;
    JointMotion motion_;
    std::deque<Part> parts_;  ///< addresses are stable: ODE writes forces into them
    std::vector<AngleMotor> angleMotors_;
    std::vector<PointJoint> pointRows_;
    bool breaks_ = false, holds_ = true;
};

}  // namespace rigor::ode
