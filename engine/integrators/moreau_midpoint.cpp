// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Moreau's midpoint rule [Moreau1999], [AcaryBrogliato2008, section 10.1]:
//     q_M = q_0 + h/2 v_0
//     v_1 = v_0 + M(q_M)^-1 (h f(q_M) + J(q_M)^T p)     contacts found, forces and impulses acting in q_M
//     q_1 = q_M + h/2 v_1                               so that q_1 = q_0 + h (v_0 + v_1) / 2
// Order 2 for smooth motion, with friction, rolling and joints, too; exact for a constant force.
//
// The step goes from the midpoint q_M over the whole h to the next one, as symplectic Euler does, and with
// all of its laws: a gap s in q_M needs J v_1 + s / h >= 0, joints are linearised again at the next
// midpoint (SHAKE [RyckaertCiccottiBerendsen1977]), positions are corrected there. What the world shows is
// the state q_1, v_1 between the two, with angular velocities from the angular momentum in the orientation
// of q_1. So the sequence of midpoints is that of symplectic Euler (the leapfrog, [HairerLubichWanner2006,
// section I.1.4]): energy stays bounded, and contacts, piles and joints are as stable as there. v_1 is the
// chord between midpoints: tangent to constraints at q_1 up to h^2. q_1 itself is the middle of the chord,
// h^2 |v|^2 / (8 r) inside of the joint's arc of radius r: joints are put right there, which the midpoints
// do not see. With position_correction=rattle bodies on joints go from a midpoint to q_1, and from q_0 to the first midpoint,
// by half a step of RATTLE [Andersen1983] without forces (PositionCorrection::beginDrift), which keeps the momentum along the
// joints' free directions. With the acceleration a that joints cause, the sequence of midpoints conserves
//     H - h^2/12 a M a  where v_1 is shown and v_0 begun with,     H + h^2/24 a M a  by RATTLE (and terms of the forces).
// processed_rattle, the default, is between the two (solvers/corrections/correction_ngs.cpp): a pendulum that is pushed where it
// hangs has a tenth of the error of its period that v_1 gives it.
//
// The midpoint is part of the world's state. It is found anew, q_0 + h/2 v_0, in the first step, where the
// step size changes, and for a body whose velocity was set.
//
// Friction opposes the mean slip (v_0 + v_1)/2 where it slides (RowContacts::updateSlips); a contact sticks where
// v_1 does. A gap is closed by velocity, unless it is no wider than what iterations leave (gapAtMidpoint in
// pipeline/stages.cpp): at a midpoint it is what the bodies' turning leaves, as a joint's curvature, and not closing it
// would lift a body that turns about an edge. Contacts are found as far ahead as bodies move in a step, so that those
// that others hold reach a midpoint without overlap.
//
// J(q_M) is half a step older than v_1. Where contacts turn, their rows hold for J(q_1), extrapolated (contacts/row_lag.hpp).
//
// Forces that depend on the velocity are evaluated twice, the second time with v_0 + h/2 a(q_M, v_0): order 2
// where nothing but forces acts. What impulses change of the velocity within the step they do not see.
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
IntegratorTraits integratorMoreauMidpointTraits() {
    return {
        .scheme = FlightScheme::MoreauMidpoint, .order = 2, .forces = ForceTimes::Middle, .inBlocks = true};
}

template <class S>
Integrator<S> integratorSymplecticEuler();
/// Bodies move to the next midpoint as with symplectic Euler: with the new velocity.
template <class S>
Integrator<S> integratorMoreauMidpoint() {
    Integrator<S> integrator = integratorSymplecticEuler<S>();
    integrator.atMidpoint = true;
    return integrator;
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorMoreauMidpoint<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
