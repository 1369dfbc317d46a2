// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See impact_law.hpp.
#include "validation/references/impact_law.hpp"

namespace rigor::validation {

ImpactImpulse frictionalImpact(Vec3 contactVelocity, Vec3 n, double e, double mu, double normalMass,
                               double tangentMass) {
    const double approach = dot(contactVelocity, n);
    const Vec3 slip = contactVelocity - approach * n;
    const double normalImpulse = -(1.0 + e) * normalMass * approach;
    const double stop = tangentMass * norm(slip);
    ImpactImpulse result;
    result.sticks = stop <= mu * normalImpulse;
    const Vec3 tangential = result.sticks ? -tangentMass * slip : -(mu * normalImpulse) * unit(slip);
    result.impulse = normalImpulse * n + tangential;
    return result;
}

}  // namespace rigor::validation
