// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All joints of a step as units of a solver's sweep, one for all joints that are connected. Used by solvers that
// solve joints and contacts in turn:
//     begin      finds the joints among the rows and factors them; again whenever a row or a softness changed
//     solve      one pass, as often as wanted: biases and impulses may change in between
// Equality blocks are solved at once by a direct method (joint_system.hpp), and bounded rows (limits, motors,
// springs) under the condition that the equality rows hold (joint_group_bounds.cpp). A part does not depend on
// the others, and threads share the parts. Where so many joints meet that the factors would be nearly dense the
// pass is a sweep over all blocks instead, forwards and backwards in turn. One equality block alone is solved by
// its own inverse.
//
// Cost: begin and solve are linear in the number of joints in chains and trees, and begin in the number of
// bounded rows that act; see joint_system.cpp for loops.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/tasks.hpp"
#include "engine/solvers/joints/joint_system.hpp"

namespace rigor::engine {

template <class S>
class JointGroup {
  public:
    using Real = typename S::Real;

    /// Threads of begin() and solve().
    void useThreads(const Tasks& tasks) { tasks_ = &tasks; }
    /// The joints of these rows, whose directions and softnesses stay until the next begin(). Allocates where
    /// joints came or went.
    void begin(ConstraintRows<S>& constraints);
    bool empty() const { return blocks_.empty(); }
    /// Applies the impulses that the joints' rows start with to the velocities.
    void warmStart(const ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) const;
    /// One pass: changes the joints' impulses and the velocities so that J v + bias + softness lambda
    /// vanishes for equality rows, and bounded rows keep their bounds. Returns the largest residual that it
    /// found [m/s or rad/s]. `constraints` are those of begin().
    Real solve(ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);

    /// Units whose blocks follow each other, for solvers that sweep over them and the contacts: the parts, or all
    /// joints as one unit where parts are interleaved. Threads may solve several at once.
    std::uint32_t unitOf(std::uint32_t block) const { return separate_ ? partOf_[block] : 0; }
    Real solveUnit(std::uint32_t unit, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities) {
        return separate_ ? solvePart(parts_[unit], constraints, velocities) : solve(constraints, velocities);
    }

  private:
    /// A block as the parts depend on it. A body that no impulse moves does not connect joints.
    struct Place {
        std::uint32_t block;
        std::uint32_t a, b;  ///< kNullIndex: moved by no impulse
        BlockKind kind;
        std::uint8_t rows;
        friend bool operator==(const Place&, const Place&) = default;
    };
    /// Joints that are connected by bodies: ranges of the arrays below, the last ones excluded.
    struct Part {
        std::uint32_t block = 0, lastBlock = 0, equality = 0, lastEquality = 0, bounded = 0, lastBounded = 0;
        std::uint32_t system = 0, lastSystem = 0;
        // --- bounded rows that act, joint_group_bounds.cpp
        std::uint32_t numbers = 0;                        ///< equality rows
        std::uint32_t room = 0;                           ///< largest number of acting rows
        std::size_t acting = 0, columns = 0, matrix = 0;  ///< indices of its first ones
        std::uint32_t count = 0;                          ///< acting rows so far
        bool tooMany = false;                             ///< there are more than `room`
    };
    /// An equality block that moves a body which a bounded row moves, too.
    struct Near {
        std::uint32_t equality;  ///< index in equalities_
        bool isEqualityB, isRowB;
    };
    bool findBlocks(const ConstraintRows<S>& constraints);
    void findParts();
    void findSystems();
    void findNear();
    void makeRoom();
    Real solvePart(Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    Real solveInTurn(const Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    Real solveBounded(const Part& part, ConstraintRows<S>& constraints,
                      std::span<Velocity<S>> velocities) const;
    Real solveEqualities(const Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    void applyEqualities(const Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    bool solveActing(Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities,
                     Real& found);
    Real findActing(Part& part, const ConstraintRows<S>& constraints,
                    std::span<const Velocity<S>> velocities);
    void addColumns(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first);
    void findColumn(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t acting);
    void solveColumns(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first,
                      std::uint32_t last);
    void addToMatrix(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first,
                     std::uint32_t last);
    Real* columnOf(const Part& part, std::uint32_t acting) {
        return columns_.data() + part.columns + std::size_t(acting) * part.numbers;
    }
    Real* lanesOf(std::uint32_t equality) {
        return lanes_.data() + firstLane_[system_.partOf(equality)] +
               system_.laneAt(equality) * JointSystem<S>::kLanes;
    }
    void relaxActing(const Part& part);
    void applyActing(const Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities);
    Real sweep(const Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities,
               bool backwards) const;

    static constexpr int kSweeps = 10;                ///< maximum number of sweeps per pass
    static constexpr Real kTolerance = Real(0.01);    ///< relative to the first sweep's residual
    static constexpr std::uint32_t kMostActing = 32;  ///< largest number of acting rows of a part
    static constexpr int kRounds = 4;                 ///< in each, more rows may begin to act
    static constexpr int kPasses = 50;                ///< maximum number of passes over the acting rows
    /// Least mobility that the equality rows leave to a row that acts, relative to its own. Their system has a
    /// shift of 2.4e-5 (double: 3.7e-11).
    static constexpr Real kLeastMobility = sizeof(Real) == sizeof(float) ? Real(1e-4) : Real(1e-9);
    static constexpr std::size_t kGrain = 8;  ///< parts: one takes some microseconds
    const Tasks* tasks_ = &Tasks::one();
    std::vector<Place> places_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> blocks_, equalities_, bounded_;  ///< blocks, part by part, in their order
    std::vector<std::uint32_t> systems_;                        ///< parts of system_, part by part
    std::vector<typename JointSystem<S>::Item> items_;          ///< equality blocks
    std::vector<Real> found_;                                   ///< residual of each part
    std::vector<std::uint32_t> firstNear_;                      ///< bounded row -> its first entry of near_
    std::vector<Near> near_;
    std::vector<std::uint32_t> offset_;  ///< equality block -> its first number in a column
    std::vector<std::uint8_t> acts_;     ///< bounded row -> 1 if it is among the acting ones
    std::vector<std::uint32_t> acting_;  ///< acting rows, as indices of bounded_
    /// Numbers of the acting rows: c, then K^-1 c, a column each; matrix; error, impulse, its change and bounds.
    std::vector<Real> columns_, matrix_, error_, impulse_, change_, lower_, upper_;
    std::vector<Real> lanes_;             ///< some columns, for JointSystem::solveLanes()
    std::vector<std::size_t> firstLane_;  ///< part of system_ -> its first number there
    JointSystem<S> system_;
    std::vector<std::uint32_t> partOf_;  ///< block -> part
    bool separate_ = false;              ///< the blocks of each part follow each other
    bool direct_ = false;                ///< there are factors
    bool changed_ = false;               ///< parts are new
};

}  // namespace rigor::engine
