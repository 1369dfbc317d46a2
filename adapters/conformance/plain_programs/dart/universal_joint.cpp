// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A universal joint (hooke_joint): a driven shaft, a cross and an output shaft in one tree, and the output's bearing as two
// points that are held in the world. Six rows hold two coordinates, so that four of them follow from the others.
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <memory>

#include "adapters/conformance/plain_programs/dart/loop.hpp"

namespace rigor::plain {
namespace {

using namespace dart::dynamics;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The input turns about x with 4 rad/s, and the output about a line at 35 degrees to it. `frame` is the frame of the
/// output's node, seen from one whose x runs along that shaft: it changes the numbers of the problem, not the motion.
class Shafts {
  public:
    Shafts(double step, const Matrix3d& frame) : loop_(step, {0, -9.81, 0}) {
        const double bend = 35.0 * EIGEN_PI / 180.0;
        const Eigen::AngleAxisd turn(bend, Vector3d::UnitZ());

        RevoluteJoint::Properties joint;
        BodyNode::Properties body;
        joint.mName = body.mName = "input";
        joint.mAxis = Vector3d::UnitX();
        joint.mActuatorType = Joint::VELOCITY;
        BodyNode* input = add(nullptr, joint, body);

        joint = {};
        joint.mName = body.mName = "cross";
        joint.mAxis = Vector3d::UnitZ();
        body.mInertia = boxInertia(0.5, {0.08, 0.2, 0.2});
        BodyNode* cross = add(input, joint, body);

        joint.mName = body.mName = "output";
        joint.mAxis = frame.transpose() * Vector3d::UnitY();
        joint.mT_ParentBodyToJoint.linear() = turn * frame;
        joint.mT_ChildBodyToJoint.translation() = frame.transpose() * Vector3d(-0.5, 0, 0);
        body.mInertia = boxInertia(2.0, (frame.transpose() * Vector3d(0.8, 0.12, 0.12)).cwiseAbs());
        output_ = add(cross, joint, body);

        skeleton_->setVelocities(Vector3d(4.0, 0.0, 4.0 * std::sin(bend)));
        loop_.world->addSkeleton(skeleton_);
        const Vector3d along = turn * Vector3d::UnitX();
        middle_ = 0.5 * along;
        for (const double at : {0.5, 0.6})
            loop_.world->getConstraintSolver()->addConstraint(
                std::make_shared<dart::constraint::BallJointConstraint>(output_, Vector3d(at * along)));
    }

    /// Projected Gauss-Seidel alone, in place of Dantzig's method with that as its reserve.
    void useSweeps() {
        auto* solver =
            dynamic_cast<dart::constraint::BoxedLcpConstraintSolver*>(loop_.world->getConstraintSolver());
        solver->setBoxedLcpSolver(std::make_shared<dart::constraint::PgsBoxedLcpSolver>());
        solver->setSecondaryBoxedLcpSolver(nullptr);
    }

    /// Whether the middle of the output stays within a decimetre of its bearing for two seconds.
    bool hold() {
        for (int i = 0; i < 2.0 / loop_.world->getTimeStep(); ++i) {
            skeleton_->setCommand(0, 4.0);
            loop_.world->step();
            if (!((output_->getWorldTransform().translation() - middle_).norm() < 0.1)) return false;
        }
        return true;
    }

  private:
    BodyNode* add(BodyNode* parent, const RevoluteJoint::Properties& joint,
                  const BodyNode::Properties& body) {
        return skeleton_->createJointAndBodyNodePair<RevoluteJoint>(parent, joint, body).second;
    }

    Loop loop_;
    SkeletonPtr skeleton_ = Skeleton::create("shafts");
    BodyNode* output_ = nullptr;
    Vector3d middle_;
};

TEST(PlainDart, DantzigsMethodLosesAUniversalJointInSomeFramesOfItsShaft) {
    const Matrix3d along = Matrix3d::Identity();
    const Matrix3d across = Eigen::AngleAxisd(0.5 * EIGEN_PI, Vector3d::UnitZ()).toRotationMatrix();
    for (const double step : {1.0 / 60, 1.0 / 240, 1.0 / 960}) {
        EXPECT_TRUE(Shafts(step, along).hold()) << step;
        EXPECT_FALSE(Shafts(step, across).hold()) << step;
        for (const Matrix3d& frame : {along, across}) {
            Shafts swept(step, frame);
            swept.useSweeps();
            EXPECT_TRUE(swept.hold()) << step;
        }
    }
}

}  // namespace
}  // namespace rigor::plain
