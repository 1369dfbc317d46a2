// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Spring and damper along the line of two anchors. With l their distance, n the unit vector from A to B and u
// the relative velocity of the anchors,
//     tension = k (l - l0) + c u . n,     F_B = -tension n,  F_A = +tension n.
// If the anchors coincide there is no line, and no force (the limit for l0 = 0, c = 0; a choice otherwise).
#include "engine/core/error.hpp"
#include "engine/forces/force.hpp"

namespace rigor::engine {

template <class S>
void checkForce(const LinearSpring<S>& force) {
    if (!force.anchorA.allFinite() || !force.anchorB.allFinite())
        throw EngineError("force_anchor", "anchors of a spring must be finite");
    const auto atLeastZero = [](typename S::Real value) { return value >= 0 && std::isfinite(value); };
    if (!atLeastZero(force.stiffness) || !atLeastZero(force.damping) || !atLeastZero(force.restLength))
        throw EngineError("spring", "stiffness, damping and rest length of a spring must not be negative");
}

template <class S>
void addForce(const LinearSpring<S>& force, const ForcePlace<S>& place, const ForceMoment<S>& moment) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const Pose<S>&A = moment.pose[place.a], &B = moment.pose[place.b];
    const Velocity<S>&vA = moment.velocity[place.a], &vB = moment.velocity[place.b];
    const Vec rA = rotate(A.q, place.armA), rB = rotate(B.q, place.armB);
    const Vec span = (B.p - A.p) + (rB - rA);
    const Real l = span.norm();
    if (!(l > Real(0))) return;
    const Vec n = span / l;
    const Vec u = (vB.v - vA.v) + (cross(vB.w, rB) - cross(vA.w, rA));
    const Real tension = force.stiffness * (l - force.restLength) + force.damping * u.dot(n);
    const Vec F = -tension * n;
    moment.wrench[place.b].force += F;
    moment.wrench[place.b].torque += cross(rB, F);
    moment.wrench[place.a].force -= F;
    moment.wrench[place.a].torque -= cross(rA, F);
}

RIGOR_INSTANTIATE_FORCE(LinearSpring);

}  // namespace rigor::engine
