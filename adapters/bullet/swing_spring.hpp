// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The spring of a swing: the angle phi >= 0 between the joint's axis in A and in B, whose gradient is
// n = x_A x x_B / |x_A x x_B|. Bullet has no spring with such an axis: the angles of
// btGeneric6DofSpring2Constraint are those of a fixed rotation order, and btConeTwistConstraint has limits and
// a motor towards an orientation. So a btGeneric6DofSpring2Constraint that leaves all free is given frames
// anew before each step, with n for their x axis and phi for the turn about it, and its spring acts on that.
#pragma once

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>

namespace rigor::bullet {

struct SwingSpring {
    btGeneric6DofSpring2Constraint* joint = nullptr;
    btVector3 axisA, axisB;  ///< the joint's axis in Bullet's body frames of A and B, unit
    btVector3 normalA;       ///< n where phi is zero, likewise of A

    /// Sets the frames to the present poses.
    void update() const;
};

}  // namespace rigor::bullet
