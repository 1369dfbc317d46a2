// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Position correction: what removes the errors that velocity constraints leave behind.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "engine/constraints/row.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine {

/// The constraints as position correction sees them, after the bodies have moved.
template <class S>
class PositionProblem {
  public:
    virtual ~PositionProblem() = default;

    /// Number of joint blocks; evaluate() fills rows, error and K^-1 of one at the current poses.
    virtual std::size_t jointCount() const = 0;
    virtual void evaluateJoint(std::size_t index, Block<S>& block, std::span<Row<S>> rows,
                               BlockVector<S>& error, BlockMatrix<S>& inverseK) const = 0;
    /// Normal rows of the contacts that may be corrected, and their separations now to first order in the
    /// motion since the contact was found [m].
    virtual std::size_t contactCount() const = 0;
    virtual const Block<S>& contactBlock(std::size_t index) const = 0;
    virtual const Row<S>& contactRow(std::size_t index) const = 0;
    virtual typename S::Real separation(std::size_t index) const = 0;
    /// Moves the bodies of a block by M^-1 J^T lambda, an impulse times a second [kg m].
    virtual void move(const Block<S>& block, const Row<S>& row, typename S::Real lambda) = 0;
    /// Makes the rotations of earlier moves visible to evaluateJoint.
    virtual void applyRotations() = 0;
};

template <class S>
class PositionCorrection {
  public:
    virtual ~PositionCorrection() = default;
    virtual std::unique_ptr<PositionCorrection> clone() const = 0;
    /// Share of a position error that the velocity rows shall remove in one step (a bias velocity); 0: none.
    virtual typename S::Real biasFactor() const { return 0; }
    /// Called after the bodies have moved.
    virtual void correct(PositionProblem<S>& problem, int iterations, typename S::Real slop) {
        (void)problem, (void)iterations, (void)slop;
    }
};

template <class S>
using PositionCorrectionFactory = std::unique_ptr<PositionCorrection<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<PositionCorrectionFactory<S>>> positionCorrectionTable();

}  // namespace rigor::engine
