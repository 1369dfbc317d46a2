// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One set of settings for small scenes that are measured.
#pragma once

#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Sets the choices that cost time for accuracy, and leaves the others: every island is solved by `block`, whatever its
/// size, in up to 200 iterations that stop at a tenth of the usual change; forces, contacts and joints act in the middle
/// of the step (`moreau_midpoint`, of order 2; LIMITS.md says where it is not, and what its contacts show).
template <class S>
void preferAccuracy(WorldDef<S>& def) {
    def.solver = "block";
    def.velocityIterations = 200;
    def.velocityTolerance = typename S::Real(1e-7);
    def.integrator = "moreau_midpoint";
}

}  // namespace rigor::engine
