// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Push: a block on a floor that sticks, pushed by a force and a torque in Bullet alone (the block `low` of
// tipping_push). The friction of a step uses the force that was applied, not the torque: the base creeps at
// torque dt / I times its distance from the centre of mass. Given as a change of the angular velocity before
// the step, the same torque is seen and the base stays.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

constexpr double kPushStep = 1.0 / 60, kForce = 10.46727, kTorque = 2.093454, kHeight = 0.5;
constexpr double kMoment = 2.0 / 3 * (0.04 + 0.25);

/// Mean speed of the base over the second half of a second [m/s].
double creep(bool torqueAsVelocity, int directions) {
    RigidBodyBase demo;
    demo.world->getSolverInfo().m_numIterations = 1000;
    if (directions == 2) demo.world->getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    demo.createRigidBody(0, {0, -0.5, 0}, std::make_unique<btBoxShape>(btVector3(20, 0.5, 20)));
    const btVector3 moments(btScalar(kMoment), btScalar(0.06), btScalar(kMoment));
    btRigidBody& block =
        demo.createRigidBody(2, btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(kHeight), 0)),
                             std::make_unique<btBoxShape>(btVector3(0.2, 0.5, 0.2)), moments);
    demo.bodies[0]->setFriction(0.55);
    block.setFriction(1.0);
    block.setActivationState(DISABLE_DEACTIVATION);
    const auto base = [&] { return (block.getWorldTransform() * btVector3(0, -kHeight, 0)).x(); };
    double half = 0.0;
    for (int i = 0; i < 60; ++i) {
        if (i == 30) half = base();
        block.applyCentralForce(btVector3(kForce, 0, 0));
        if (torqueAsVelocity)
            block.setAngularVelocity(block.getAngularVelocity() +
                                     btVector3(0, 0, kTorque / kMoment * kPushStep));
        else
            block.applyTorque(btVector3(0, 0, kTorque));
        demo.world->stepSimulation(kPushStep, 0);
    }
    return (base() - half) / 0.5;
}

TEST(PlainBullet, FrictionDoesNotSeeAnAppliedTorque) {
    for (const int directions : {1, 2}) {
        SCOPED_TRACE(directions);
        const double expected = kTorque * kPushStep / kMoment * kHeight;
        EXPECT_NEAR(std::abs(creep(false, directions)), expected, 1e-3 * expected);
        EXPECT_LT(std::abs(creep(true, directions)), 0.02 * expected);
    }
}

}  // namespace
}  // namespace rigor::plain
