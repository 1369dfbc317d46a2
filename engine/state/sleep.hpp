// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What it means for a body to be asleep.
#pragma once

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// At rest from now on, and like a wall to the others.
template <class S>
void putToSleep(BodyArrays<S>& bodies, std::uint32_t i) {
    bodies.asleep[i] = 1;
    bodies.velocity[i] = {};
    bodies.invMass[i] = 0;
    bodies.invInertia[i] = zeroInertia<S>();
}

/// Awake, and at rest for no time.
template <class S>
void wakeBody(BodyArrays<S>& bodies, std::uint32_t i) {
    bodies.stillTime[i] = 0;
    if (!bodies.asleep[i]) return;
    bodies.asleep[i] = 0;
    bodies.invMass[i] = typename S::Real(1) / bodies.constants[i].mass;
    bodies.invInertia[i] = worldInertia<S>(bodies.pose[i].q, bodies.invInertiaLocal[i]);
}

}  // namespace rigor::engine
