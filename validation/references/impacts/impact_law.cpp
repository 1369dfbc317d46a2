// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See impact_law.hpp.
#include "validation/references/impacts/impact_law.hpp"

namespace rigor::validation {

ImpactImpulse frictionalImpact(Vec3 contactVelocity, Vec3 n, const scenario::PairCoefficients& pair,
                               double normalMass, double tangentMass) {
    const double e = pair.restitution, mu = pair.friction;
    const double approach = dot(contactVelocity, n);
    const Vec3 slip = contactVelocity - approach * n;
    const double normalImpulse = -(1.0 + e) * normalMass * approach;
    const double stop = tangentMass * norm(slip);
    ImpactImpulse result;
    result.sticks = stop <= mu * normalImpulse;
    require(
        result.sticks || stop > holdingFriction(pair) * normalImpulse,
        "static friction would end the slip in the impact, that of sliding would not: the law of impulses "
        "does not say which of them acts");
    const Vec3 tangential = result.sticks ? -tangentMass * slip : -(mu * normalImpulse) * unit(slip);
    result.impulse = normalImpulse * n + tangential;
    return result;
}

}  // namespace rigor::validation
