// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All joints of a step as one unit of a solver's sweep: equality blocks at once by a direct method
// (joint_system.hpp), bounded rows (limits, motors, springs) between them one by one. Used by solvers that
// solve joints and contacts in turn:
//     begin      finds the joints among the rows and factors them; again whenever a row or a softness changed
//     solve      one pass, as often as wanted: biases and impulses may change in between
// Where so many joints meet that the factors would be nearly dense the pass is a sweep over all blocks
// instead, forwards and backwards in turn. One equality block alone is solved by its own inverse.
//
// Cost: begin and solve are linear in the number of joints in chains and trees; see joint_system.cpp for
// loops.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/solvers/joints/joint_system.hpp"

namespace rigor::engine {

template <class S>
class JointGroup {
  public:
    using Real = typename S::Real;

    /// The joints of these rows, whose directions and softnesses stay until the next begin(). Allocates where
    /// joints came or went.
    void begin(ConstraintRows<S>& constraints);
    bool empty() const { return equalities_.empty() && bounded_.empty(); }
    /// Applies the impulses that the joints' rows start with to the velocities.
    void warmStart(const ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) const;
    /// One pass: changes the joints' impulses and the velocities so that J v + bias + softness lambda
    /// vanishes for equality rows, and bounded rows keep their bounds. Returns the largest residual that it
    /// found [m/s or rad/s]. `constraints` are those of begin().
    Real solve(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);

  private:
    Real solveBounded(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) const;
    Real solveEqualities(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    Real sweep(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities, bool backwards) const;

    static constexpr int kSweeps = 10;                       ///< maximum number of sweeps per pass
    static constexpr Real kTolerance = Real(0.01);           ///< relative to the first sweep's residual
    std::vector<std::uint32_t> all_, equalities_, bounded_;  ///< blocks, in their order
    std::vector<typename JointSystem<S>::Item> items_;
    JointSystem<S> system_;
    bool direct_ = false;  ///< there are factors
};

}  // namespace rigor::engine
