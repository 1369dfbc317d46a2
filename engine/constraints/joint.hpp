// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: each turns the poses of its two bodies into rows (directions) and errors (C). One file per joint;
// adding one is a file and a line in joints.def.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// A joint in the frames of its bodies' centres of mass.
template <class S>
struct Joint {
    JointType type = JointType::Ball;
    std::uint32_t a = 0, b = 0;  ///< dense body indices
    bool collideConnected = false;
    typename S::Vec anchorA, anchorB;  ///< from the centres of mass, body axes [m]
    typename S::Vec axisA, axisB;      ///< unit, body axes
    typename S::Vec perpA1, perpA2;    ///< with axisA an orthonormal frame of A (2D: perpA1 alone)
    typename S::Rot relative;          ///< qA^-1 qB when the joint was made
    typename S::Real length = 0;       ///< [m]
    JointId id;
};

/// What a row of a joint is for.
enum class RowRole : std::uint8_t {
    Hold,    ///< C = 0
    Limit,   ///< C >= 0: a unilateral stop
    Motor,   ///< J v = speed, as far as maxForce allows; C plays no part
    Spring,  ///< C = 0 softly, by stiffness and damping
};
template <class S>
struct RowLaw {
    using Real = typename S::Real;
    RowRole role = RowRole::Hold;
    Real speed = 0;                   ///< motor [m/s] or [rad/s]
    Real maxForce = 0;                ///< motor [N] or [N m], >= 0
    Real stiffness = 0, damping = 0;  ///< spring [N/m, N s/m] or per radian
    Softness<Real> softness;          ///< spring where frequency > 0: instead of stiffness and damping
};

inline constexpr int kMaxRowsPerJoint = 18;  ///< of all roles

/// Directions and errors of a joint at given poses; rows that hold come first. Only lin, angA and angB of the
/// rows are filled. The number and the roles of the rows do not depend on the poses.
template <class S>
struct JointRows {
    using Real = typename S::Real;
    int count = 0, held = 0;
    std::array<Row<S>, kMaxRowsPerJoint> row;
    std::array<Real, kMaxRowsPerJoint> error;  ///< C, zero when satisfied [m] or [rad]
    std::array<RowLaw<S>, kMaxRowsPerJoint> law;

    void clear() { count = held = 0; }
    Row<S>& add(Real C, const RowLaw<S>& rowLaw = {}) {
        const auto i = static_cast<std::size_t>(count++);
        if (rowLaw.role == RowRole::Hold) held = count;
        error[i] = C, law[i] = rowLaw;
        row[i].lin.setZero();
        row[i].angA = row[i].angB = zeroAng<S>();
        return row[i];
    }
};

template <class S>
using EvaluateJoint = void (*)(const Joint<S>&, const Pose<S>& A, const Pose<S>& B, JointRows<S>&);

/// A line of joints.def.
template <class S>
struct JointEntry {
    JointType type;
    const char* name;
    EvaluateJoint<S> evaluate;
    const char* summary;
};
template <class S>
std::span<const JointEntry<S>> jointTable();
/// The joint's evaluation. Throws EngineError "unknown_joint".
template <class S>
EvaluateJoint<S> findJoint(JointType type);

/// Appends rows that hold the two anchors together (dim rows).
template <class S>
void addAnchorRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Appends rows that hold the relative orientation (2D: 1 row, 3D: 3).
template <class S>
void addOrientationRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);

/// A joint from its definition; poses and centres of mass are those of its bodies now. Throws EngineError for
/// non-finite values, axes that are not unit, lengths that are not positive.
template <class S>
Joint<S> makeJoint(const JointDef<S>& def, const Pose<S>& A, const typename S::Vec& centerA, const Pose<S>& B,
                   const typename S::Vec& centerB);

}  // namespace rigor::engine
