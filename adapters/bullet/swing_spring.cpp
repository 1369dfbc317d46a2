// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/swing_spring.hpp"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>

namespace rigor::bullet {
namespace {

/// Angle below which the direction of a swing is rounding [rad].
constexpr btScalar kSmallSwing = sizeof(btScalar) == 8 ? btScalar(1e-8) : btScalar(1e-4);

}  // namespace

void SwingSpring::update() const {
    const btTransform poseA = joint->getRigidBodyA().getCenterOfMassTransform();
    const btTransform poseB = joint->getRigidBodyB().getCenterOfMassTransform();
    const btVector3 x = poseA.getBasis() * axisA, b = poseB.getBasis() * axisB, normal = x.cross(b);
    const btScalar sine = normal.length(), phi = std::atan2(sine, x.dot(b));
    const btVector3 n = sine > kSmallSwing ? normal / sine : poseA.getBasis() * normalA;
    const btVector3 z = n.cross(x);
    const btMatrix3x3 atZero(n.x(), x.x(), z.x(), n.y(), x.y(), z.y(), n.z(), x.z(), z.z());
    const btMatrix3x3 swung = btMatrix3x3(btQuaternion(n, phi)) * atZero;
    joint->setFrames(btTransform(poseA.getBasis().transpose() * atZero, joint->getFrameOffsetA().getOrigin()),
                     btTransform(poseB.getBasis().transpose() * swung, joint->getFrameOffsetB().getOrigin()));
}

}  // namespace rigor::bullet
