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
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    JointType type = JointType::Ball;
    std::uint32_t a = 0, b = 0;  ///< dense body indices
    bool collideConnected = false;
    Vec anchorA, anchorB;  ///< vectors from the centres of mass, body axes [m]
    Vec axisA, axisB;      ///< unit, body axes
    Vec perpA1, perpA2;    ///< complete axisA to an orthonormal frame of A (2D: perpA1 alone)
    Vec turnA, turnB;      ///< the axis that B turns about: axisA and axisB, but for a wheel
    Vec turnPerpA1, turnPerpA2;
    Vec turnPerpB1;                ///< vector in B, parallel to turnPerpA1 at angle zero
    typename S::Rot relative;      ///< qA^-1 qB when the joint was made
    Real length = 0;               ///< [m]
    int axisCount = 0;             ///< coordinates
    bool hasLimitOrMotor = false;  ///< some coordinate is locked, limited, or has a motor or spring
    std::array<JointAxis<Real>, kMaxJointAxes> axes;  ///< modes are resolved: none is Usual
    /// Coordinates at the end of the last (sub-)step. An angle over several turns is unwrapped to the value
    /// nearest to this one, which is right as long as no joint turns by half a turn or more in a (sub-)step.
    std::array<Real, kMaxJointAxes> lastCoordinate{};
    Real breakForce = 0, breakTorque = 0;  ///< [N], [N m]; may be infinite
    JointId id;
};

/// Kind of constraint of a joint's row.
enum class RowRole : std::uint8_t {
    Equality,  ///< C = 0
    Limit,     ///< C >= 0: a unilateral stop
    Motor,     ///< J v = speed, with at most maxForce; C is not used
    Spring,    ///< soft C = 0, with stiffness and damping
};
template <class S>
struct RowLaw {
    using Real = typename S::Real;
    RowRole role = RowRole::Equality;
    Real speed = 0;                   ///< motor [m/s] or [rad/s]
    Real maxForce = 0;                ///< motor [N] or [N m], >= 0
    Real stiffness = 0, damping = 0;  ///< spring [N/m, N s/m] or per radian
    Softness<Real> softness;          ///< spring where frequency > 0: instead of stiffness and damping
};

inline constexpr int kMaxRowsPerJoint = 24;  ///< rows of all roles: two limits, motor and spring per
                                             ///< coordinate

/// Jacobian rows and errors of a joint at given poses; equality rows come first. Only lin, angA and angB of
/// the rows are filled. The number and the roles of the rows do not depend on the poses. A joint adds its
/// equality rows, registers its coordinates with coordinate(), and calls addAxisRows.
template <class S>
struct JointRows {
    using Real = typename S::Real;
    int count = 0, equalities = 0;  ///< all rows; equality rows
    std::array<Row<S>, kMaxRowsPerJoint> row;
    std::array<Real, kMaxRowsPerJoint> error;  ///< C, zero when satisfied [m] or [rad]
    std::array<RowLaw<S>, kMaxRowsPerJoint> law;
    /// Coordinates are wanted even where no row needs them.
    bool reading = false;
    int axes = 0;
    std::array<Real, kMaxJointAxes> value;    ///< values of the coordinates [m] or [rad]
    std::array<Row<S>, kMaxJointAxes> along;  ///< their rates are J v of these

    void clear() { count = equalities = axes = 0; }
    bool wantsCoordinates(const Joint<S>& joint) const { return reading || joint.hasLimitOrMotor; }
    /// The next coordinate; the caller fills the row.
    Row<S>& coordinate(Real x) {
        const auto k = static_cast<std::size_t>(axes++);
        value[k] = x;
        along[k].lin.setZero();
        along[k].angA = along[k].angB = zeroAng<S>();
        return along[k];
    }
    Row<S>& add(Real C, const RowLaw<S>& rowLaw = {}) {
        const auto i = static_cast<std::size_t>(count++);
        if (rowLaw.role == RowRole::Equality) equalities = count;
        error[i] = C;
        law[i] = rowLaw;
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
    int axes;  ///< coordinates in this dimension; -1: the joint does not exist in it
    const char* summary;
};
template <class S>
std::span<const JointEntry<S>> jointTable();
/// Throws EngineError "unknown_joint".
template <class S>
const JointEntry<S>& findJoint(JointType type);

/// Appends equality rows that keep the two anchors together (dim rows).
template <class S>
void addAnchorRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Appends equality rows that keep the relative orientation (2D: 1 row, 3D: 3).
template <class S>
void addOrientationRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Appends rows that keep turnA and turnB parallel (2D: none, 3D: 2).
template <class S>
void addParallelRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Appends rows that keep B's anchor on the line through A's anchor along axisA (2D: 1 row, 3D: 2).
template <class S>
void addLineRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Adds the coordinate "travel of B's anchor along t", t a unit vector in A.
template <class S>
void addTravelCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, const typename S::Vec& t,
                         JointRows<S>& out);
/// Adds the coordinate "angle about turnA", counted over turns from joint.lastCoordinate.
template <class S>
void addTurnCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out);
/// Number of the rows that addAxisRows() appends.
struct AxisRowCount {
    int equalities = 0, rows = 0;  ///< equality rows; all rows
};
template <class S>
AxisRowCount countAxisRows(const Joint<S>& joint);
/// Appends the rows of the joint's axes: equality rows, then limits, motors and springs.
template <class S>
void addAxisRows(const Joint<S>& joint, JointRows<S>& out);
/// The value nearest to `last` among angle + n turns [rad].
template <class R>
R unwrapped(R angle, R last) {
    constexpr R turn = R(6.283185307179586);
    return angle + turn * std::round((last - angle) / turn);
}

/// A joint from its definition; poses and centres of mass are those of its bodies now. Throws EngineError:
///     joint_anchor, joint_axis, joint_length    non-finite anchors, axes not unit, length not positive
///     joint_dimension                           no such joint in this dimension
///     joint_axes                                a limit, motor or spring on a coordinate it does not have
///     joint_limits, joint_motor, joint_spring   numbers out of range; motor or spring on a locked coordinate
///     joint_break                               break force or torque not positive
template <class S>
Joint<S> makeJoint(const JointDef<S>& def, const Pose<S>& A, const typename S::Vec& centerA, const Pose<S>& B,
                   const typename S::Vec& centerB);
/// Modes become definite (none is Usual), equal limits a lock. Throws joint_motor, joint_spring as above.
template <class S>
void resolveJointAxes(Joint<S>& joint);
/// Throws as makeJoint for axes[k] of a joint of this type.
template <class S>
void checkJointAxis(JointType type, std::size_t k, const JointAxis<typename S::Real>& axis);

}  // namespace rigor::engine
