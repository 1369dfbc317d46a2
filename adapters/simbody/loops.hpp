// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints beside the trees: those that close loops, those that can break, and rods.
#pragma once

#include <vector>

#include "adapters/simbody/convert.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::simbody {

/// A body of the scenario as one of Simbody's: the pose of the scenario's body frame in the frame of Simbody's body.
struct Frame {
    SimTK::MobilizedBody body;
    Pose pose;
};

/// A joint as constraints of Simbody.
class LoopJoint {
  public:
    /// `a` and `b` are the joint's two sides; `relative` turns from B's frame to A's at the initial poses. Throws
    /// Unsupported for joints with more than their kind.
    LoopJoint(const scenario::Joint& joint, int index, const Frame& a, const Frame& b, const Quat& relative,
              bool planar);

    int joint() const { return joint_; }

    /// Leaves out the constraints that no coordinate can violate, near this state: two hinges on one axis. Where all
    /// are such, Simbody's solution is not a number.
    void dropIdle(const SimTK::MultibodySystem& system, SimTK::State& state);
    bool holds(const SimTK::State& state) const;
    void setHolds(SimTK::State& state, bool holds) const;

    /// True where the joint bears more than its strength. The state must have accelerations.
    bool isOverloaded(const SimTK::State& state) const;

  private:
    void keepPoints(bool planar);
    void keepTurn(const Quat& relative, bool planar);
    void keepAxis(const Vec3& axisA, const Vec3& axisB);
    void keepOnLine(const Vec3& axisA, bool planar);
    template <class Constraint, class... Arguments>
    void add(Arguments&&... arguments);

    static bool isIdle(const SimTK::Constraint& part, const SimTK::State& state);

    int joint_ = 0;
    double breakForce_, breakTorque_;
    SimTK::MobilizedBody a_, b_;
    Vec3 anchorA_, anchorB_;  ///< frames of Simbody's bodies
    std::vector<SimTK::Constraint> parts_;
};

}  // namespace rigor::simbody
