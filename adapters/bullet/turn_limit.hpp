// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Limits of a hinge beyond half a turn or on one side alone. Bullet's hinge knows its angle in (-pi, pi] and
// normalises its limits, so before each step it gets those of a window of less than a turn about the angle
// that was counted over turns: the true bounds where they are near, else bounds that no step reaches.
#pragma once

#include <BulletDynamics/ConstraintSolver/btHingeConstraint.h>

namespace rigor::bullet {

struct TurnLimit {
    btHingeConstraint* hinge = nullptr;
    double lower = 0.0, upper = 0.0;  ///< [rad], over turns
    double counted = 0.0;             ///< the last angle [rad]

    void update();
};

/// The stop's "relaxation factor" is the restitution of what hits it, 1 by default.
inline void setHingeLimit(btHingeConstraint& hinge, double lower, double upper) {
    hinge.setLimit(static_cast<btScalar>(lower), static_cast<btScalar>(upper), btScalar(0.9), btScalar(0.3),
                   btScalar(0.0));
}

}  // namespace rigor::bullet
