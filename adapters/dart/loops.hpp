// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints beside the trees: those that close loops, and those that can break.
#pragma once

#include <dart/constraint/ConstraintBase.hpp>
#include <dart/constraint/SmartPointer.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <span>
#include <vector>

#include "adapters/dart/convert.hpp"
#include "adapters/interface/joint_trees.hpp"

namespace rigor::dart_adapter {

/// A joint as constraints of DART: a ball is a point, a fixed joint a weld, a hinge two points on its axis.
class LoopJoint {
  public:
    /// `bodies` are the nodes by scenario body, which stand at their initial poses. Throws Unsupported for other joints.
    LoopJoint(const adapter::Scenario& scenario, int joint, const adapter::Forest& forest,
              std::span<dart::dynamics::BodyNode* const> bodies, bool planar);

    int joint() const { return joint_; }
    bool holds() const { return holds_; }
    void setHolds(bool holds) { holds_ = holds; }
    const std::vector<dart::constraint::ConstraintBasePtr>& constraints() const { return constraints_; }

    /// Torque of a swing's spring in the step, which is all of a ball's [N m].
    void setSpringTorque(double torque) { springTorque_ = torque; }
    /// True where the joint bore more in the last step than its strength.
    bool isOverloaded(double dt) const;

  private:
    /// One constraint with its impulse of the last step.
    struct Part {
        /// Torque, and force at a point, in the axes of the first body; the constraint holds it.
        const Eigen::Matrix<double, 6, 1>* impulse;
        Eigen::Vector3d arm;  ///< way from the anchor to where the impulse acts, axes of the body [m]
    };
    template <class Constraint, class... Arguments>
    void add(const Eigen::Vector3d& arm, Arguments&&... arguments);

    int joint_ = 0;
    bool canBreak_;
    double breakForce_, breakTorque_;
    double springTorque_ = 0.0;
    bool holds_ = true;
    std::vector<dart::constraint::ConstraintBasePtr> constraints_;
    std::vector<Part> parts_;
};

}  // namespace rigor::dart_adapter
