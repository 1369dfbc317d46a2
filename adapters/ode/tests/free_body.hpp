// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {

/// Adds a free body at `position` that nothing touches; returns its index.
inline int addFree(Scenario& s, const Vec3& position, double mass, const Vec3& moments) {
    const int b = addBody(s, Sphere{0.1}, position, mass, moments);
    s.bodies.back().collides = false;
    return b;
}

}  // namespace rigor::test
