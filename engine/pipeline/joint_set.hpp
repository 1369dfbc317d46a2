// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints of a world: rows for the solver, biases re-linearised at the predicted end of the step, impulses
// for warm starting.
#pragma once

#include <vector>

#include "engine/constraints/joint.hpp"
#include "engine/core/tasks.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// Parameters of a step for joint rows.
template <class S>
struct JointStep {
    typename S::Real h;                      ///< size of the (sub-)step [s]
    BiasRule<typename S::Real> bias;         ///< bias of the rows from position errors
    typename S::Real warmStart;              ///< factor on the last impulses; 0: none
    bool relinearized;                       ///< biases are re-linearised at the predicted end of the step
    IslandKind islands = IslandKind::Usual;  ///< rows are of the joints of these islands
    bool atMidpoint = false;                 ///< the step leads from midpoint to midpoint
    bool begins = true;                      ///< the first sub-step
};

/// Change of the joints' biases when they were re-linearised [m/s or rad/s].
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
        std::array<Real, kMaxRowsPerJoint> impulse{};  ///< impulses of the last (sub-)step [N s] or [N m s]
        std::array<Real, kMaxRowsPerJoint> total{};    ///< sums over all sub-steps of the last step
        /// Sum of J^T impulse over the last step: on B [N s], and its moment about B's anchor [N m s].
        typename S::Vec reactionImpulse = S::Vec::Zero();
        typename S::Ang reactionAngularImpulse = zeroAng<S>();
        typename S::Vec armB = S::Vec::Zero();   ///< B's anchor from its centre when the rows were made [m]
        std::uint32_t firstRow = 0;              ///< its rows in this step follow each other
        std::uint32_t rows = 0, equalities = 0;  ///< all rows; equality rows, which come first
        IslandKind islands = IslandKind::Usual;  ///< the method that solves its island
        bool solved = false;                     ///< its rows are among those of this half of the step
        std::uint32_t block = 0;                 ///< block of the equality rows; each other row has its own
        /// Rows beside those of its axes; -1: not known yet.
        std::int32_t ownRows = -1, ownEqualities = 0;
        BiasChange<Real> change;    ///< when its bias was last re-linearised
        std::uint32_t updates = 0;  ///< number of re-linearisations in this (sub-)step
        bool linear = false;        ///< its rows stay as they were at the start of the (sub-)step
        /// The body that positions count from when the joint is evaluated, one that moves. Joints depend on the difference
        /// of positions alone, which has no rounding of the place then.
        std::uint32_t origin(const BodyArrays<S>& bodies) const {
            return bodies.invMass[joint.a] > 0 ? joint.a : joint.b;
        }
        /// Evaluates the joint where the bodies are.
        void evaluateHere(const BodyArrays<S>& bodies, JointRows<S>& out) const {
            const typename S::Vec from = bodies.pose[origin(bodies)].p;
            const auto here = [&](std::uint32_t i) -> Pose<S> {
                return {bodies.pose[i].p - from, bodies.pose[i].q};
            };
            evaluate(joint, here(joint.a), here(joint.b), out);
        }
        /// Iterations that change it can have converged; that is not required of two or three.
        bool isIterated() const { return updates >= 4; }
    };

    std::vector<Record>& records() { return records_; }
    const std::vector<Record>& records() const { return records_; }

    void addRows(const BodyArrays<S>& bodies, const JointStep<S>& step, ConstraintRows<S>& rows,
                 const Tasks& tasks);
    /// Reads the impulses of the solved rows, and at the end of a step the coordinates where the bodies are now.
    /// `ends`: the step ends with this sub-step.
    void storeImpulses(const BodyArrays<S>& bodies, const ConstraintRows<S>& rows, bool ends,
                       const Tasks& tasks);
    /// Coordinates of a joint and their rates. Returns their number.
    int readCoordinates(const BodyArrays<S>& bodies, const Record& record,
                        std::array<Real, kMaxJointAxes>& value, std::array<Real, kMaxJointAxes>& rate) const;
    /// A new step: totals start at zero.
    void clearTotals();

    /// Re-linearises the biases at the poses that the given velocities lead to. A linear row lets the bodies
    /// leave the constraint along its tangent; here each row requires C(end of the step) = C(start) instead:
    ///     bias = (C(x + h v, exp(h w) q) - C(x, q)) / h - J v + bias of C by the bias rule
    /// With symplectic Euler this is SHAKE [RyckaertCiccottiBerendsen1977], which conserves the energy of a
    /// pendulum, whereas the linear row loses a fraction (h w)^2 / 2 of the speed in every step.
    void updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                      std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows);
    /// The same for the joints of these blocks.
    void updateBiases(const BodyArrays<S>& bodies, const JointStep<S>& step,
                      std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows,
                      std::span<const std::uint32_t> blocks);
    /// The same for joints whose bias changed by more than `still` the last time: changes then are what velocities lack.
    void updateChanging(const BodyArrays<S>& bodies, const JointStep<S>& step,
                        std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows, Real still);
    /// The joints of these blocks become linear until rows are added anew.
    void linearise(const BodyArrays<S>& bodies, const JointStep<S>& step,
                   std::span<const Velocity<S>> velocities, ConstraintRows<S>& rows,
                   std::span<const std::uint32_t> blocks);

  private:
    static constexpr std::size_t kGrain = 64;  ///< joints: one takes some 0.2 us
    /// Number of a joint's rows, which does not depend on the poses.
    void countRows(const BodyArrays<S>& bodies, Record& record);
    template <class Work>
    void forRecords(const Tasks& tasks, const Work& work);
    void fillRows(const BodyArrays<S>& bodies, const JointStep<S>& step, Record& record, JointRows<S>& made,
                  ConstraintRows<S>& rows) const;
    void updateBias(const BodyArrays<S>& bodies, const JointStep<S>& step,
                    std::span<const Velocity<S>> velocities, Record& record, ConstraintRows<S>& rows);
    void renewBias(const BodyArrays<S>& bodies, const JointStep<S>& step,
                   std::span<const Velocity<S>> velocities, Record& record, Real fraction,
                   ConstraintRows<S>& rows);
    /// Calls use(record) for the joints of these blocks.
    template <class Use>
    void forBlocks(std::span<const std::uint32_t> blocks, const Use& use);
    void addRow(const BodyArrays<S>& bodies, const JointStep<S>& step, const RowLaw<S>& law, Real error,
                const Block<S>& block, Row<S>& row) const;

    std::vector<Record> records_;
    std::vector<Real> startBias_;  ///< initial bias of each row
    std::vector<std::uint32_t>
        recordOf_;  ///< block -> its record, of a record's first block; else kNullIndex
    JointRows<S> made_;
};

}  // namespace rigor::engine
