// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impact of a ball with friction and restitution in closed form: shared by the oblique impacts.
#pragma once

#include "validation/references/parts.hpp"

namespace rigor::validation {

/// Impulse on the ball at normal n (unit, towards the ball) for the velocity of its contact point relative to
/// the other surface. `normalMass`, `tangentMass`: effective masses. Newton restitution e, Coulomb friction
/// mu on the whole normal impulse; the tangential impulse sticks (zero slip after) or slides.
///   jn = (1+e) mn |un|;  jt = mt |s| if <= mu jn, else mu jn, against the slip s.
/// Throws AssumptionViolated where the static coefficient of the pair would make it stick and mu would not.
/// Source: Brach, Mechanical Impact Dynamics, 1991; Walton 1993 (beta0 = 0).
struct ImpactImpulse {
    Vec3 impulse;  ///< impulse on the ball [N s]
    bool sticks = true;
};
ImpactImpulse frictionalImpact(Vec3 contactVelocity, Vec3 n, const scenario::PairCoefficients& pair,
                               double normalMass, double tangentMass);

}  // namespace rigor::validation
