// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// SIMD kernels on blocks of patches. The instruction set is chosen at run time. The results are the same bits
// on every instruction set and in scalar code: lanes do not mix, and there are no fused or approximate
// operations.
#pragma once

#include "engine/solvers/wide/patch.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Arguments of every kernel: consecutive blocks and the arrays of bodies that they refer to.
template <class S>
struct PatchRange {
    PatchBlock<S>* blocks;
    PatchColdData<S>* cold;
    std::size_t count;
    Velocity<S>* velocities;
    /// Base velocity of each body, or null. In f64 worlds a velocity is base + velocity: the part common to
    /// two bodies cancels before anything is rounded.
    const Velocity<S>* base;
    /// Translations [m] and rotation vectors [rad] since the step began.
    const Velocity<S>* motions;
    bool shared = false;  ///< several threads work: other cores may hold the velocities in their caches
    PatchFriction<S>* pointFriction = nullptr;  ///< friction of each point, by block; used by preparePatches
                                                ///< and distributeFriction
};

/// Makes rows from normals, arms and the impulses of the last step. Bodies have the velocities of the start
/// of the step.
template <class S>
void preparePatches(const PatchRange<S>& range, const PatchInertia<S>* inertia);
/// Applies the initial impulses of all patches.
template <class S>
void warmStartPatches(const PatchRange<S>& range);
/// One Gauss-Seidel pass: for every patch first its normal rows, then its friction.
template <class S>
void solvePatches(const PatchRange<S>& range, const PatchPass& pass);
/// Begins a sub-step for points with restitution: sets their rebound and whether they are active, from the
/// velocities before forces.
template <class S>
void prepareBounces(const PatchRange<S>& range, const PatchPass& pass);
/// Distributes the friction of each patch over its points; force and moment about the normal are conserved.
template <class S>
void distributeFriction(const PatchRange<S>& range);

/// Instruction set used on this machine: "AVX3", "AVX2", ... or "SCALAR".
const char* simdTarget();

}  // namespace rigor::engine
