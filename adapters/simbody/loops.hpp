// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints beside the trees: those that close loops, those that can break, and distances.
#pragma once

#include <vector>

#include "adapters/simbody/motors.hpp"

namespace rigor::simbody {

/// A joint as constraints of Simbody, with the forces of its springs and motors.
class LoopJoint {
  public:
    LoopJoint(const Sides& sides, int index, SimTK::SimbodyMatterSubsystem& matter);

    int joint() const { return joint_; }
    /// A spring or motor along one of the joint's coordinates acts as long as the joint holds.
    void add(Acting acting) { acting_.push_back(std::move(acting)); }

    /// Leaves out the constraints that no coordinate can violate, near this state: two hinges on one axis. Where all
    /// are such, Simbody's solution is not a number.
    void dropIdle(const SimTK::MultibodySystem& system, SimTK::State& state);
    bool holds(const SimTK::State& state) const;
    void setHolds(SimTK::State& state, bool holds) const;

    /// True where the joint bears more than its strength. The state must have accelerations.
    bool isOverloaded(const SimTK::State& state) const;

  private:
    void keepSixDof(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter);
    void keepWheel(const Sides& sides);
    void keepCone(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter);
    void keepPoints(bool planar);
    void keepTurn(const Sides& sides);
    void keepAxis(const Vec3& axisA, const Vec3& axisB);
    void keepInPlane(const Vec3& normal);
    void keepOnLine(const Vec3& axisA, bool planar);
    template <class Constraint, class... Arguments>
    void add(Arguments&&... arguments);

    static bool isIdle(const SimTK::Constraint& part, const SimTK::State& state);

    int joint_ = 0;
    double breakForce_, breakTorque_;
    SimTK::MobilizedBody a_, b_;
    Vec3 anchorA_, anchorB_;  ///< frames of Simbody's bodies
    std::vector<SimTK::Constraint> parts_;
    std::vector<Acting> acting_;
};

/// Constraints of the angles that a six_dof or cone_twist locks where not all are locked, nor all but one.
std::vector<SimTK::Constraint> keepAngles(const Sides& sides, SimTK::SimbodyMatterSubsystem& matter);

}  // namespace rigor::simbody
