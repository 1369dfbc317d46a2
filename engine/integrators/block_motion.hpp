// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion of many bodies in SIMD: what motion.cpp does with symplectic Euler, the exponential map and the
// rotation scheme lie_midpoint or none, to rounding, where nothing but gravity, damping and wrenches acts. A
// world with a solver for large scenes uses it; the other is the reference.
//
// What a sub-step adds to the velocities does not change during a step, so that kick() is
//     u := kept u + add
// over one row of numbers; only bodies whose inertia is not that of a sphere need more, eight at a time.
#pragma once

#include <span>
#include <vector>

#include "engine/core/tasks.hpp"
#include "engine/integrators/motion_kernels.hpp"

namespace rigor::engine {

template <class S>
class BlockMotion {
  public:
    using Real = typename S::Real;

    BlockMotion() = default;
    explicit BlockMotion(bool gyroscopic) : gyroscopic_(gyroscopic) {}
    bool gyroscopic() const { return gyroscopic_; }

    /// Called before the sub-steps of h [s] of a step; world inertias are those of the bodies' poses.
    void begin(const BodyArrays<S>& bodies, const typename S::Vec& gravity, Real h, const Tasks& tasks);
    // --- in each of them, as Motion's
    void kick(BodyArrays<S>& bodies, Real h, const Tasks& tasks);
    void move(BodyArrays<S>& bodies, std::span<Velocity<S>> used, Real h, const Tasks& tasks) const;
    void finish(BodyArrays<S>& bodies, const Tasks& tasks) const;

  private:
    void addKick(const BodyArrays<S>& bodies, std::size_t i, const typename S::Vec& gravity, Real h);
    void addTumbling(const BodyArrays<S>& bodies, std::size_t i, Real kick);

    bool gyroscopic_ = true;
    std::vector<Velocity<S>> kept_, add_;
    std::vector<BodyBlock> moving_;           ///< blocks of the bodies 8 k .. 8 k + 7
    std::vector<TumblingBlock<S>> tumbling_;  ///< blocks of bodies with a gyroscopic term
    std::vector<std::uint32_t> twisted_;  ///< bodies with torques and an inertia that is not isotropic; used
                                          ///< without gyroscopic term
};

}  // namespace rigor::engine
