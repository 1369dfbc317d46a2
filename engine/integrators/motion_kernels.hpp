// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion of eight bodies at a time, in SIMD. Instruction sets: as solvers/wide/kernels.hpp.
#pragma once

#include "engine/math/lanes.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Any eight bodies.
struct BodyBlock {
    std::uint32_t index[kLanes] = {};  ///< body of each lane; 0 for lanes without a body
    std::uint32_t moves = 0;           ///< bit of each lane: there is a body
};

/// Eight bodies whose angular velocity changes by itself, because their inertia is not that of a sphere.
template <class S>
struct alignas(64) TumblingBlock : BodyBlock {
    using Real = typename S::Real;
    alignas(64) Lanes<Real> inertia[6], invInertia[6];  ///< body axes: xx xy xz yy yz zz [kg m^2]
    Lanes<Real> kick[3];       ///< angular impulse of torques in a sub-step, world axes [N m s]
    Lanes<Real> kicked[3];     ///< angular velocity with forces [rad/s]
    Lanes<Real> predicted[3];  ///< angular velocity with the gyroscopicterm as well, before constraints
    Lanes<Real> start[4];      ///< orientation before the move, x y z w
};

/// p += h v, q := exp(h w) q.
template <class S>
void moveBodies(const BodyBlock* blocks, std::size_t count, Pose<S>* poses, const Velocity<S>* velocities,
                typename S::Real h);

/// The rotation scheme `lie_midpoint` (rotation_lie_midpoint.cpp) before the constraints; 3D.
template <class S>
void predictTumbling(TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses,
                     Velocity<S>* velocities, typename S::Real h);
/// Called after the move: computes the angular velocity of the angular momentum in the new orientation.
template <class S>
void finishTumbling(const TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses,
                    Velocity<S>* velocities);

}  // namespace rigor::engine
