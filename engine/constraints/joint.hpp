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

/// Directions and errors of a joint at given poses. Only lin, angA and angB of the rows are filled.
template <class S>
struct JointRows {
    int count = 0;
    std::array<Row<S>, kMaxJointRows> row;
    std::array<typename S::Real, kMaxJointRows> error;  ///< C, zero when satisfied [m] or [rad]
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
