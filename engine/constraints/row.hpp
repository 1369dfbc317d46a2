// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows in the middle: joints and contacts produce rows, solvers consume them and know nothing else.
//
// A row couples the velocities of two bodies A and B:
//     J v = lin . (vB - vA) + angA . wA + angB . wB
// and an impulse lambda along it changes them by M^-1 J^T lambda. A row is satisfied where
//     J v + bias + softness lambda = 0,   lower <= lambda <= upper
// (at a bound the equation becomes an inequality: at lower the left side may be > 0, at upper < 0).
// softness > 0 makes a row a damped spring, see soft.hpp. Rows that belong together form a block:
//     Joint    1..6 unbounded rows that one joint holds, K = J M^-1 J^T
//     Bounded  1 row with bounds or softness: a limit, a motor, a spring
//     Contact  row 0: 0 <= lambda _|_ J v + bias + softness lambda >= 0;
//              rows 1..: friction, |lambda_t| <= friction * (lambda_0 + appliedNormal); sticks up to
//              staticFriction instead where that is more
//     Moment   1..2 rows of relative angular velocity at a contact, |lambda| <= friction * (lambda_n +
//              appliedNormal), opposing it; lambda_n is the impulse of row `normal`, of the contact block of
//              the same two bodies that it follows: rolling friction (the tangents; 2D: all) and torsional
//              friction (the normal) [AiChenRotterOoi2011, model A] [AcaryBourrier2021]
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

inline constexpr int kMaxJointRows = 6;  ///< maximum number of rows of a Joint block

template <class S>
struct Row {
    using Real = typename S::Real;
    typename S::Vec lin = S::Vec::Zero();  ///< linear part of the Jacobian for B; A has -lin
    typename S::Ang angA = zeroAng<S>(), angB = zeroAng<S>();
    typename S::Ang invIAngA = zeroAng<S>(), invIAngB = zeroAng<S>();  ///< world inverse inertia times ang
    Real bias = 0;                                                     ///< [m/s] or [rad/s]
    Real softness = 0;                                                 ///< >= 0 [1/kg] or [1/(kg m^2)]
    Real impulse = 0;                                                  ///< accumulated, [N s] or [N m s]
    Real invK = 0;  ///< effective mass 1 / (J M^-1 J^T + softness) of this row alone
    Real lower = -std::numeric_limits<Real>::infinity();  ///< bounds of the impulse; read for Bounded blocks
    Real upper = std::numeric_limits<Real>::infinity();
    Real error = 0;  ///< C where the row was made: < 0 for overlap and violated limits [m] or [rad]
    /// Bias and softness once the bodies have moved and the error needs no more velocity
    /// (SolverStyle::relax).
    Real relaxedBias = 0, relaxedSoftness = 0;
};

enum class BlockKind : std::uint8_t { Joint, Bounded, Contact, Moment };
/// True for the kinds that contacts are made of.
constexpr bool isOfContact(BlockKind kind) {
    return kind == BlockKind::Contact || kind == BlockKind::Moment;
}

template <class S>
struct Block {
    using Real = typename S::Real;
    BlockKind kind = BlockKind::Contact;
    std::uint8_t rows = 0;
    std::uint32_t first = 0;     ///< its rows are first .. first + rows - 1
    std::uint32_t a = 0, b = 0;  ///< dense body indices
    Real friction = 0;           ///< contact: Coulomb coefficient of sliding; moment: that of rolling or
                                 ///< torsional friction [m]
    Real staticFriction = 0;     ///< contact: sticks up to this; read where above friction
    Real restitution = 0;        ///< contact: coefficient where it bounces in this step
    Real appliedNormal = 0;      ///< contact: normal impulse on top of row 0's that bounds the friction as
                                 ///< well
    Real invMassA = 0, invMassB = 0;
    Real k11 = 0, k12 = 0, k22 = 0;  ///< contact: K of the friction rows; moment: K
    std::uint32_t matrix = 0;        ///< joint: index of its inverse K
    std::uint32_t normal = 0;        ///< moment: the row whose impulse bounds it
};

/// Inverse of the K of a joint block; the upper left rows x rows part is used.
template <class S>
using BlockMatrix =
    Eigen::Matrix<typename S::Real, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJointRows, kMaxJointRows>;
template <class S>
using BlockVector = Eigen::Matrix<typename S::Real, Eigen::Dynamic, 1, 0, kMaxJointRows, 1>;

template <class S>
struct ConstraintRows {
    std::vector<Row<S>> rows;
    std::vector<Block<S>> blocks;
    std::vector<BlockMatrix<S>> matrices;
    void clear() {
        rows.clear();
        blocks.clear();
        matrices.clear();
    }
    /// Biases and softnesses become the relaxed ones.
    void relax();
};

// The two functions of every sweep are always inlined. Elsewhere the linker picks one of many copies, and the
// speed of a solver would depend on the order of the object files: 4 % of `pgs` in 2D.

/// J v of a row.
template <class S>
[[gnu::always_inline]] inline typename S::Real rowVelocity(const Row<S>& row, const Velocity<S>& a,
                                                           const Velocity<S>& b) {
    return row.lin.dot(b.v - a.v) + dotAng(row.angA, a.w) + dotAng(row.angB, b.w);
}
/// Sum of the sizes of the terms that J v is made of: what its rounding is relative to.
template <class S>
typename S::Real rowMotion(const Row<S>& row, const Velocity<S>& a, const Velocity<S>& b) {
    return std::abs(row.lin.dot(a.v)) + std::abs(row.lin.dot(b.v)) + std::abs(dotAng(row.angA, a.w)) +
           std::abs(dotAng(row.angB, b.w));
}
/// v += M^-1 J^T lambda. Bodies that impulses do not move are not written to: threads share them.
template <class S>
[[gnu::always_inline]] inline void applyRowImpulse(const Row<S>& row, const Block<S>& block,
                                                   typename S::Real lambda, Velocity<S>& a, Velocity<S>& b) {
    if (block.invMassA > 0) {
        a.v -= (block.invMassA * lambda) * row.lin;
        a.w += lambda * row.invIAngA;
    }
    if (block.invMassB > 0) {
        b.v += (block.invMassB * lambda) * row.lin;
        b.w += lambda * row.invIAngB;
    }
}
/// J1 M^-1 J2^T of two rows of one block.
template <class S>
typename S::Real rowCoupling(const Row<S>& r1, const Row<S>& r2, const Block<S>& block) {
    return (block.invMassA + block.invMassB) * r1.lin.dot(r2.lin) + dotAng(r1.angA, r2.invIAngA) +
           dotAng(r1.angB, r2.invIAngB);
}
/// Fills the inverse-inertia products of a row for the block's bodies.
template <class S>
void completeRow(Row<S>& row, const Block<S>& block, const std::vector<typename S::Inertia>& invInertia) {
    row.invIAngA = invInertia[block.a] * row.angA;
    row.invIAngB = invInertia[block.b] * row.angB;
}
/// K = J M^-1 J^T + softness of one row alone; 0 where neither body can follow it.
template <class S>
typename S::Real rowK(const Row<S>& row, const Block<S>& block) {
    return rowCoupling<S>(row, row, block) + row.softness;
}
/// Inverse of K of a joint block; directions that no body can follow (K singular) get no impulse.
template <class S>
void invertBlock(const Row<S>* rows, const Block<S>& block, BlockMatrix<S>& inverse);

}  // namespace rigor::engine
