// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data of the contact patches of the solver `wide`. A patch is the contact of two shapes; a block holds
// eight. A patch has up to S::maxManifoldPoints normal rows, one at each point of the manifold, and friction
// of the whole patch at its center of pressure: S::tangents rows, and in 3D one about the normal (torsional
// friction). With n the normal from A to B, r the arms from the centres of mass,
//     normal i   J v = n . (vB - vA) + (rB_i x n) . wB - (rA_i x n) . wA
//     tangent k  the same with t_k at the center of pressure
//     torsion    n . (wB - wA)
// The arms of a point on the two bodies differ by c = xB - xA, so that with w = wB - wA a normal row is
//     n . (vB - vA) - (c x n) . wA + (rB_i x n) . w
// A pass reads of each point the three numbers of its arm, and the coupling K of the points.
//
//     PatchBlock     lane 0     lane 1    ...   lane 7        structure of arrays: one SIMD register
//       normal[0]    patch 17   patch 4         (empty)       holds the same number of several patches
//       normal[1]    ...
//
// Invariant: no two patches of a block move the same body (colouring.hpp).
//
// Patches are f32 in f64 worlds, too: S is the PatchSpace of the world's space. Large numbers with small
// differences stay outside: positions (a patch has arms and separations) and velocities (PatchRange::base).
// The impulses are f32, too: the momenta that the two bodies get are opposite to 6e-8 of the momentum
// exchanged, whatever their common velocity.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/math/lanes.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

/// Precision of the patches of every world.
using PatchReal = float;
template <class S>
using PatchSpace = Space<PatchReal, S::dim>;

/// Sizes that depend on the dimension.
template <class S>
struct PatchSize {
    static constexpr int lin = S::dim;               ///< components of a vector
    static constexpr int ang = S::dim == 3 ? 3 : 1;  ///< components of an angular velocity
    static constexpr int points = S::maxManifoldPoints;
    static constexpr int tangents = S::tangents;
    static constexpr int inertia = S::dim == 3 ? 6 : 1;  ///< components of inertia: xx xy xz yy yz zz
    static constexpr int pairs = points * (points + 1) / 2;
};
/// Index of the element (i, k) of a symmetric matrix stored as its lower triangle, row by row.
constexpr int pairAt(int i, int k) {
    return i >= k ? i * (i + 1) / 2 + k : k * (k + 1) / 2 + i;
}

template <class S>
struct PatchPoint {
    using Real = typename S::Real;
    Lanes<Real> jB[PatchSize<S>::ang];  ///< arm from B times the normal; A's is that plus offset x n
    Lanes<Real> invK;        ///< effective mass; 0: no point in this lane; until prepared 1 for a point
    Lanes<Real> separation;  ///< signed distance at the start of the step [m]
    Lanes<Real> impulse;     ///< accumulated impulse of the sub-step [N s], >= 0
    Lanes<Real> total;       ///< sum over the sub-steps of the step [N s]
};

/// Torsional friction and the tangent frame; empty in 2D.
template <class S>
struct PatchTorsion {
    using Real = typename S::Real;
    Lanes<Real> tangent[3];                    ///< first tangent t; the second is n x t
    Lanes<Real> radius[PatchSize<S>::points];  ///< distance of each point from the center of pressure [m]
    Lanes<Real> torsionImpulse, torsionTotal;  ///< [N m s]
};
template <class R>
struct PatchTorsion<Space<R, 2>> {};

/// Hot data: read by every pass.
template <class S>
struct alignas(64) PatchBlock : PatchTorsion<S> {
    using Real = typename S::Real;
    std::uint32_t a[kLanes], b[kLanes];  ///< bodies; in empty lanes 0, the world
    std::uint32_t movesA, movesB;        ///< one bit per lane: the body takes impulses
    std::int32_t points;                 ///< largest number of points of a lane
    std::uint32_t bounces;               ///< one bit per lane: restitution > 0
    std::uint32_t driven;                ///< one bit per lane: the surfaces move over their bodies
    std::uint32_t moments;               ///< one bit per lane: rolling or torsional friction > 0
    alignas(64) Lanes<Real> normal[PatchSize<S>::lin];
    Lanes<Real> offset[PatchSize<S>::lin];  ///< vector from the centre of mass of A to that of B [m]
    Lanes<Real> center[PatchSize<S>::lin];  ///< center of pressure, from the centre of mass of B [m]
    Lanes<Real> invMassA, invMassB;
    Lanes<Real> invInertiaA[PatchSize<S>::inertia], invInertiaB[PatchSize<S>::inertia];
    Lanes<Real> friction, staticFriction;
    PatchPoint<S> point[PatchSize<S>::points];
    Lanes<Real> K[PatchSize<S>::pairs];  ///< J M^-1 J^T of the normal rows (pairAt)
    Lanes<Real> tangentMass;             ///< 1 / largest eigenvalue of K of friction
    Lanes<Real> frictionImpulse[PatchSize<S>::tangents], frictionTotal[PatchSize<S>::tangents];  ///< [N s]
};

/// Cold data: read at the beginning and at the end of a step, for points with restitution, and for surfaces with
/// velocities and moments.
template <class S>
struct alignas(64) PatchColdData {
    using Real = typename S::Real;
    Lanes<Real> armB[PatchSize<S>::points][PatchSize<S>::lin];  ///< vectors from the centre of mass of B to
                                                                ///< the points [m]
    Lanes<Real> restitution;
    // --- of each point, where block.bounces
    Lanes<Real> rebound[PatchSize<S>::points];   ///< bias e J v_0 of a point that hits, < 0 [m/s]; else 0
    Lanes<Real> inactive[PatchSize<S>::points];  ///< 1: the row is not solved in this sub-step
    // --- where block.driven: velocity of B's surface against A's, as that of a body at B's centre of mass
    Lanes<Real> surfaceV[PatchSize<S>::lin], surfaceW[PatchSize<S>::ang];
    // --- where block.moments (moments-inl.hpp)
    Lanes<Real> rollingFriction, torsionalFriction;  ///< [m]
    Lanes<Real> rollingMass, torsionalMass;          ///< [kg m^2]
    /// Angular impulse on B along the tangents and the normal, of the sub-step; its sum over the step [N m s].
    Lanes<Real> moment[PatchSize<S>::ang], momentTotal[PatchSize<S>::ang];
};

/// Friction impulses of each point in world axes [N s]: input of preparation, output of distributeFriction.
template <class S>
struct alignas(64) PatchFriction {
    using Real = typename S::Real;
    Lanes<Real> last[PatchSize<S>::points][PatchSize<S>::lin];   ///< initial value; that of the last sub-step
    Lanes<Real> total[PatchSize<S>::points][PatchSize<S>::lin];  ///< sum over all sub-steps
};

/// World inverse inertia of a body, the upper triangle; 2D: one number.
template <class S>
struct alignas(4 * sizeof(typename S::Real)) PatchInertia {
    typename S::Real number[S::dim == 3 ? 8 : 4];
};

/// Parameters of a pass, the same for all patches.
struct PatchPass {
    PatchReal invH;                               ///< 1 / sub-step [1/s]
    PatchReal massScale, impulseScale, biasRate;  ///< soft contact, solve-inl.hpp; biasRate in [1/s]
    PatchReal slop;                               ///< penetration that is not corrected [m]
    PatchReal maxBiasVelocity;                    ///< largest bias velocity from penetration [m/s]
    PatchReal threshold;   ///< restitution threshold: slower approaches do not bounce [m/s]
    PatchReal touching;    ///< points with up to this separation count as touching [m]
    PatchReal restingGap;  ///< upper bound of what gravity closes in a sub-step [m]
    bool soft = true;      ///< rows are soft and penetration has a bias; else relaxation: rigid, no bias
    bool last = false;     ///< last pass of the sub-step: impulses are added to the totals
};

}  // namespace rigor::engine
