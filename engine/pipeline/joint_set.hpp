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
    typename S::Real h;               ///< of the (sub-)step [s]
    BiasRule<typename S::Real> bias;  ///< what position errors do to the rows
    typename S::Real warmStart;       ///< factor on the last impulses; 0: none
    bool curved;                      ///< aim at the constraint at the end of the step
    typename S::Real curvature = 1;   ///< share of that aim; less where the iteration diverges, in [0, 1]
};

/// How far the aims of joints at the end of the step moved when they were renewed [m/s or rad/s].
template <class Real>
struct BiasChange {
    Real step = 0;     ///< largest change of a row's bias
    Real largest = 0;  ///< largest bias
};

template <class S>
class JointSet {
  public:
    using Real = typename S::Real;
    struct Record {
        Joint<S> joint;
        EvaluateJoint<S> evaluate = nullptr;
        std::array<Real, kMaxRowsPerJoint> impulse{};  ///< of the last (sub-)step [N s] or [N m s]
        std::array<Real, kMaxRowsPerJoint> total{};    ///< of all sub-steps of the last step
        /// Sum of J^T impulse over the last step: on B [N s], and its moment about B's anchor [N m s].
        typename S::Vec push = S::Vec::Zero();
        typename S::Ang twist = zeroAng<S>();
        typename S::Vec armB = S::Vec::Zero();  ///< B's anchor from its centre when the rows were made [m]
        std::uint32_t firstRow = 0;             ///< its rows in this step follow each other
        std::uint32_t rows = 0, held = 0;       ///< all, and those that hold (the first ones)
        std::uint32_t block = 0;                ///< of the rows that hold; each other row has its own
    };

    std::vector<Record>& records() { return records_; }
    const std::vector<Record>& records() const { return records_; }

    void addRows(const BodyArrays<S>& bodies, const JointStep<S>& step, ConstraintRows<S>& rows);
    /// Reads the impulses of the solved rows, and the coordinates where the bodies are now.
    void storeImpulses(const BodyArrays<S>& bodies, const ConstraintRows<S>& rows);
    /// Where a joint's coordinates are and how fast they change. Returns their number.
    int readCoordinates(const BodyArrays<S>& bodies, const Record& record,
                        std::array<Real, kMaxJointAxes>& value, std::array<Real, kMaxJointAxes>& rate) const;
    /// A new step: totals start at zero.
    void clearTotals();

    /// Biases for the given velocities. A linear row lets the bodies leave the constraint along its tangent;
    /// here each row aims at C(end of the step) = C(start) instead:
    ///     bias = (C(x + h v, exp(h w) q) - C(x, q)) / h - J v + what the bias rule makes of C
    /// With symplectic Euler this is SHAKE [RyckaertCiccottiBerendsen1977], which keeps the energy of a
    /// pendulum where the linear row loses a share (h w)^2 / 2 of the speed in every step.
    BiasChange<Real> updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                                  std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows);

    /// Before a solve, so that work() and restart() know what it started from. Allocates where rows or bodies
    /// are more than ever.
    void remember(const ConstraintRows<S>& rows, std::span<const Velocity<S>> velocities);
    /// Work of the rows that hold since remember(), over the kinetic energy before and after of what moves
    /// along (of each joint's bodies, so that bodies count once per joint). Ideal joints do none.
    Real work(const ConstraintRows<S>& rows, std::span<const Velocity<S>> velocities) const;
    /// Velocities and impulses as they were at remember(), but no impulses of rows that hold.
    void restart(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities) const;

  private:
    void addRow(const BodyArrays<S>& bodies, const JointStep<S>& step, const RowLaw<S>& law, Real error,
                const Block<S>& block, Row<S>& row) const;

    std::vector<Record> records_;
    std::vector<Real> startBias_;  ///< of rows that hold, by row
    std::vector<Real> startImpulses_;
    std::vector<Velocity<S>> startVelocities_;
    JointRows<S> made_;
};

}  // namespace rigor::engine
