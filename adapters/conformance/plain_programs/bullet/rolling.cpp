// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rolling: a ball under rolling and spinning friction, in Bullet alone. The coefficients of a contact point are lengths:
// each bounds a moment by itself times the normal impulse of the step, but by no more than itself times 1 N s. So a
// ball of m g dt > 1 N s slows down 1/(m g dt) times as much as one that is lighter. Spinning friction acts only where
// there is rolling friction, however little.
#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

constexpr double kRollStep = 1.0 / 240, kBallRadius = 0.1, kSlidingFriction = 0.5;
double rollingFriction = 0, spinningFriction = 0;  ///< every contact point has these [m]

bool setCoefficients(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                     const btCollisionObjectWrapper*, int, int) {
    point.m_combinedFriction = btScalar(kSlidingFriction);
    point.m_combinedRollingFriction = btScalar(rollingFriction);
    point.m_combinedSpinningFriction = btScalar(spinningFriction);
    return true;
}

class Rolling : public RigidBodyBase {
  public:
    Rolling(double mass, double rolling, double spinning) {
        gContactAddedCallback = setCoefficients;
        rollingFriction = rolling;
        spinningFriction = spinning;
        createRigidBody(0, {0, -1, 0}, std::make_unique<btBoxShape>(btVector3(20, 1, 20)));
        createRigidBody(btScalar(mass), {0, btScalar(kBallRadius), 0},
                        std::make_unique<btSphereShape>(btScalar(kBallRadius)));
        for (auto& body : bodies)
            body->setCollisionFlags(body->getCollisionFlags() |
                                    btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
        world->getSolverInfo().m_numIterations = 200;
    }
    ~Rolling() { gContactAddedCallback = nullptr; }
    btRigidBody& ball() { return *bodies[1]; }
};

/// Deceleration over that by the law, v' = -rho g/r / (1 + 2/5).
double slowing(double mass) {
    const double rho = 0.006;
    Rolling scene(mass, rho, 0);
    scene.ball().setLinearVelocity({1, 0, 0});
    scene.ball().setAngularVelocity({0, 0, btScalar(-1 / kBallRadius)});
    scene.run(btScalar(kRollStep), 60);
    return (1 - scene.ball().getLinearVelocity().x()) / 0.25 / (rho * 9.81 / kBallRadius / 1.4);
}

TEST(PlainBullet, RollingFrictionEndsAtAnImpulseOfOneNewtonSecond) {
    for (const double mass : {0.5, 2.0, 24.0}) EXPECT_NEAR(slowing(mass), 1, 1e-3) << mass;
    for (const double mass : {25.0, 60.0, 240.0})
        EXPECT_NEAR(slowing(mass), 1 / (mass * 9.81 * kRollStep), 1e-3) << mass;
}

TEST(PlainBullet, SpinningFrictionNeedsRollingFriction) {
    const double rho = 0.003, expected = 0.25 * rho * 9.81 / (0.4 * kBallRadius * kBallRadius);
    for (const double rolling : {0.0, 1e-12, 0.006}) {
        Rolling scene(2, rolling, rho);
        scene.ball().setAngularVelocity({0, 3, 0});
        scene.run(btScalar(kRollStep), 60);
        EXPECT_NEAR(3 - scene.ball().getAngularVelocity().y(), rolling > 0 ? expected : 0, 1e-3) << rolling;
    }
}

}  // namespace
}  // namespace rigor::plain
