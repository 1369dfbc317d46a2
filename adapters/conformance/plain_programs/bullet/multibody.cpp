// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Multibody: the scene of joint.cpp as links of a btMultiBody, and two balls on a hinge with a spring that
// fall on a plane; Bullet as it ships, in the calls of its MultiDofDemo.
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointFeedback.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

const btQuaternion kStraight = btQuaternion::getIdentity();
const btVector3 kZ(0, 0, 1);

class MultiDofDemo {
  public:
    MultiDofDemo() : world(&dispatcher_, &broadphase_, &solver_, &configuration_) {
        world.setGravity(btVector3(0, -9.81, 0));
    }
    ~MultiDofDemo() {
        for (auto& collider : colliders_) world.removeCollisionObject(collider.get());
        if (body != nullptr) world.removeMultiBody(body.get());
    }
    btMultiBody& create(int links, btScalar mass, const btVector3& inertia) {
        body = std::make_unique<btMultiBody>(links, mass, inertia, mass == 0, true);
        return *body;
    }
    void finish() {
        body->finalizeMultiDof();
        world.addMultiBody(body.get());
    }
    void addCollider(int link, btCollisionShape& shape, const btVector3& position) {
        auto collider = std::make_unique<btMultiBodyLinkCollider>(body.get(), link);
        collider->setCollisionShape(&shape);
        collider->setWorldTransform(btTransform(kStraight, position));
        collider->setFriction(0.5);
        collider->setRestitution(0.5);
        (link < 0 ? body->setBaseCollider(collider.get())
                  : void(body->getLink(link).m_collider = collider.get()));
        world.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter,
                                 btBroadphaseProxy::AllFilter);
        colliders_.push_back(std::move(collider));
    }
    /// Base (where it moves) and links.
    std::vector<BodyState> states() {
        btAlignedObjectArray<btQuaternion> rotations;
        btAlignedObjectArray<btVector3> origins;
        body->forwardKinematics(rotations, origins);
        const int links = body->getNumLinks();
        std::vector<btVector3> turns(static_cast<std::size_t>(links) + 1), velocities(turns.size());
        body->compTreeLinkVelocities(turns.data(), velocities.data());
        std::vector<BodyState> all;
        const auto vector = [](const btVector3& v) { return Vec3{v.x(), v.y(), v.z()}; };
        for (int i = body->hasFixedBase() ? 0 : -1; i < links; ++i) {
            const btTransform pose =
                i < 0 ? body->getBaseWorldTransform() : body->getLink(i).m_cachedWorldTransform;
            const btQuaternion q = pose.getRotation();
            const auto slot = static_cast<std::size_t>(i + 1);
            all.push_back({vector(pose.getOrigin()),
                           {q.w(), q.x(), q.y(), q.z()},
                           vector(pose.getBasis() * velocities[slot]),
                           vector(pose.getBasis() * turns[slot])});
        }
        return all;
    }

    std::unique_ptr<btMultiBody> body;

  private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btMultiBodyConstraintSolver solver_;
    std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;

  public:
    btMultiBodyDynamicsWorld world;
};

/// Trajectory without the static body that the scenario has first.
Trajectory moving(Trajectory all) {
    for (auto& states : all) states.erase(states.begin());
    return all;
}

TEST(PlainBullet, MultibodyJoint) {
    MultiDofDemo demo;
    const btVector3 none(0, 0, 0), half(1, 0, 0);
    btMultiBody& arm = demo.create(3, 0, none);
    arm.setupRevolute(0, 6, {1, 1, 1}, -1, kStraight, kZ, none, half);
    arm.setupRevolute(1, 6, {1, 1, 1}, 0, kStraight, kZ, half, half);
    arm.setupSpherical(2, 3, {0.5, 1.5, 1}, 1, kStraight, half, half);
    demo.finish();
    const btScalar turn[] = {1, 0.5, 0};
    arm.setJointVelMultiDof(2, turn);
    Trajectory plain{demo.states()};
    for (int i = 0; i < 180; ++i) {
        demo.world.stepSimulation(1.0 / 60, 0);
        plain.push_back(demo.states());
    }
    EXPECT_GT(travel(plain, 2), 3.0);
    const Scenario scene = load("adapters/conformance/plain_programs/bullet/joint.json");
    const auto adapter = [&](const std::string& more) {
        return moving(
            adapterRun("bullet:preset=default,articulation=multibody" + more, scene, 1.0 / 60, 180));
    };
    EXPECT_TRUE(same(plain, adapter(""), kSameBits));
    EXPECT_FALSE(same(plain, adapter(",multibody_damping=0.039"), kSameBits));
}

TEST(PlainBullet, MultibodyContactAndSpring) {
    MultiDofDemo demo;
    btSphereShape ball(0.5);
    btStaticPlaneShape plane({0, 1, 0}, 0);
    btRigidBody floor(0, nullptr, &plane);
    floor.setFriction(0.5);
    floor.setRestitution(1.0);
    demo.world.addRigidBody(&floor);
    btMultiBody& balls = demo.create(1, 2, {0.2, 0.2, 0.2});
    balls.setBaseWorldTransform(btTransform(kStraight, {-0.75, 1, 0}));
    balls.setupRevolute(0, 1, {0.1, 0.1, 0.1}, -1, kStraight, kZ, {0.75, 0, 0}, {0.75, 0, 0});
    demo.finish();
    balls.setBaseVel({1, 0, 0.5});
    demo.addCollider(-1, ball, {-0.75, 1, 0});
    demo.addCollider(0, ball, {0.75, 1, 0});
    Trajectory plain{demo.states()};
    for (int i = 0; i < 180; ++i) {
        balls.addJointTorque(0, -(20 * (balls.getJointPos(0) - 0.5) + 0.5 * balls.getJointVel(0)));
        demo.world.stepSimulation(1.0 / 60, 0);
        plain.push_back(demo.states());
    }
    demo.world.removeRigidBody(&floor);
    EXPECT_GT(travel(plain, 1), 1.0);
    const Scenario scene = load("adapters/conformance/plain_programs/bullet/multibody.json");
    const Trajectory adapter =
        moving(adapterRun("bullet:preset=default,articulation=multibody", scene, 1.0 / 60, 180));
    EXPECT_TRUE(same(plain, adapter, kSameBits));
}

/// Reason why the adapter does not break joints of btMultiBody by their feedback: for a link of 1 kg that
/// turns at w about a hinge 0.5 m away it reports the force of the joint with its centrifugal part w^2 r
/// twice.
TEST(PlainBullet, MultibodyFeedbackHasTheCentrifugalForceTwice) {
    for (const btScalar w : {0.0, 1.0, 4.0}) {
        MultiDofDemo demo;
        demo.world.getSolverInfo().m_jointFeedbackInWorldSpace = true;
        demo.world.getSolverInfo().m_jointFeedbackInJointFrame = false;
        btMultiBody& rod = demo.create(1, 0, {0, 0, 0});
        rod.setupRevolute(0, 1, {0.1, 0.1, 0.1}, -1, kStraight, kZ, {0, 0, 0}, {0.5, 0, 0});
        demo.finish();
        rod.setLinearDamping(0);
        rod.setAngularDamping(0);
        rod.setJointVel(0, w);
        btMultiBodyJointFeedback feedback;
        rod.getLink(0).m_jointFeedback = &feedback;
        demo.world.stepSimulation(1e-4, 0);
        const btScalar acceleration = -9.81 * 0.5 / (0.1 + 0.25);
        EXPECT_NEAR(feedback.m_reactionForces.m_topVec.x(), -2 * w * w * 0.5, 0.01) << "once would be right";
        EXPECT_NEAR(feedback.m_reactionForces.m_topVec.y(), 0.5 * acceleration + 9.81, 0.01);
    }
}

}  // namespace
}  // namespace rigor::plain
