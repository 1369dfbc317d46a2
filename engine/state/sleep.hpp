// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Definition of a sleeping body.
#pragma once

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Puts a body at rest; other bodies collide with it as with a static body.
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
