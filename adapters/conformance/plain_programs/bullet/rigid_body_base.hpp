// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Common part of Bullet's own examples: an empty world as it ships, bodies by mass, pose and shape. No
// adapter code and no scenario; numbers are those of the scene's program.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

class RigidBodyBase {
  public:
    RigidBodyBase() {
        configuration_ = std::make_unique<btDefaultCollisionConfiguration>();
        dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
        broadphase_ = std::make_unique<btDbvtBroadphase>();
        solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
        world = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), broadphase_.get(), solver_.get(),
                                                          configuration_.get());
        world->setGravity(btVector3(0, -9.81, 0));
    }
    ~RigidBodyBase() {
        for (int i = world->getNumConstraints() - 1; i >= 0; --i)
            world->removeConstraint(world->getConstraint(i));
        for (auto& body : bodies) world->removeRigidBody(body.get());
    }

    /// Takes the shape; mass 0 is static.
    btRigidBody& createRigidBody(btScalar mass, const btTransform& pose,
                                 std::unique_ptr<btCollisionShape> shape) {
        btVector3 inertia(0, 0, 0);
        if (mass != 0) shape->calculateLocalInertia(mass, inertia);
        return createRigidBody(mass, pose, std::move(shape), inertia);
    }
    btRigidBody& createRigidBody(btScalar mass, const btTransform& pose,
                                 std::unique_ptr<btCollisionShape> shape, const btVector3& inertia) {
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        info.m_startWorldTransform = pose;
        shapes_.push_back(std::move(shape));
        bodies.push_back(std::make_unique<btRigidBody>(info));
        world->addRigidBody(bodies.back().get());
        return *bodies.back();
    }
    btRigidBody& createRigidBody(btScalar mass, const btVector3& position,
                                 std::unique_ptr<btCollisionShape> shape) {
        return createRigidBody(mass, btTransform(btQuaternion::getIdentity(), position), std::move(shape));
    }

    /// One state of every body, in the order of creation.
    std::vector<BodyState> states() const {
        std::vector<BodyState> all;
        for (const auto& body : bodies) {
            const btTransform& pose = body->getWorldTransform();
            const btQuaternion q = pose.getRotation();
            const btVector3 &v = body->getLinearVelocity(), &w = body->getAngularVelocity();
            all.push_back({vector(pose.getOrigin()), {q.w(), q.x(), q.y(), q.z()}, vector(v), vector(w)});
        }
        return all;
    }
    /// Steps of exactly dt each.
    Trajectory run(btScalar dt, int steps) {
        Trajectory trajectory{states()};
        for (int i = 0; i < steps; ++i) {
            world->stepSimulation(dt, 0);
            trajectory.push_back(states());
        }
        return trajectory;
    }

    std::vector<std::unique_ptr<btRigidBody>> bodies;

  private:
    static Vec3 vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
    std::unique_ptr<btCollisionDispatcher> dispatcher_;
    std::unique_ptr<btDbvtBroadphase> broadphase_;
    std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;

  public:
    std::unique_ptr<btDiscreteDynamicsWorld> world;
};

/// Equal bits, but for the rounding with which a rotation matrix becomes a unit quaternion.
inline constexpr Bounds kSameBits{0.0, 4e-16, 0.0, 0.0};

}  // namespace rigor::plain
