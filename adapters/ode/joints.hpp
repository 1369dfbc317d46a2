// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <ode/ode.h>

#include <deque>
#include <functional>
#include <vector>

#include "adapters/ode/joint_motion.hpp"

namespace rigor::ode {

/// A scenario's joint as one or several ODE joints, and what those have to be told before each step. The ODE
/// objects belong to the world and go with it.
class OdeJoint {
  public:
    /// Between bodies at their initial poses, for steps of dt, in a world whose ERP and CFM are set.
    /// `planar`: lifted from two dimensions. Throws adapter::Unsupported for what ODE or this adapter does
    /// not have.
    OdeJoint(dWorldID world, const scenario::Joint& joint, const JointEnd& a, const JointEnd& b, double dt,
             bool planar);
    OdeJoint(const OdeJoint&) = delete;
    OdeJoint& operator=(const OdeJoint&) = delete;

    /// Angles, axes and springs that depend on the poses. To be called at the poses that the step starts
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
        bool firstForce = true;  ///< whether f1 is the force on B (on A where B does not move), else f2
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
    /// One LMotor along one axis of A that holds a coordinate, springs it or drives it.
    struct TravelMotor {
        dJointID id = nullptr;
        int along = 0;
        scenario::JointAxis axis;
    };
    using SetParam = void (*)(dJointID, int, dReal);
    using Current = std::function<Coordinate(const JointMotion&)>;
    /// A spring whose stiffness and damping follow from its frequency and what it moves at the moment.
    struct PosedSpring {
        dJointID id = nullptr;
        SetParam set = nullptr;
        int erp = 0, cfm = 0;  ///< ODE's parameter numbers
        scenario::JointAxis axis;
        Current coordinate;
    };

    void build(bool planar);
    void buildDistance();
    void updateLengthStop();
    void buildHinge();
    void buildSlider();
    void buildWheel();
    void buildSixDof(bool planar);
    bool buildSixDofTravels();
    void add(dJointID id, bool firstForce = true);
    void addBall();
    void addFixed();
    void addTurn(const scenario::JointAxis& axis, Angle kind);
    void addAngleMotor(const scenario::JointAxis& axis, Angle kind, bool spring);
    void addTravelMotor(const scenario::JointAxis& axis, int along);
    void setStops(const scenario::JointAxis& axis, dJointID id, SetParam set);
    void setMotor(const scenario::JointAxis& axis, dJointID id, SetParam set);
    void setSpring(const scenario::JointAxis& axis, dJointID id, SetParam set, Current coordinate);
    void softenSpring(const scenario::JointAxis& axis, dJointID id, SetParam set, int erp, int cfm,
                      Current coordinate);
    void update(AngleMotor& motor);
    void update(const TravelMotor& motor);
    dBodyID standIn(const JointEnd& end, const adapter::Vec3& at);
    [[noreturn]] void refuse(const std::string& what) const;

    dWorldID world_ = nullptr;
    scenario::Joint joint_;
    JointEnd a_, b_;
    double dt_ = 0.0;
    JointMotion motion_;
    std::deque<Part> parts_;      ///< addresses are stable: ODE writes forces into them
    Part* lengthStop_ = nullptr;  ///< of a rope: there while it is taut
    std::vector<AngleMotor> angleMotors_;
    std::vector<TravelMotor> travelMotors_;
    std::vector<PosedSpring> springs_;
    bool breaks_ = false, holds_ = true;
};

}  // namespace rigor::ode
