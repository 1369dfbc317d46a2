// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints in poses that are known: which motions they leave, what their coordinates measure, when limits are violated.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/constraints/tests/joint_case.hpp"

namespace rigor::engine {
namespace {

template <class S>
class JointCoordinates : public testing::Test, public JointCases<S> {
  public:
    using Real = typename S::Real;
    static constexpr double kTolerance = sizeof(Real) == 8 ? 1e-12 : 2e-5;

    /// A joint whose free coordinates are read at the pose it was made in.
    void make(JointType type) {
        def = this->freeJoint(type, A, B);
        joint = this->made(def, A, B);
    }
    typename S::Vec anchor() const { return toWorld<S>(A, def.anchorA); }
    typename S::Vec axis() const { return rotate(A.q, def.axisA); }
    double value(std::size_t k, const Pose<S>& atB) {
        return static_cast<double>(this->rows(joint, A, atB).value[k]);
    }

    JointDef<S> def;
    Pose<S> A, B;
    Joint<S> joint;
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(JointCoordinates, Spaces);

/// Degrees of freedom that a joint takes from a pair of bodies, all its coordinates free (2D, 3D; -1: not there).
struct Freedoms {
    JointType type;
    int planar, spatial;
};
constexpr Freedoms kTaken[] = {{JointType::Ball, 2, 3},     {JointType::ConeTwist, -1, 3},
                               {JointType::Distance, 0, 0}, {JointType::Fixed, 3, 6},
                               {JointType::Hinge, 2, 5},    {JointType::SixDof, 0, 0},
                               {JointType::Slider, 2, 5},   {JointType::Wheel, 1, 4}};

/// Equality rows of the joint as a matrix over the velocities of both bodies.
template <class S>
Eigen::MatrixXd jacobian(const JointRows<S>& rows) {
    constexpr int spin = S::dim == 3 ? 3 : 1, each = S::dim + spin;
    Eigen::MatrixXd J(rows.equalities, 2 * each);
    for (int i = 0; i < rows.equalities; ++i)
        for (int k = 0; k < 2 * each; ++k) {
            Velocity<S> a, b;
            Velocity<S>& body = k < each ? a : b;
            const int number = k % each;
            if (number < S::dim) {
                body.v[number] = 1;
            } else if constexpr (S::dim == 2) {
                body.w = 1;
            } else {
                body.w[number - 3] = 1;
            }
            J(i, k) = static_cast<double>(rowVelocity<S>(rows.row[i], a, b));
        }
    return J;
}

/// The rows are as many as the degrees of freedom, independent, and satisfied where the joint was made.
TYPED_TEST(JointCoordinates, RowsTakeTheDegreesOfFreedomOfTheirJoint) {
    using S = TypeParam;
    ASSERT_EQ(std::size(kTaken), jointTable<S>().size()) << "a joint is missing in this test";
    for (const Freedoms& taken : kTaken) {
        const int expected = S::dim == 2 ? taken.planar : taken.spatial;
        const JointEntry<S>& entry = findJoint<S>(taken.type);
        SCOPED_TRACE(entry.name);
        ASSERT_EQ(entry.axes < 0, expected < 0);
        if (expected < 0) continue;
        for (int trial = 0; trial < 20; ++trial) {
            this->make(taken.type);
            const JointRows<S> rows = this->rows(this->joint, this->A, this->B);
            ASSERT_EQ(rows.equalities, expected);
            ASSERT_EQ(rows.count, expected);
            ASSERT_EQ(rows.axes, entry.axes);
            for (int i = 0; i < expected; ++i) ASSERT_NEAR(rows.error[i], 0, this->kTolerance);
            if (expected == 0) continue;
            const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian<S>(rows));
            ASSERT_GT(svd.singularValues()(expected - 1), 1e-2) << "rows depend on each other";
        }
    }
}

/// A locked coordinate takes one more degree of freedom: all locked, a six_dof is a fixed joint.
TYPED_TEST(JointCoordinates, LockedCoordinatesAreEqualityRows) {
    using S = TypeParam;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        SCOPED_TRACE(entry.name);
        for (int k = 0; k < entry.axes; ++k) {
            // The angle of a cone can be limited, not locked.
            if (entry.type == JointType::Ball || (entry.type == JointType::ConeTwist && k == 1)) continue;
            this->make(entry.type);
            const int free = this->rows(this->joint, this->A, this->B).equalities;
            const auto axis = static_cast<std::size_t>(k);
            this->def.axes[axis].mode = AxisMode::Locked;
            const Joint<S> locked = this->made(this->def, this->A, this->B);
            const JointRows<S> rows = this->rows(locked, this->A, this->B);
            EXPECT_EQ(rows.equalities, free + 1);
            EXPECT_EQ(rows.count, free + 1);
            const Row<S>& row = rows.row[free];
            EXPECT_EQ(row.lin, rows.along[axis].lin);
            EXPECT_EQ(row.angB, rows.along[axis].angB);
            const auto expected =
                entry.type == JointType::Distance ? rows.value[axis] - this->def.length : rows.value[axis];
            EXPECT_EQ(rows.error[free], expected);
        }
    }
}

TYPED_TEST(JointCoordinates, HingesMeasureTheAngleOverManyTurns) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double sign : {-1.0, 1.0}) {
        this->make(JointType::Hinge);
        for (double angle = 0; angle < 30; angle += 0.7) {
            const Pose<S> turned =
                turnedAbout<S>(this->B, this->anchor(), this->axis(), static_cast<R>(sign * angle));
            const JointRows<S> rows = this->rows(this->joint, this->A, turned);
            ASSERT_NEAR(rows.value[0], sign * angle, 10 * this->kTolerance);
            for (int i = 0; i < rows.equalities; ++i)
                ASSERT_NEAR(rows.error[i], 0, this->kTolerance) << "turning is free";
            this->joint.lastCoordinate = rows.value;
        }
    }
}

TYPED_TEST(JointCoordinates, SlidersAndWheelsMeasureTheTravel) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointType type : {JointType::Slider, JointType::Wheel, JointType::SixDof}) {
        SCOPED_TRACE(findJoint<S>(type).name);
        for (const double travel : {-3.0, -0.2, 0.0, 0.5, 7.0}) {
            this->make(type);
            Pose<S> away = this->B;
            away.p += static_cast<R>(travel) * this->axis();
            const JointRows<S> rows = this->rows(this->joint, this->A, away);
            EXPECT_NEAR(rows.value[0], travel, 4 * this->kTolerance);
            for (int k = 1; k < rows.axes; ++k) EXPECT_NEAR(rows.value[k], 0, 4 * this->kTolerance);
            for (int i = 0; i < rows.equalities; ++i) EXPECT_NEAR(rows.error[i], 0, 4 * this->kTolerance);
            // Off the line the rows of a slider or a wheel measure by how much.
            away.p += static_cast<R>(0.25) * this->normalTo(this->axis());
            const JointRows<S> off = this->rows(this->joint, this->A, away);
            double squared = 0;
            for (int i = 0; i < S::dim - 1; ++i)
                squared += std::pow(type == JointType::SixDof ? off.value[i + 1] : off.error[i], 2);
            EXPECT_NEAR(std::sqrt(squared), 0.25, 4 * this->kTolerance);
        }
    }
}

TYPED_TEST(JointCoordinates, WheelsMeasureTheSpinWhereverTheyTravel) {
    using S = TypeParam;
    using R = typename S::Real;
    this->make(JointType::Wheel);
    const typename S::Vec spin = rotate(this->B.q, this->def.spinAxisB);
    for (double angle = 0; angle < 15; angle += 0.6) {
        const double travel = std::sin(angle);
        Pose<S> rolled = turnedAbout<S>(this->B, this->anchor(), spin, static_cast<R>(angle));
        rolled.p += static_cast<R>(travel) * this->axis();
        const JointRows<S> rows = this->rows(this->joint, this->A, rolled);
        ASSERT_NEAR(rows.value[0], travel, 4 * this->kTolerance);
        ASSERT_NEAR(rows.value[1], angle, 10 * this->kTolerance);
        for (int i = 0; i < rows.equalities; ++i) ASSERT_NEAR(rows.error[i], 0, 4 * this->kTolerance);
        this->joint.lastCoordinate = rows.value;
    }
}

TYPED_TEST(JointCoordinates, DistancesAreThoseOfTheAnchors) {
    using S = TypeParam;
    this->make(JointType::Distance);
    for (int trial = 0; trial < 100; ++trial) {
        const Pose<S> away = this->pose(3);
        const double distance =
            static_cast<double>((toWorld<S>(away, this->def.anchorB) - this->anchor()).norm());
        ASSERT_NEAR(this->value(0, away), distance, 4 * this->kTolerance);
    }
    const JointRows<S> rows = this->rows(this->joint, this->A, this->B);
    ASSERT_NEAR(rows.along[0].lin.norm(), 1, this->kTolerance) << "coinciding anchors still have a direction";
}

/// A swing by phi about any normal of the axis after a twist by tau: both are read back, and the swing's vector too.
TYPED_TEST(JointCoordinates, TwistAndSwingAreReadBack) {
    using S = TypeParam;
    using R = typename S::Real;
    if constexpr (S::dim == 3) {
        for (int trial = 0; trial < 200; ++trial) {
            const double phi = 3.0 * (trial + 0.5) / 200;
            const double twist = static_cast<double>(this->uniform(3));
            this->make(JointType::SixDof);
            const auto swingAxis = this->normalTo(this->axis());
            Pose<S> away = turnedAbout<S>(this->B, this->anchor(), this->axis(), static_cast<R>(twist));
            away = turnedAbout<S>(away, this->anchor(), swingAxis, static_cast<R>(phi));
            const JointRows<S> rows = this->rows(this->joint, this->A, away);
            // The direction of the swing, and with it the twist, is less and less defined near half a turn.
            const double tolerance = 50 * this->kTolerance / (1 + std::cos(phi));
            ASSERT_NEAR(rows.value[3], twist, tolerance);
            const typename S::Vec y = rotate(this->A.q, this->joint.turnPerpA1);
            const typename S::Vec z = rotate(this->A.q, this->joint.turnPerpA2);
            ASSERT_NEAR(rows.value[4], phi * swingAxis.dot(y), tolerance);
            ASSERT_NEAR(rows.value[5], phi * swingAxis.dot(z), tolerance);
            for (const JointType type : {JointType::Ball, JointType::ConeTwist}) {
                JointDef<S> cone = this->def;
                cone.type = type;
                cone.axes[0].mode = cone.axes[1].mode = AxisMode::Free;
                if (type == JointType::Ball) {
                    cone.axes[0].mode = AxisMode::Limited;
                    cone.axes[0].upper = 3;
                    cone.axes[1] = {};
                }
                for (std::size_t k = 2; k < kMaxJointAxes; ++k) cone.axes[k] = {};
                const auto coneRows = this->rows(this->made(cone, this->A, this->B), this->A, away);
                ASSERT_NEAR(coneRows.value[type == JointType::Ball ? 0 : 1], phi, tolerance);
            }
        }
    }
}

/// C >= 0 within the limits, its size the way beyond them, and only the limit's own row is negative.
TYPED_TEST(JointCoordinates, LimitErrorsAreTheWayBeyondTheStop) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double angle : {-1.5, -0.51, -0.49, 0.0, 0.79, 0.81, 2.0}) {
        this->make(JointType::Hinge);
        this->def.axes[0].mode = AxisMode::Limited;
        this->def.axes[0].lower = R(-0.5);
        this->def.axes[0].upper = R(0.8);
        const Joint<S> limited = this->made(this->def, this->A, this->B);
        const Pose<S> turned = turnedAbout<S>(this->B, this->anchor(), this->axis(), static_cast<R>(angle));
        const JointRows<S> rows = this->rows(limited, this->A, turned);
        ASSERT_EQ(rows.count, rows.equalities + 2);
        const auto lower = static_cast<std::size_t>(rows.equalities), upper = lower + 1;
        EXPECT_EQ(rows.law[lower].role, RowRole::Limit);
        EXPECT_EQ(rows.law[upper].role, RowRole::Limit);
        EXPECT_NEAR(rows.error[lower], angle + 0.5, 4 * this->kTolerance);
        EXPECT_NEAR(rows.error[upper], 0.8 - angle, 4 * this->kTolerance);
        // A positive impulse opens a stop: it pushes the coordinate up from the lower, down from the upper one.
        EXPECT_EQ(rows.row[lower].angB, rows.along[0].angB);
        EXPECT_EQ(rows.row[upper].angB, typename S::Ang(-rows.along[0].angB));
    }
}

TYPED_TEST(JointCoordinates, OneSidedLimitsHaveOneRow) {
    using S = TypeParam;
    using R = typename S::Real;
    this->make(JointType::Slider);
    this->def.axes[0].mode = AxisMode::Limited;
    this->def.axes[0].upper = R(2);
    const JointRows<S> rows = this->rows(this->made(this->def, this->A, this->B), this->A, this->B);
    ASSERT_EQ(rows.count, rows.equalities + 1);
    EXPECT_NEAR(rows.error[rows.equalities], 2, this->kTolerance);
    this->def.axes[0].lower = this->def.axes[0].upper;  // equal limits are a lock
    const JointRows<S> locked = this->rows(this->made(this->def, this->A, this->B), this->A, this->B);
    EXPECT_EQ(locked.count, locked.equalities);
    EXPECT_EQ(locked.equalities, rows.equalities + 1);
}

TYPED_TEST(JointCoordinates, MotorsAndSpringsHaveTheLawOfTheirDefinition) {
    using S = TypeParam;
    using R = typename S::Real;
    this->make(JointType::Slider);
    JointAxis<R>& axis = this->def.axes[0];
    axis.motorSpeed = R(-3);
    axis.motorMaxForce = R(40);
    axis.target = R(0.25);
    axis.stiffness = R(100);
    axis.damping = R(2);
    Pose<S> away = this->B;
    away.p += R(1) * this->axis();
    const JointRows<S> rows = this->rows(this->made(this->def, this->A, this->B), this->A, away);
    ASSERT_EQ(rows.count, rows.equalities + 2);
    const auto motor = static_cast<std::size_t>(rows.equalities), spring = motor + 1;
    EXPECT_EQ(rows.law[motor].role, RowRole::Motor);
    EXPECT_EQ(rows.law[motor].speed, R(-3));
    EXPECT_EQ(rows.law[motor].maxForce, R(40));
    EXPECT_EQ(rows.law[spring].role, RowRole::Spring);
    EXPECT_EQ(rows.law[spring].stiffness, R(100));
    EXPECT_EQ(rows.law[spring].damping, R(2));
    EXPECT_NEAR(rows.error[spring], 0.75, 4 * this->kTolerance)
        << "the spring is stretched beyond its target";
    for (const std::size_t i : {motor, spring}) EXPECT_EQ(rows.row[i].lin, rows.along[0].lin);
}

/// The centre of mass of a body is not its origin: anchors are given in the body frame, poses are of the centre.
TYPED_TEST(JointCoordinates, AnchorsAreTakenFromTheCentersOfMass) {
    using S = TypeParam;
    this->make(JointType::Fixed);
    const auto centerA = this->vector(1), centerB = this->vector(1);
    const Pose<S> atA{toWorld<S>(this->A, centerA), this->A.q}, atB{toWorld<S>(this->B, centerB), this->B.q};
    const Joint<S> fixed = makeJoint<S>(this->def, atA, centerA, atB, centerB);
    const JointRows<S> rows = this->rows(fixed, atA, atB);
    for (int i = 0; i < rows.count; ++i) EXPECT_NEAR(rows.error[i], 0, 4 * this->kTolerance);
}

}  // namespace
}  // namespace rigor::engine
