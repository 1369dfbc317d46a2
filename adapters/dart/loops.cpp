// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/loops.hpp"

#include <algorithm>
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>

#include "adapters/dart/swing.hpp"
#include "adapters/interface/unsupported.hpp"

namespace rigor::dart_adapter {

using dart::constraint::BallJointConstraint;
using dart::constraint::WeldJointConstraint;
using scenario::Joint;
using scenario::JointType;

namespace {

/// Distance of the two points that hold a hinge [m].
constexpr double kHingeArm = 0.1;

/// A constraint that remembers the impulse that DART's solver gives it: of a point a force, of a weld a torque and a force
/// at the body's centre of mass.
template <class Base, int kRows>
class Recorded final : public Base {
  public:
    using Base::Base;
    const Eigen::Matrix<double, 6, 1>& impulse() const { return impulse_; }

  private:
    void applyImpulse(double* lambda) override {
        impulse_.template tail<kRows>() = Eigen::Map<const Eigen::Matrix<double, kRows, 1>>(lambda);
        Base::applyImpulse(lambda);
    }
    Eigen::Matrix<double, 6, 1> impulse_ = Eigen::Matrix<double, 6, 1>::Zero();
};

using Point = Recorded<BallJointConstraint, 3>;
using Weld = Recorded<WeldJointConstraint, 6>;

}  // namespace

template <class Constraint, class... Arguments>
void LoopJoint::add(const Eigen::Vector3d& arm, Arguments&&... arguments) {
    const auto made = std::make_shared<Constraint>(std::forward<Arguments>(arguments)...);
    constraints_.push_back(made);
    parts_.push_back({&made->impulse(), arm});
}

LoopJoint::LoopJoint(const adapter::Scenario& scenario, int index, const adapter::Forest& forest,
                     std::span<dart::dynamics::BodyNode* const> bodies, bool planar)
    : joint_(index),
      canBreak_(adapter::canBreak(scenario.joints[index])),
      breakForce_(scenario.joints[index].breakForce),
      breakTorque_(scenario.joints[index].breakTorque) {
    const Joint& joint = scenario.joints[index];
    Joint bare = joint;
    if (hasSwingSpring(joint)) bare.axes[0] = {};
    if (!adapter::canCloseLoop(bare))
        throw adapter::notInLibrary(
            "dart",
            std::string("a ") + jointName(joint.type) + (canBreak_ ? " that breaks" : " that closes a loop"),
            "dart/constraint: BallJointConstraint and WeldJointConstraint", "joint '" + joint.name + "'");
    const auto isMovable = [&](int body) { return body != adapter::kNone && !forest.links[body].fixed; };
    const bool isB = isMovable(joint.bodyB);
    const int body = isB ? joint.bodyB : joint.bodyA, other = isB ? joint.bodyA : joint.bodyB;
    auto *one = bodies[body], *two = isMovable(other) ? bodies[other] : nullptr;

    const Pose pose = scenario.bodies[body].pose;
    const Vec3 anchor = pose * (isB ? joint.anchorB : joint.anchorA);
    const Vec3 axis = rotate(pose.orientation, isB ? joint.axisB : joint.axisA);
    // Impulses are given in the frame of the node.
    const Pose node = pose * forest.links[body].frame;
    if (joint.type == JointType::Fixed) {
        const Eigen::Vector3d arm = -toDart(inverse(node) * anchor);
        if (two != nullptr)
            add<Weld>(arm, one, two);
        else
            add<Weld>(arm, one);
        return;
    }
    const auto hold = [&](double along) {
        const Eigen::Vector3d at = toDart(anchor + along * axis);
        const Eigen::Vector3d arm = along * toDart(rotateInverse(node.orientation, axis));
        if (two != nullptr)
            add<Point>(arm, one, two, at);
        else
            add<Point>(arm, one, at);
    };
    hold(0.0);
    if (joint.type == JointType::Hinge && !planar) hold(kHingeArm);
}

bool LoopJoint::isOverloaded(double dt) const {
    if (!canBreak_) return false;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    for (const Part& part : parts_) {
        const Eigen::Vector3d linear = part.impulse->tail<3>();
        force += linear;
        torque += part.impulse->head<3>() + part.arm.cross(linear);
    }
    return force.norm() / dt > breakForce_ || torque.norm() / dt + springTorque_ > breakTorque_;
}

}  // namespace rigor::dart_adapter
