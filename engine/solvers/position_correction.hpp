// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Position correction: what removes the errors that velocity constraints leave behind.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine {

inline constexpr int kMaxPositionRows = 24;  ///< maximum number of rows of one joint

/// The rows of one joint at the current poses: the held ones first, a block of their own, then limits.
/// Motors and springs are no position constraints and are left out.
template <class S>
struct JointPositions {
    Block<S> block;  ///< its bodies; rows = held rows
    int count = 0;   ///< held rows and the others
    /// It has at least `count` rows, few for most joints; their error is C now, their invK that of the row alone.
    std::vector<Row<S>> row;
    std::array<bool, kMaxPositionRows> unilateral{};            ///< a limit: only C < 0 is an error
    std::array<std::uint32_t, kMaxPositionRows> velocityRow{};  ///< the same row among those of the step
    /// A motor that is held: its coordinate has the motor's speed.
    std::array<bool, kMaxPositionRows> driven{};
};

/// The constraints as input of position correction, after the bodies have moved.
template <class S>
class PositionProblem {
  public:
    virtual ~PositionProblem() = default;

    virtual std::size_t jointCount() const = 0;
    virtual void evaluateJoint(std::size_t index, JointPositions<S>& out) const = 0;
    /// Contacts that may be corrected: their blocks, their normal rows (the tangent rows follow it in
    /// memory), and their separations now to first order in the motion since their rows were made [m].
    virtual std::size_t contactCount() const = 0;
    virtual const Block<S>& contactBlock(std::size_t index) const = 0;
    virtual const Row<S>& contactRow(std::size_t index) const = 0;
    virtual typename S::Real separation(std::size_t index) const = 0;
    /// J times the motion of a row's bodies since the rows were made [m] or [rad].
    virtual typename S::Real moved(const Block<S>& block, const Row<S>& row) const = 0;
    /// Moves the bodies of a block by M^-1 J^T lambda, an impulse times a second [kg m].
    virtual void move(const Block<S>& block, const Row<S>& row, typename S::Real lambda) = 0;
    /// Moves a body [m] and turns it, a rotation vector [rad].
    virtual void moveBody(std::uint32_t body, const typename S::Vec& by, const typename S::Ang& turn) = 0;
    /// Makes the rotations of earlier moves visible to evaluateJoint.
    virtual void applyRotations() = 0;
    /// J v of a row, for the velocities that the bodies have now [m/s] or [rad/s].
    virtual typename S::Real velocity(const Block<S>& block, const Row<S>& row) const = 0;
    /// Velocities of the bodies of a joint get the impulses of its held rows times `factor`, in the inertia of the
    /// orientations that the bodies have now.
    virtual void push(const JointPositions<S>& joint, const typename S::Real* impulses,
                      typename S::Real factor) = 0;
};

/// Iterations of position correction. Joint errors are of the order h^2 where a step follows the motion, and few
/// iterations of Newton's method are enough; joints that are further apart have more.
struct PositionIterations {
    int most;
    int usual = most;   ///< enough where the joints are nearly right
    int alone = usual;  ///< the same where neither contacts nor limits move the bodies of connected joints
};

template <class S>
class PositionCorrection {
  public:
    virtual ~PositionCorrection() = default;
    virtual std::unique_ptr<PositionCorrection> clone() const = 0;
    /// Effect of position errors on the velocity rows of the step; by default none.
    virtual BiasRule<typename S::Real> bias() const { return {}; }
    /// Iterations of the velocity solver after the bodies have moved, with relaxed biases; at most as many as
    /// it has before.
    virtual int relaxIterations() const { return 0; }
    /// Called after the bodies have moved. `slop`: overlap that stays [m].
    virtual void correct(PositionProblem<S>& problem, const PositionIterations& iterations,
                         typename S::Real slop) {
        (void)problem;
        (void)iterations;
        (void)slop;
    }

    // --- joints of bodies that have moved for a while without forces, by RATTLE [Andersen1983]: with the rows J_0 of the
    // poses and velocities v_0 before,
    //     q = q_0 + time v,   v = v_0 + M^-1 J_0^T mu,   C(q) = C(q_0)
    // and v is projected onto the tangents at q, so that it has the momentum of v_0 along the joints' free directions. What
    // was wrong in q_0, by rounding for one, is put right after that and becomes no velocity. A correction may give v less of mu.
    /// Whether this correction does so.
    virtual bool drifts() const { return false; }
    /// Called where the bodies move from. False: this correction cannot do it, or not for these joints.
    virtual bool beginDrift(PositionProblem<S>& problem) {
        (void)problem;
        return false;
    }
    /// Called after the bodies have moved over `time` [s], which may be negative, with v_0. `whole`: all of the velocity is
    /// projected; otherwise what mu has changed, and what v_0 has beyond the joints is left in it.
    virtual void endDrift(PositionProblem<S>& problem, typename S::Real time, bool whole,
                          const PositionIterations& iterations) {
        (void)problem;
        (void)time;
        (void)whole;
        (void)iterations;
    }
};

template <class S>
using PositionCorrectionFactory = std::unique_ptr<PositionCorrection<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<PositionCorrectionFactory<S>>> positionCorrectionTable();

}  // namespace rigor::engine
