// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A damper without a spring on one coordinate of a btGeneric6DofSpring2Constraint: a motor towards rest whose
// largest force is set before each step. Bullet's own (setDamping) is one motor row towards the speed that
// the damper alone would leave, bounded by the damper's force, isolated on one body, one axis, one step: a
// force F that slows the body too is taken off the damper's, c v - F down to 0, one that drives the body is
// not, at any mass, step or stiffness. Over a swing under gravity about half of the
// damping is left.
#pragma once

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>

namespace rigor::bullet {

struct Damper {
    btGeneric6DofSpring2Constraint* joint = nullptr;
    int coordinate = 0;        ///< Bullet's: travel along x, y, z, turn about x, y, z of A's joint frame
    double coefficient = 0.0;  ///< [N s/m] or [N m s/rad]

    /// Sets the motor's largest force to the coefficient times the speed of the coordinate at the present
    /// state. A turn's speed is taken about A's axis: that of the angle where no other turn is free.
    void update() const;
};

}  // namespace rigor::bullet
