// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motors and limits of Bullet's own joints: a cabin driven up its shaft, btSliderConstraint, and a rod on a
// btHingeConstraint whose motor turns it to its limit.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

constexpr double kMotorStep = 1.0 / 60;

/// The relaxation factor is set to 0, as in the adapter: at 1, Bullet's own, what hits a limit bounces.
TEST(PlainBullet, HingeMotor) {
    RigidBodyBase demo;
    btRigidBody& rod = demo.createRigidBody(2, btTransform(btQuaternion::getIdentity(), {0.5, 0, 0}),
                                            std::make_unique<btEmptyShape>(), {0.0012, 0.1673, 0.1673});
    const btVector3 z(0, 0, 1);
    btHingeConstraint pivot(btTypedConstraint::getFixedBody(), rod, {0, 0, 0}, {-0.5, 0, 0}, z, z, true);
    pivot.setLimit(-0.5235987755982988, 0.1, 0.9, 0.3, 0.0);
    pivot.enableAngularMotor(true, 1.5, 6.0 * kMotorStep);
    demo.world->addConstraint(&pivot);
    const Trajectory plain = demo.run(kMotorStep, 120);
    const Scenario scene = load("adapters/conformance/plain_programs/bullet/motor.json");
    EXPECT_GT(travel(plain, 0), 0.2);
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, kMotorStep, 120), kSameBits));
}

TEST(PlainBullet, SliderMotor) {
    RigidBodyBase demo;
    btRigidBody& cabin = demo.createRigidBody(4, btTransform(btQuaternion::getIdentity(), {0, 1, 0}),
                                              std::make_unique<btEmptyShape>(), {0.125, 0.125, 0.125});
    const btQuaternion xToY(btVector3(0, 0, 1), SIMD_HALF_PI);
    btSliderConstraint shaft(btTypedConstraint::getFixedBody(), cabin, btTransform(xToY, {0, 1, 0}),
                             btTransform(xToY, {0, 0, 0}), true);
    shaft.setLowerLinLimit(-0.1);
    shaft.setUpperLinLimit(1.2);
    shaft.setLowerAngLimit(0);
    shaft.setUpperAngLimit(0);
    shaft.setPoweredLinMotor(true);
    shaft.setTargetLinMotorVelocity(1);
    shaft.setMaxLinMotorForce(50);
    demo.world->addConstraint(&shaft);
    const Trajectory plain = demo.run(kMotorStep, 150);
    const Scenario scene =
        load("scenarios/library/3d/slider_motor.json", {"bodies.cabin.inertia=[0.125,0.125,0.125]"});
    EXPECT_GT(travel(plain, 0), 1.0);
    // The quarter turn from x to y is a sine and a cosine here, a half-way vector in the adapter.
    EXPECT_TRUE(same(plain, adapterRun("bullet:preset=default", scene, kMotorStep, 150),
                     {1e-12, 1e-12, 1e-12, 1e-12}));
}

}  // namespace
}  // namespace rigor::plain
