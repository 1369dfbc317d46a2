// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of every joint against finite differences of what they measure, and definitions that are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/constraints/joint.hpp"
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
        def.anchorA = vector(1), def.anchorB = vector(1);
        B = {Vec::Zero(), expMap(turn(2))};
        const Vec axis = direction();
        def.axisA = rotateInverse(A.q, axis), def.axisB = rotateInverse(B.q, axis);
        def.spinAxisB = direction();
        def.length = 1.5;
        for (int k = 0; k < findJoint<S>(type).axes; ++k) {
            JointAxis<double>& control = def.axes[static_cast<std::size_t>(k)];
            control.mode = AxisMode::Limited;
            const bool cone = (type == JointType::ConeTwist && k == 1) || type == JointType::Ball;
            if (!cone) control.lower = -0.7;
            control.upper = 0.9;
            if (!cone) control.motorSpeed = 3, control.motorMaxForce = 10;
            control.frequency = 2, control.dampingRatio = 0.5;
        }
        return makeJoint<S>(def, A, Vec::Zero(), B, Vec::Zero());
    }
};
using Spaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(JointRowsOf, Spaces);

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
            // To where the joint holds: turned and moved along its coordinates, anchors together.
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
                continue;  // where anchors are apart, equality rows are exact at C = 0 only
            const Row<S>& row = rows.row[static_cast<std::size_t>(i)];
            EXPECT_NEAR(rowVelocity<S>(row, a, b), 0, 1e-12) << "row " << i;
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
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].frequency = 1, d.axes[0].stiffness = 1; }), "joint_spring");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].dampingRatio = 1; }), "joint_spring");
    EXPECT_EQ(hinge([](auto& d) { d.axes[0].mode = AxisMode::Locked, d.axes[0].motorMaxForce = 1; }),
              "joint_motor");
    EXPECT_EQ(hinge([](auto& d) { d.breakForce = 0; }), "joint_break");
    EXPECT_EQ(hinge([](auto& d) { d.breakTorque = nan; }), "joint_break");
    EXPECT_EQ(hinge([](auto& d) {
                  d.type = JointType::Ball, d.axes[0] = {AxisMode::Limited, -10, 3.2};
              }),
              "joint_limits");
    EXPECT_EQ(hinge([](auto& d) { d.type = JointType::Wheel, d.spinAxisB *= 2; }), "joint_axis");
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
