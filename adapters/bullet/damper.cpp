// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/damper.hpp"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>

namespace rigor::bullet {

void Damper::update() const {
    const btRigidBody &a = joint->getRigidBodyA(), &b = joint->getRigidBodyB();
    const btTransform frame = a.getCenterOfMassTransform() * joint->getFrameOffsetA();
    const btVector3 axis = frame.getBasis().getColumn(coordinate % 3);
    btVector3 rate = b.getAngularVelocity() - a.getAngularVelocity();
    if (coordinate < 3) {
        // B's anchor in the frame of A.
        const btVector3 anchor = b.getCenterOfMassTransform() * joint->getFrameOffsetB().getOrigin();
        rate = b.getVelocityInLocalPoint(anchor - b.getCenterOfMassPosition()) -
               a.getVelocityInLocalPoint(anchor - a.getCenterOfMassPosition());
    }
    joint->setMaxMotorForce(coordinate, static_cast<btScalar>(coefficient) * std::abs(axis.dot(rate)));
}

}  // namespace rigor::bullet
