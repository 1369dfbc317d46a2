// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One set of settings for large scenes where time counts: piles, stacks, crowds.
#pragma once

#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Sets the choices that cost accuracy for speed, or that only pay in large scenes, and leaves the others:
/// the integrator `symplectic_euler`, the solver `wide` with springs of contact half as stiff again as usual,
/// results of the narrow phase cached while a pair moves by less than a millimetre, the broad phase `wide_tree`
/// with fat AABBs, points found 5 mm and the way of a step ahead (one pass over soft contacts does not push out
/// what heavy bodies overlap), and joints that are linearised at the start of each sub-step. The cost is that of
/// soft contacts (solvers/wide/wide.cpp) and of order 1: bodies overlap by what the springs need to carry the load.
template <class S>
void preferSpeed(WorldDef<S>& def) {
    using Real = typename S::Real;
    def.solver = "wide";
    def.integrator = "symplectic_euler";
    def.substeps = 5;
    def.contactFrequency = Real(45);
    def.cacheTolerance = Real(1e-3);
    def.boxMargin = Real(0.05);
    def.broadPhase = "wide_tree";
    def.speculativeDistance = Real(5e-3);
    def.relinearizedJoints = false;
}

}  // namespace rigor::engine
