// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Moreau's midpoint rule [Moreau1999], [AcaryBrogliato2008, section 10.1]:
//     q_M = q_0 + h/2 v_0                           half a step with the velocities of the start
//     v_1 = v_0 + M(q_M)^-1 (h f(q_M) + J(q_M)^T p)  forces and impulses, contacts found in q_M
//     q_1 = q_M + h/2 v_1                           so that q_1 = q_0 + h (v_0 + v_1) / 2
// Orientations by the exponential map of the mean velocity of the half step, and the free rotation of the
// `rotation` choice over each half: angular momentum changes by h (torque + impulses' moment) in q_M. Order 2
// for smooth motion, also with friction, rolling and joints; exact for a constant force. Without
// velocity-dependent forces the smooth scheme is symmetric and symplectic (the leapfrog, drift - kick - drift
// [HairerLubichWanner2006, section I.1.4]).
//
// Its midpoints q_M, h apart, are those of symplectic Euler, so the laws of contacts and joints are the same
// as there, stated between midpoints: a gap s in q_M needs J v_1 + s / h >= 0, and is closed in the next q_M;
// joints are linearised again where the next midpoint will be (SHAKE), and v_1, the chord between midpoints,
// is tangent to the constraint at q_1 up to h^2.
//
// Forces that depend on the velocity are evaluated twice, the second time with v_0 + h/2 a(q_M, v_0): order 2
// where nothing but forces acts; what impulses change of the velocity within the step they do not see.
#include <algorithm>

#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

/// The second half: `h` is its length.
template <class S>
void moveWithSolved(BodyArrays<S>& bodies, std::span<const Velocity<S>> start, std::span<Velocity<S>> used,
                    typename S::Real h, TurnRotation<S> turn, const Tasks& tasks) {
    (void)start;
    std::copy(bodies.velocity.begin(), bodies.velocity.end(), used.begin());
    moveWith<S>(bodies, used, h, turn, tasks);
}

}  // namespace

IntegratorTraits integratorMoreauMidpointTraits() {
    return {.scheme = FlightScheme::MoreauMidpoint, .order = 2, .forces = ForceTimes::Middle};
}

template <class S>
Integrator<S> integratorMoreauMidpoint() {
    return {.move = &moveWithSolved<S>, .atMidpoint = true};
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorMoreauMidpoint<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
