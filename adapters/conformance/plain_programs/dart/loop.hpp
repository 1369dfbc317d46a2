// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Code of every DART program here around its scene: a world as the tutorials build it, and the bodies' states after each
// step. Contacts are found and their coefficients combined by DART alone.
#pragma once

#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

inline dart::dynamics::Inertia inertia(double mass, const Eigen::Vector3d& moments) {
    return {mass, Eigen::Vector3d::Zero(), Eigen::Matrix3d(moments.asDiagonal())};
}
/// Inertia of a solid box with these sides.
inline dart::dynamics::Inertia boxInertia(double mass, const Eigen::Vector3d& s) {
    const Eigen::Vector3d q = s.cwiseProduct(s);
    return inertia(mass, mass / 12.0 * Eigen::Vector3d(q.y() + q.z(), q.x() + q.z(), q.x() + q.y()));
}

class Loop {
  public:
    Loop(double dt, const Eigen::Vector3d& gravity) {
        world->setTimeStep(dt);
        world->setGravity(gravity);
    }

    /// A free body; mass 0: one that stands still.
    dart::dynamics::BodyNode* add(const dart::dynamics::Inertia* of, const Eigen::Vector3d& at,
                                  const dart::dynamics::ShapePtr& shape = nullptr, double friction = 1.0,
                                  double restitution = 0.0) {
        using namespace dart::dynamics;
        const auto skeleton = Skeleton::create("body" + std::to_string(bodies.size()));
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.translation() = at;
        BodyNode* body = nullptr;
        if (of == nullptr) {
            const auto made = skeleton->createJointAndBodyNodePair<WeldJoint>();
            made.first->setTransformFromParentBodyNode(pose);
            skeleton->setMobile(false);
            body = made.second;
        } else {
            const auto made = skeleton->createJointAndBodyNodePair<FreeJoint>();
            made.second->setInertia(*of);
            made.first->setTransform(pose);
            body = made.second;
        }
        if (shape != nullptr) {
            auto* node = body->createShapeNodeWith<CollisionAspect, DynamicsAspect>(shape);
            node->getDynamicsAspect()->setFrictionCoeff(friction);
            node->getDynamicsAspect()->setRestitutionCoeff(restitution);
        }
        world->addSkeleton(skeleton);
        bodies.push_back(body);
        return body;
    }

    Trajectory run(int steps) const {
        Trajectory trajectory{states()};
        for (int i = 0; i < steps; ++i) {
            world->step();
            trajectory.push_back(states());
        }
        return trajectory;
    }

    dart::simulation::WorldPtr world = dart::simulation::World::create();
    std::vector<dart::dynamics::BodyNode*> bodies;

  private:
    std::vector<BodyState> states() const {
        const auto vec = [](const Eigen::Vector3d& v) { return Vec3{v.x(), v.y(), v.z()}; };
        std::vector<BodyState> all;
        for (const auto* body : bodies) {
            const Eigen::Isometry3d pose = body->getWorldTransform();
            const Eigen::Quaterniond q(pose.linear());
            all.push_back({vec(pose.translation()),
                           {q.w(), q.x(), q.y(), q.z()},
                           vec(body->getLinearVelocity()),
                           vec(body->getAngularVelocity())});
        }
        return all;
    }
};

}  // namespace rigor::plain
