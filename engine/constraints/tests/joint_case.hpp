// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of every type in random poses, for the tests of their rows.
#pragma once

#include "engine/constraints/joint.hpp"
#include "engine/math/tests/random_values.hpp"

namespace rigor::engine {

template <class S>
class JointCases : public RandomValues<S> {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    /// A definition with random anchors and axes whose coordinates are all free. Poses A and B satisfy it.
    JointDef<S> freeJoint(JointType type, Pose<S>& A, Pose<S>& B) {
        JointDef<S> def;
        def.type = type;
        A = this->pose(2);
        B.q = this->rotation();
        def.anchorA = this->vector(1);
        def.anchorB = this->vector(1);
        const Vec axis = this->direction();
        def.axisA = rotateInverse(A.q, axis);
        def.axisB = rotateInverse(B.q, axis);
        // Normal to the suspension axis, as of a car: the travel then needs no turn.
        def.spinAxisB = rotateInverse(B.q, normalTo(axis));
        def.length = Real(1.5);
        for (int k = 0; k < findJoint<S>(type).axes; ++k) def.axes[k].mode = AxisMode::Free;
        B.p = A.p + rotate(A.q, def.anchorA) - rotate(B.q, def.anchorB);
        return def;
    }
    Joint<S> made(const JointDef<S>& def, const Pose<S>& A, const Pose<S>& B) {
        return makeJoint<S>(def, A, Vec::Zero(), B, Vec::Zero());
    }
    Vec normalTo(const Vec& axis) {
        if constexpr (S::dim == 2) {
            return {-axis.y(), axis.x()};
        } else {
            Vec other = this->direction();
            while (std::abs(other.dot(axis)) > Real(0.9)) other = this->direction();
            return cross(axis, other).normalized();
        }
    }
    /// The rows and coordinates of a joint at two poses.
    JointRows<S> rows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B) {
        JointRows<S> out;
        out.reading = true;
        findJoint<S>(joint.type).evaluate(joint, A, B, out);
        return out;
    }
    static Pose<S> moved(const Pose<S>& X, const Velocity<S>& u, Real h) {
        return {X.p + h * u.v, rotatedBy(X.q, typename S::Ang(h * u.w))};
    }
};

/// B turned by `angle` about `axis` (world, 2D: ignored) through `point`.
template <class S>
Pose<S> turnedAbout(const Pose<S>& X, const typename S::Vec& point, const typename S::Vec& axis,
                    typename S::Real angle) {
    typename S::Ang turn;
    if constexpr (S::dim == 2) {
        turn = angle;
    } else {
        turn = angle * axis;
    }
    const auto q = expMap(turn);
    return {point + rotate(q, typename S::Vec(X.p - point)), normalizedRot(compose(q, X.q))};
}

}  // namespace rigor::engine
