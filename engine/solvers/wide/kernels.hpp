// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What is done with blocks of patches, in SIMD. The instruction set is chosen when the program runs; the
// results are the same on all of them, and without any, to the bit: lanes do not mix, and there are no fused
// or approximate operations.
#pragma once

#include "engine/solvers/wide/patch.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// The blocks of a call, and the bodies that all of them refer to.
template <class S>
struct PatchRange {
    PatchBlock<S>* blocks;
    PatchRest<S>* rests;
    std::size_t count;
    Velocity<S>* velocities;
    /// Null, or what velocities are counted from, body by body: in worlds of f64 a velocity is base +
    /// velocity, and what is common to two bodies falls out before anything is rounded.
    const Velocity<S>* base;
    /// Translations [m] and rotation vectors [rad] since the step began.
    const Velocity<S>* motions;
    bool shared = false;           ///< among threads: other cores may have velocities in their caches
    PatchRubs<S>* rubs = nullptr;  ///< of each block; to prepare and to share
};

/// From normals, arms and the impulses of the last step to rows. Bodies have the velocities of the start of
/// the step.
template <class S>
void preparePatches(const PatchRange<S>& range, const PatchInertia<S>* inertia);
/// Applies the impulses that patches start with.
template <class S>
void warmStartPatches(const PatchRange<S>& range);
/// One visit of every patch: its normals, then its friction.
template <class S>
void solvePatches(const PatchRange<S>& range, const PatchPass& pass);
/// What a sub-step makes of points that can bounce, with velocities from before its forces.
template <class S>
void planPatches(const PatchRange<S>& range, const PatchPass& pass);
/// Shares the friction of patches out among their points, so that force and moment about the normal are kept.
template <class S>
void sharePatches(const PatchRange<S>& range);

/// The instruction set that these functions use on this machine: "AVX3", "AVX2", ... or "SCALAR".
const char* simdTarget();

}  // namespace rigor::engine
