// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact patches for the solver `wide`: what two shapes that touch have between them, eight pairs side by
// side. A patch has up to S::maxManifoldPoints normal rows, one at each point of the manifold, and friction
// of the patch as a whole at the centre of its pressure: S::tangents rows, and in 3D one about the normal
// (twist). With n the normal from A to B, r the arms from the centres of mass,
//     normal i   J v = n . (vB - vA) + (rB_i x n) . wB - (rA_i x n) . wA
//     tangent k  the same with t_k at the centre
//     twist      n . (wB - wA)
// The two bodies' arms of a point differ by the vector between their centres, c = xB - xA, so that with
// w = wB - wA a normal row is  n . (vB - vA) - (c x n) . wA + (rB_i x n) . w:  what a visit reads of a point
// is three numbers of its arm, and what the points do to each other (K). Numbers of a block are stored lane
// by lane (structure of arrays), so that a SIMD register takes the same number of several patches. No two
// patches of a block move the same body (colouring.hpp).
//
// Patches are in f32 in worlds of f64, too: S is PatchSpace of the world's. What is large there and has small
// differences stays out of them: positions (a patch knows arms and separations) and velocities (PatchRange).
// Impulses are f32 numbers then: the two bodies of a patch get momenta that are opposite to 6e-8 of what they
// exchange, at whatever speed both of them fly.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/math/lanes.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

/// What patches of a world in S are reckoned with.
using PatchReal = float;
template <class S>
using PatchSpace = Space<PatchReal, S::dim>;

/// Sizes that depend on the dimension.
template <class S>
struct PatchSize {
    static constexpr int lin = S::dim;               ///< numbers of a vector
    static constexpr int ang = S::dim == 3 ? 3 : 1;  ///< of an angular velocity
    static constexpr int points = S::maxManifoldPoints;
    static constexpr int tangents = S::tangents;
    static constexpr int inertia = S::dim == 3 ? 6 : 1;  ///< of a symmetric inertia: xx xy xz yy yz zz
    static constexpr int pairs = points * (points + 1) / 2;
};
/// Where the symmetric matrix of `points` points keeps its element (i, k).
constexpr int pairAt(int i, int k) {
    return i >= k ? i * (i + 1) / 2 + k : k * (k + 1) / 2 + i;
}

template <class S>
struct PatchPoint {
    using Real = typename S::Real;
    Lanes<Real> jB[PatchSize<S>::ang];  ///< arm from B times the normal; A's is that plus offset x n
    Lanes<Real> invK;                   ///< 0: no point in this lane; before it is prepared 1 where there is
    Lanes<Real> separation;             ///< where it was found [m]
    Lanes<Real> impulse;                ///< of the sub-step [N s], >= 0
    Lanes<Real> total;                  ///< of all sub-steps of the step [N s]
};

/// What only patches in space have.
template <class S>
struct PatchTwist {
    using Real = typename S::Real;
    Lanes<Real> tangent[3];                    ///< the first; the second is n x that
    Lanes<Real> radius[PatchSize<S>::points];  ///< of points from the centre, in the tangent plane [m]
    Lanes<Real> twistImpulse, twistTotal;      ///< [N m s]
};
template <class R>
struct PatchTwist<Space<R, 2>> {};

/// What each visit reads.
template <class S>
struct alignas(64) PatchBlock : PatchTwist<S> {
    using Real = typename S::Real;
    std::uint32_t a[kLanes], b[kLanes];  ///< bodies; of empty lanes 0, the world
    std::uint32_t movesA, movesB;        ///< bit of each lane: the body takes impulses
    std::int32_t points;                 ///< most points of a lane
    std::uint32_t bounces;               ///< bit of each lane: has a restitution
    alignas(64) Lanes<Real> normal[PatchSize<S>::lin];
    Lanes<Real> offset[PatchSize<S>::lin];  ///< from the centre of mass of A to that of B [m]
    Lanes<Real> centre[PatchSize<S>::lin];  ///< of pressure, from the centre of mass of B [m]
    Lanes<Real> invMassA, invMassB;
    Lanes<Real> invInertiaA[PatchSize<S>::inertia], invInertiaB[PatchSize<S>::inertia];
    Lanes<Real> friction, staticFriction;
    PatchPoint<S> point[PatchSize<S>::points];
    Lanes<Real> K[PatchSize<S>::pairs];  ///< of the normal rows: what an impulse at k does at i (pairAt)
    Lanes<Real> rubInvK;                 ///< 1 / the largest eigenvalue of K of friction
    Lanes<Real> rubImpulse[PatchSize<S>::tangents], rubTotal[PatchSize<S>::tangents];  ///< [N s]
};

/// What is read at the beginning and at the end of a step, and of points that bounce.
template <class S>
struct alignas(64) PatchRest {
    using Real = typename S::Real;
    Lanes<Real> armB[PatchSize<S>::points][PatchSize<S>::lin];  ///< from the centre of mass of B [m]
    Lanes<Real> restitution;
    // --- of the points, where block.bounces
    Lanes<Real> rebound[PatchSize<S>::points];  ///< where it hits: bias of the sub-step, < 0 [m/s]
    Lanes<Real> open[PatchSize<S>::points];     ///< 1: let through in this sub-step
};

/// The points' shares of friction, world axes, on their way into a block and out of it [N s].
template <class S>
struct alignas(64) PatchRubs {
    using Real = typename S::Real;
    Lanes<Real> last[PatchSize<S>::points][PatchSize<S>::lin];   ///< to start from; of the last sub-step
    Lanes<Real> total[PatchSize<S>::points][PatchSize<S>::lin];  ///< of all
};

/// World inverse inertia of a body, the upper triangle; 2D: one number.
template <class S>
struct alignas(4 * sizeof(typename S::Real)) PatchInertia {
    typename S::Real number[S::dim == 3 ? 8 : 4];
};

/// What all patches of a pass share.
struct PatchPass {
    PatchReal invH;                               ///< 1 / sub-step [1/s]
    PatchReal massScale, impulseScale, biasRate;  ///< the spring of overlap, solve-inl.hpp; rate [1/s]
    PatchReal slop;                               ///< overlap that is left alone [m]
    PatchReal fastestPush;                        ///< largest velocity that overlap asks for [m/s]
    PatchReal threshold;                          ///< slower approaches do not bounce [m/s]
    PatchReal touching;                           ///< gaps up to this are closed [m]
    PatchReal restingGap;                         ///< what gravity may close in a sub-step, generously [m]
    bool soft = true;   ///< overlap pushes; else (relaxation) rows are rigid and it does not
    bool last = false;  ///< of the sub-step: impulses are added to the totals
};

}  // namespace rigor::engine
