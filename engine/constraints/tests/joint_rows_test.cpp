// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of every joint against finite differences of what they measure, and definitions that are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/constraints/tests/joint_case.hpp"
#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

template <class S>
class JointRowsOf : public testing::Test {
  public:
    using Vec = typename S::Vec;
    std::mt19937 random{7};

    double uniform(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }
    Vec vector(double size) {
        Vec v;
        for (int i = 0; i < S::dim; ++i) v[i] = uniform(size);
        return v;
    }
    typename S::Ang turn(double size) {
        if constexpr (S::dim == 2)
            return uniform(size);
        else
            return vector(size);
    }
    Vec direction() { return vector(1).normalized(); }
    Pose<S> pose() { return {vector(3), expMap(turn(3))}; }
    Pose<S> moved(const Pose<S>& X, const Velocity<S>& u, double h) {
        return {X.p + h * u.v, rotatedBy(X.q, typename S::Ang(h * u.w))};
    }
    /// A joint with all that it can have: limits, motor and spring on every coordinate.
    Joint<S> joint(JointType type, const Pose<S>& A, Pose<S>& B) {
        JointDef<S> def;
        def.type = type;
        def.anchorA = vector(1);
        def.anchorB = vector(1);
        B = {Vec::Zero(), expMap(turn(2))};
        const Vec axis = direction();
        def.axisA = rotateInverse(A.q, axis);
        def.axisB = rotateInverse(B.q, axis);
        def.spinAxisB = direction();
        def.length = 1.5;
        for (int k = 0; k < findJoint<S>(type).axes; ++k) {
            JointAxis<double>& control = def.axes[k];
            control.mode = AxisMode::Limited;
            const bool cone = (type == JointType::ConeTwist && k == 1) || type == JointType::Ball;
            if (!cone) control.lower = -0.7;
            control.upper = 0.9;
            if (!cone) {
                control.motorSpeed = 3;
                control.motorMaxForce = 10;
            }
            control.frequency = 2;
            control.dampingRatio = 0.5;
        }
        return makeJoint<S>(def, A, Vec::Zero(), B, Vec::Zero());
    }
};
using DoubleSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(JointRowsOf, DoubleSpaces);

/// d/dt of every C = J v, at poses that satisfy what the joint holds and anywhere its coordinates may go.
TYPED_TEST(JointRowsOf, RowsAreTheGradientsOfWhatTheyMeasure) {
    using S = TypeParam;
    constexpr double h = 1e-6;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (entry.axes < 0) continue;
        SCOPED_TRACE(entry.name);
        for (int trial = 0; trial < 50; ++trial) {
            const Pose<S> A = this->pose();
            Pose<S> B;
            const Joint<S> joint = this->joint(entry.type, A, B);
            // B is placed so that the joint holds: turned and moved along its coordinates, anchors together.
            const bool turns = entry.type != JointType::Slider && entry.type != JointType::Fixed;
            const bool travels = entry.type == JointType::Slider || entry.type == JointType::Wheel ||
                                 entry.type == JointType::SixDof || entry.type == JointType::Distance;
            typename S::Ang turn = zeroAng<S>();
            if constexpr (S::dim == 2) {
                if (turns) turn = this->uniform(2);
            } else {
                const bool axis = entry.type == JointType::Hinge || entry.type == JointType::Wheel;
                if (axis)
                    turn = this->uniform(2) * rotate(A.q, joint.turnA);
                else if (turns)
                    turn = this->turn(1);
            }
            B.q = compose(expMap(turn), compose(A.q, joint.relative));
            B.p = A.p + rotate(A.q, joint.anchorA) - rotate(B.q, joint.anchorB);
            if (entry.type == JointType::Slider || entry.type == JointType::Wheel)
                B.p += this->uniform(2) * rotate(A.q, joint.axisA);
            else if (travels)
                B.p += this->vector(1);
            const Velocity<S> u{this->vector(1), this->turn(1)}, v{this->vector(1), this->turn(1)};
            JointRows<S> now, before, after;
            const auto evaluate = entry.evaluate;
            evaluate(joint, A, B, now);
            evaluate(joint, this->moved(A, u, -h), this->moved(B, v, -h), before);
            evaluate(joint, this->moved(A, u, h), this->moved(B, v, h), after);
            ASSERT_EQ(now.count, after.count);
            ASSERT_LE(now.count, kMaxRowsPerJoint);
            ASSERT_LE(now.equalities, kMaxJointRows);
            for (int i = 0; i < now.count; ++i) {
                const auto r = static_cast<std::size_t>(i);
                EXPECT_EQ(now.law[r].role == RowRole::Equality, i < now.equalities)
                    << "equality rows come first";
                if (now.law[r].role == RowRole::Motor) continue;
                EXPECT_NEAR(rowVelocity<S>(now.row[r], u, v), (after.error[r] - before.error[r]) / (2 * h),
                            1e-6 * 50)
                    << "row " << i;
            }
            EXPECT_EQ(now.axes, entry.axes);
            for (std::size_t k = 0; k < static_cast<std::size_t>(now.axes); ++k)
                EXPECT_NEAR(rowVelocity<S>(now.along[k], u, v), (after.value[k] - before.value[k]) / (2 * h),
                            1e-6 * 50)
                    << "coordinate " << k;
        }
    }
}

/// A rigid motion of both bodies changes no coordinate, and the rows have no torque on the pair.
TYPED_TEST(JointRowsOf, RowsPushBothBodiesOppositely) {
    using S = TypeParam;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (entry.axes < 0) continue;
        SCOPED_TRACE(entry.name);
        const Pose<S> A = this->pose();
        Pose<S> B;
        const Joint<S> joint = this->joint(entry.type, A, B);
        B = this->pose();
        JointRows<S> rows;
        entry.evaluate(joint, A, B, rows);
        const typename S::Ang w = this->turn(1);
        const Velocity<S> a{cross(w, A.p), w}, b{cross(w, B.p), w};
        for (int i = 0; i < rows.count; ++i) {
            if (i < rows.equalities)
                continue;  // if the anchors differ, equality rows are exact at C = 0 only
            const Row<S>& row = rows.row[i];
            EXPECT_NEAR(rowVelocity<S>(row, a, b), 0, 1e-12) << "row " << i;
        }
    }
}

template <class S>
class JointRowsAnywhere : public testing::Test, public JointCases<S> {};
TYPED_TEST_SUITE(JointRowsAnywhere, DoubleSpaces);

/// Equality rows whose gradient is exact far from C = 0 too; orientation rows (fixed, slider) and the angles of
/// hinge and wheel are exact only where the joint holds.
int exactRows(JointType type, int dim, int rows) {
    if (type == JointType::Fixed) return dim;
    if (type == JointType::Slider) return dim - 1;
    return rows;
}
bool exactCoordinate(JointType type, int dim, std::size_t k) {
    if (dim == 2) return true;
    return type != JointType::Hinge && !(type == JointType::Wheel && k == 1);
}

/// Poses that violate the joint as much as can be: Jacobians against finite differences of C all the same.
TYPED_TEST(JointRowsAnywhere, AreTheGradientsOfCInAnyPose) {
    using S = TypeParam;
    constexpr double h = 1e-6;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (entry.axes < 0) continue;
        SCOPED_TRACE(entry.name);
        for (int trial = 0; trial < 100; ++trial) {
            Pose<S> A, B;
            JointDef<S> def = this->freeJoint(entry.type, A, B);
            const Joint<S> joint = this->made(def, A, B);
            A = this->pose(2);
            B = this->pose(2);
            const Velocity<S> u{this->vector(1), this->angular(1)}, v{this->vector(1), this->angular(1)};
            const JointRows<S> now = this->rows(joint, A, B);
            const JointRows<S> before = this->rows(joint, this->moved(A, u, -h), this->moved(B, v, -h));
            const JointRows<S> after = this->rows(joint, this->moved(A, u, h), this->moved(B, v, h));
            for (int i = 0; i < exactRows(entry.type, S::dim, now.equalities); ++i) {
                const auto r = static_cast<std::size_t>(i);
                ASSERT_NEAR(rowVelocity<S>(now.row[r], u, v), (after.error[r] - before.error[r]) / (2 * h),
                            1e-7)
                    << "row " << i;
            }
            for (std::size_t k = 0; k < static_cast<std::size_t>(now.axes); ++k) {
                if (!exactCoordinate(entry.type, S::dim, k)) continue;
                const double change = after.value[k] - before.value[k];
                if (std::abs(change) > 1) continue;  // an angle went over half a turn
                // The swing's rate grows without bound towards half a turn.
                const double rate = std::abs(rowVelocity<S>(now.along[k], u, v));
                if (rate > 50) continue;
                ASSERT_NEAR(rowVelocity<S>(now.along[k], u, v), change / (2 * h), 1e-6 * (1 + rate * rate))
                    << "coordinate " << k;
            }
        }
    }
}

template <class S>
Velocity<S> rounded(const Velocity<Space<double, S::dim>>& u) {
    if constexpr (S::dim == 2)
        return {u.v.template cast<float>(), static_cast<float>(u.w)};
    else
        return {u.v.template cast<float>(), u.w.template cast<float>()};
}
template <class S>
Pose<S> rounded(const Pose<Space<double, S::dim>>& X) {
    if constexpr (S::dim == 2)
        return {X.p.template cast<float>(), {static_cast<float>(X.q.c), static_cast<float>(X.q.s)}};
    else
        return {X.p.template cast<float>(), normalizedRot(Eigen::Quaternionf(X.q.template cast<float>()))};
}

/// Rows and errors in single precision are those in double, up to rounding.
TYPED_TEST(JointRowsAnywhere, AreTheSameInBothPrecisions) {
    using D = TypeParam;
    using F = Space<float, D::dim>;
    for (const JointEntry<D>& entry : jointTable<D>()) {
        if (entry.axes < 0) continue;
        SCOPED_TRACE(entry.name);
        for (int trial = 0; trial < 50; ++trial) {
            Pose<D> A, B;
            const JointDef<D> def = this->freeJoint(entry.type, A, B);
            JointDef<F> single;
            single.type = def.type;
            single.anchorA = def.anchorA.template cast<float>();
            single.anchorB = def.anchorB.template cast<float>();
            single.axisA = def.axisA.template cast<float>();
            single.axisB = def.axisB.template cast<float>();
            single.spinAxisB = def.spinAxisB.template cast<float>();
            single.length = static_cast<float>(def.length);
            for (std::size_t k = 0; k < kMaxJointAxes; ++k) single.axes[k].mode = def.axes[k].mode;
            JointCases<F> other;
            Joint<D> joint = this->made(def, A, B);
            Joint<F> singleJoint = other.made(single, rounded<F>(A), rounded<F>(B));
            // Any two normals of an axis will do: the same for both.
            singleJoint.perpA1 = joint.perpA1.template cast<float>();
            singleJoint.perpA2 = joint.perpA2.template cast<float>();
            singleJoint.turnPerpA1 = joint.turnPerpA1.template cast<float>();
            singleJoint.turnPerpA2 = joint.turnPerpA2.template cast<float>();
            singleJoint.turnPerpB1 = joint.turnPerpB1.template cast<float>();
            B = {B.p + this->vector(0.3), rotatedBy(B.q, this->angular(0.5))};
            const JointRows<D> rows = this->rows(joint, A, B);
            const JointRows<F> singles = other.rows(singleJoint, rounded<F>(A), rounded<F>(B));
            ASSERT_EQ(rows.count, singles.count);
            const Velocity<D> u{this->vector(1), this->angular(1)}, v{this->vector(1), this->angular(1)};
            const Velocity<F> uf = rounded<F>(u), vf = rounded<F>(v);
            for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
                ASSERT_NEAR(singles.error[i], rows.error[i], 1e-5) << "row " << i;
                ASSERT_NEAR(rowVelocity<F>(singles.row[i], uf, vf), rowVelocity<D>(rows.row[i], u, v), 1e-5)
                    << "row " << i;
            }
            for (std::size_t k = 0; k < static_cast<std::size_t>(rows.axes); ++k) {
                ASSERT_NEAR(singles.value[k], rows.value[k], 1e-5) << "coordinate " << k;
                ASSERT_NEAR(rowVelocity<F>(singles.along[k], uf, vf), rowVelocity<D>(rows.along[k], u, v),
                            1e-4)
                    << "coordinate " << k;
            }
        }
    }
}

TEST(JointAngles, TwistSurvivesSwingAndCountsTurns) {
    using S = Space3d;
    JointDef<S> def;
    def.type = JointType::ConeTwist;
    Joint<S> joint = makeJoint<S>(def, {}, S::Vec::Zero(), {}, S::Vec::Zero());
    JointRows<S> rows;
    rows.reading = true;
    for (double twist = 0; twist < 20; twist += 0.5) {
        // A swing by 1 rad about an axis in the x-y plane after a twist about z.
        const Eigen::Vector3d swing(std::cos(0.3 * twist), std::sin(0.3 * twist), 0);
        const Pose<S> B{S::Vec::Zero(), compose(expMap(swing), expMap(Eigen::Vector3d(0, 0, twist)))};
        findJoint<S>(def.type).evaluate(joint, {}, B, rows);
        EXPECT_NEAR(rows.value[0], twist, 1e-12);
        EXPECT_NEAR(rows.value[1], 1, 1e-12);
        joint.lastCoordinate = rows.value;
    }
}

template <class S>
std::string refusal(const JointDef<S>& def) {
    try {
        makeJoint<S>(def, {}, S::Vec::Zero(), {}, S::Vec::Zero());
    } catch (const EngineError& error) {
        return error.id();
    }
    return "none";
}

TEST(JointDefinitions, BadOnesAreRefusedById) {
    using S = Space3d;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto hinge = [](auto change) {
        JointDef<S> def;
        def.type = JointType::Hinge;
        change(def);
        return refusal<S>(def);
    };
    EXPECT_EQ(hinge([](auto&) {}), "none");
    EXPECT_EQ(hinge([](auto& d) { d.anchorA.x() = nan; }), "joint_anchor");
    EXPECT_EQ(hinge([](auto& d) { d.axisA *= 2; }), "joint_axis");
    EXPECT_EQ(hinge([](auto& d) { d.axes[1].motorMaxForce = 1; }), "joint_axes");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0] = {AxisMode::Limited, 1, -1}; }), "joint_limits");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0] = {AxisMode::Limited, nan, 1}; }), "joint_limits");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].motorMaxForce = -1; }), "joint_motor");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].motorSpeed = nan; }), "joint_motor");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].frequency = -1; }), "joint_spring");
    EXPECT_EQ(hinge([](auto& d) {
                  d.axes[0].frequency = 1;
                  d.axes[0].stiffness = 1;
              }),
              "joint_spring");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].dampingRatio = 1; }), "joint_spring");
    EXPECT_EQ(hinge([](auto& d) {
                  d.axes[0].mode = AxisMode::Locked;
                  d.axes[0].motorMaxForce = 1;
              }),
              "joint_motor");
    EXPECT_EQ(hinge([](auto& d) { d.breakForce = 0; }), "joint_break");
    EXPECT_EQ(hinge([](auto& d) { d.breakTorque = nan; }), "joint_break");
    EXPECT_EQ(hinge([](auto& d) {
                  d.type = JointType::Ball;
                  d.axes[0] = {AxisMode::Limited, -10, 3.2};
              }),
              "joint_limits");
    EXPECT_EQ(hinge([](auto& d) {
                  d.type = JointType::Wheel;
                  d.spinAxisB *= 2;
              }),
              "joint_axis");
    JointDef<S> rod;
    rod.type = JointType::Distance;
    EXPECT_EQ(refusal<S>(rod), "joint_length");
    rod.length = 1;
    EXPECT_EQ(refusal<S>(rod), "none");
    rod.axes[0].frequency = 2;
    EXPECT_EQ(refusal<S>(rod), "joint_spring") << "a rod has no spring; a free distance has";
    JointDef<Space2d> flat;
    flat.type = JointType::ConeTwist;
    EXPECT_EQ(refusal<Space2d>(flat), "joint_dimension");
}

}  // namespace
}  // namespace rigor::engine
