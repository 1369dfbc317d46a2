// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a world: rows for the solver, biases that aim at the end of the step, impulses for warm
// starting.
#pragma once

#include <vector>

#include "engine/constraints/joint.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// What making joint rows needs to know of a step.
template <class S>
struct JointStep {
    typename S::Real h;           ///< [s]
    typename S::Real biasFactor;  ///< share of the error to remove by velocity; 0: none
    typename S::Real warmStart;   ///< factor on the last impulses; 0: none
    bool curved;                  ///< aim at the constraint at the end of the step
};

template <class S>
class JointSet {
  public:
    using Real = typename S::Real;
    struct Record {
        Joint<S> joint;
        EvaluateJoint<S> evaluate = nullptr;
        std::array<Real, kMaxJointRows> impulse{};  ///< of the last step [N s] or [N m s]
        std::uint32_t block = 0;                    ///< its rows in this step
    };

    std::vector<Record>& records() { return records_; }
    const std::vector<Record>& records() const { return records_; }

    void addRows(const BodyArrays<S>& bodies, const JointStep<S>& step, ConstraintRows<S>& rows);
    void storeImpulses(const ConstraintRows<S>& rows);

    /// Biases for the given velocities. A linear row lets the bodies leave the constraint along its tangent;
    /// here each row aims at C(end of the step) = C(start) instead:
    ///     bias = (C(x + h v, exp(h w) q) - C(x, q)) / h - J v + beta C / h
    /// With symplectic Euler this is SHAKE [RyckaertCiccottiBerendsen1977], which keeps the energy of a
    /// pendulum where the linear row loses a share (h w)^2 / 2 of the speed in every step.
    void updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                      std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows) const;

  private:
    std::vector<Record> records_;
    std::vector<std::array<Real, kMaxJointRows>> startErrors_;
};

}  // namespace rigor::engine
