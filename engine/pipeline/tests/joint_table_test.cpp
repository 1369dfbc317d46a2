// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of every joint of the table: it conserves momentum, constrains its coordinates and breaks at its
// limit; the joint of six degrees of freedom reproduces each of the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class JointTable : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(JointTable, Spaces);

/// Turn and inertia in all directions of the space.
template <class S>
typename S::Ang tumble(double x, double y, double z) {
    using R = typename S::Real;
    if constexpr (S::dim == 2)
        return static_cast<R>(z);
    else
        return typename S::Ang(static_cast<R>(x), static_cast<R>(y), static_cast<R>(z));
}
template <class S>
typename S::Vec at3(double x, double y, double z) {
    typename S::Vec v = at<S>(x, y);
    if constexpr (S::dim == 3) v[2] = static_cast<typename S::Real>(z);
    return v;
}

/// Two bodies side by side on one joint with its anchor between them.
template <class S>
struct Pair {
    World<S> world;
    BodyId ids[2];
    JointId joint;
    JointDef<S> def;
    explicit Pair(JointDef<S> joined, const WorldDef<S>& settings = {}, bool fixed = false)
        : world(settings) {
        using R = typename S::Real;
        for (int i = 0; i < 2; ++i) {
            BodyDef<S> body;
            body.type = fixed && i == 0 ? BodyType::Static : BodyType::Dynamic;
            body.mass = static_cast<R>(1 + i);
            body.inertia = isotropic<S>(0.1 * (1 + i));
            body.pose.p = at<S>(i, 0);
            ids[i] = world.addBody(body);
        }
        joined.bodyA = ids[0];
        joined.bodyB = ids[1];
        joined.anchorA = at<S>(0.5, 0);
        joined.anchorB = at<S>(-0.5, 0);
        if (joined.type == JointType::Distance) {
            joined.anchorA = at<S>(0, 0);
            joined.anchorB = at<S>(0, 0);
            joined.length = 1;
        }
        def = joined;
        joint = world.addJoint(joined);
    }
    /// Linear, then angular momentum about the origin.
    std::array<double, 6> momentum() const {
        using Vec3 = Eigen::Vector3d;
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
        for (int i = 0; i < 2; ++i) {
            Vec3 p = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero();
            p.head<S::dim>() = world.pose(ids[i]).p.template cast<double>();
            v.head<S::dim>() = world.velocity(ids[i]).template cast<double>();
            if constexpr (S::dim == 2)
                w.z() = world.angularVelocity(ids[i]);
            else
                w = world.angularVelocity(ids[i]).template cast<double>();
            linear += (1 + i) * v;
            angular += (1 + i) * p.cross(v) + 0.1 * (1 + i) * w;
        }
        return {linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()};
    }
    /// Largest error of a row that the joint holds.
    double drift() const {
        const Joint<S> made = makeJoint<S>(def, {at<S>(0, 0), Pose<S>::identityRot()}, S::Vec::Zero(),
                                           {at<S>(1, 0), Pose<S>::identityRot()}, S::Vec::Zero());
        JointRows<S> rows;
        findJoint<S>(def.type).evaluate(made, world.pose(ids[0]), world.pose(ids[1]), rows);
        double worst = 0;
        for (int i = 0; i < rows.equalities; ++i) worst = std::max(worst, std::abs(double(rows.error[i])));
        return worst;
    }
    void throwBodies() {
        world.setVelocity(ids[0], at3<S>(0.2, 1, 0.3), tumble<S>(0.4, -0.2, 0.5));
        world.setVelocity(ids[1], at3<S>(-0.1, -0.3, 0.1), tumble<S>(-0.5, 0.7, -1));
    }
};

template <class S>
std::vector<JointDef<S>> allJoints() {
    using R = typename S::Real;
    std::vector<JointDef<S>> all;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (entry.axes < 0) continue;
        JointDef<S> def;
        def.type = entry.type;
        if (entry.type == JointType::Slider || entry.type == JointType::Wheel)
            def.axisA = def.axisB = at<S>(1, 0);
        all.push_back(def);
        // The same with all that its coordinates can have.
        if (entry.axes == 0) continue;
        for (std::size_t k = 0; k < static_cast<std::size_t>(entry.axes); ++k) {
            const bool cone = (entry.type == JointType::ConeTwist && k == 1) || entry.type == JointType::Ball;
            def.axes[k] = {AxisMode::Limited, R(-0.2), R(0.2)};
            if (entry.type == JointType::Distance) {
                def.axes[k].lower = R(0.9);
                def.axes[k].upper = R(1.1);
            }
            def.axes[k].frequency = R(1);
            def.axes[k].dampingRatio = R(0.1);
            if (!cone && k == 0) {
                def.axes[k].motorSpeed = R(0.5);
                def.axes[k].motorMaxForce = R(0.5);
            }
        }
        all.push_back(def);
    }
    return all;
}

TYPED_TEST(JointTable, EveryJointConservesMomentumAndHolds) {
    using S = TypeParam;
    for (const JointDef<S>& def : allJoints<S>()) {
        SCOPED_TRACE(std::string(findJoint<S>(def.type).name) + (def.axes[0].hasSpring() ? ", driven" : ""));
        Pair<S> pair(def, euler<S>());
        pair.throwBodies();
        const auto before = pair.momentum();
        double worst = 0, beyond = 0;
        for (int i = 0; i < 240; ++i) {
            pair.world.step(typename S::Real(1.0 / 240));
            worst = std::max(worst, pair.drift());
            for (int k = 0; k < pair.world.jointAxes(pair.joint); ++k) {
                const auto& axis = pair.world.jointAxis(pair.joint, k);
                if (axis.mode != AxisMode::Limited) continue;
                const double x = pair.world.jointCoordinate(pair.joint, k);
                beyond = std::max({beyond, x - axis.upper, axis.lower - x});
            }
        }
        const auto after = pair.momentum();
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(after[k], before[k], tol<S>(1e-12, 1e-4)) << k;
        EXPECT_LT(worst, tol<S>(1e-6, 1e-5));
        EXPECT_LT(beyond, tol<S>(2e-4, 3e-4));
    }
}

/// The weight hangs on the joint: 2 kg carry 19.62 N. Joints that let B fall are loaded sideways instead.
TYPED_TEST(JointTable, EveryJointBreaksAboveItsForceAndNotBelow) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (entry.axes < 0) continue;
        SCOPED_TRACE(entry.name);
        for (const bool breaks : {false, true}) {
            JointDef<S> def;
            def.type = entry.type;
            if (entry.type == JointType::Slider || entry.type == JointType::Wheel)
                def.axisA = def.axisB = at<S>(0, 1);
            def.breakForce = breaks ? R(19) : R(20);
            Pair<S> pair(def, euler<S>(), true);
            // The force is along the line of the anchors, so that the joint carries it without a torque.
            int gone = -1;
            for (int i = 0; i < 50 && gone < 0; ++i) {
                pair.world.applyForce(pair.ids[1], at<S>(19.62, 0), zeroAng<S>());
                const StepResult<S>& result = pair.world.step(R(0.01));
                if (result.broken.empty()) continue;
                gone = i;
                ASSERT_EQ(result.broken.size(), 1u);
                EXPECT_EQ(result.broken[0], pair.joint);
            }
            EXPECT_EQ(gone, breaks ? 0 : -1);
            EXPECT_EQ(pair.world.contains(pair.joint), !breaks);
            if (!breaks) {
                EXPECT_NEAR(pair.world.jointForce(pair.joint)[0], -19.62, tol<S>(1e-6, 1e-2));
                EXPECT_LT(pair.world.velocity(pair.ids[1]).norm(), tol<S>(1e-6, 1e-4));
                continue;
            }
            pair.world.applyForce(pair.ids[1], at<S>(19.62, 0), zeroAng<S>());
            EXPECT_TRUE(pair.world.step(R(0.01)).broken.empty());
            EXPECT_NEAR(pair.world.velocity(pair.ids[1])[0], 0.0981, tol<S>(1e-6, 1e-4)) << "free again";
        }
    }
}

/// A cantilever: 2 kg at 0.5 m load the anchor with 9.81 N m.
TYPED_TEST(JointTable, FixedAndSliderBreakByTorque) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointType type : {JointType::Fixed, JointType::Slider, JointType::SixDof}) {
        for (const bool breaks : {false, true}) {
            JointDef<S> def;
            def.type = type;
            def.axisA = def.axisB = at<S>(1, 0);
            def.breakTorque = breaks ? R(9.7) : R(9.9);
            Pair<S> pair(def, earth<S>(), true);
            for (int i = 0; i < 20; ++i) pair.world.step(R(0.01));
            EXPECT_EQ(pair.world.contains(pair.joint), !breaks) << static_cast<int>(type);
            if (breaks) continue;
            EXPECT_NEAR(spinOf<S>(pair.world.jointTorque(pair.joint)), kGravity, tol<S>(1e-6, 1e-3));
            EXPECT_NEAR(pair.world.jointForce(pair.joint)[1], 2 * kGravity, tol<S>(1e-6, 1e-3));
        }
    }
}

/// Locked alike, six_dof is the joint of fewer freedoms: the same motion under the same forces.
TYPED_TEST(JointTable, SixDofIsEachOfTheOthers) {
    using S = TypeParam;
    using R = typename S::Real;
    struct Case {
        JointType type;
        std::vector<int> free;
    };
    const bool flat = S::dim == 2;
    const std::vector<Case> cases = {
        {JointType::Fixed, {}},
        {JointType::Slider, {0}},
        {JointType::Hinge, flat ? std::vector<int>{2} : std::vector<int>{3}},
        {JointType::Ball, flat ? std::vector<int>{2} : std::vector<int>{3, 4, 5}},
    };
    for (const Case& c : cases) {
        JointDef<S> special, general;
        special.type = c.type;
        general.type = JointType::SixDof;
        const typename S::Vec axis = at3<S>(0.6, 0.8, 0);
        special.axisA = special.axisB = general.axisA = general.axisB = axis;
        for (const int k : c.free) general.axes[k].mode = AxisMode::Free;
        // Both are also driven alike on the first free coordinate.
        if (c.type == JointType::Slider || c.type == JointType::Hinge) {
            JointAxis<R>& one = special.axes[0];
            one = {AxisMode::Limited, R(-0.3), R(0.3)};
            one.motorSpeed = R(2);
            one.motorMaxForce = R(0.2);
            one.frequency = R(2);
            one.dampingRatio = R(0.3);
            general.axes[c.free[0]] = one;
        }
        Pair<S> a(special), b(general);
        a.throwBodies();
        b.throwBodies();
        double apart = 0, moved = 0;
        for (int i = 0; i < 480; ++i) {
            for (Pair<S>* pair : {&a, &b}) {
                pair->world.applyForce(pair->ids[1], at3<S>(std::cos(0.03 * i), 0.5, 0.4),
                                       tumble<S>(0.1, 0.05, 0.2));
                pair->world.step(R(1.0 / 240));
            }
            for (int k = 0; k < 2; ++k) {
                const Pose<S> A = a.world.pose(a.ids[k]), B = b.world.pose(b.ids[k]);
                const auto turn = logMap(compose(B.q, inverse(A.q)));
                apart = std::max({apart, double((A.p - B.p).norm()), double(std::sqrt(dotAng(turn, turn)))});
                moved = std::max(moved, double((A.p - at<S>(k, 0)).norm()));
            }
        }
        EXPECT_LT(apart, tol<S>(2e-5, 2e-3)) << findJoint<S>(c.type).name;
        EXPECT_GT(moved, 0.5);
    }
}

/// Far from the origin joints are as exact as near it: places have rounding, their differences have none.
TYPED_TEST(JointTable, WhatAJointIsOffHasNoRoundingOfThePlace) {
    using S = TypeParam;
    using Vec = typename S::Vec;
    using R = typename S::Real;
    const double place = 1024;
    for (const JointType type : {JointType::Ball, JointType::Slider, JointType::Distance}) {
        BodyArrays<S> bodies;
        bodies.pose = {{Vec::Zero(), expMap(zeroAng<S>())},
                       {at3<S>(place, place, 0), expMap(tumble<S>(0.3, 0.2, 0.7))}};
        bodies.invMass = {0, 1};
        JointDef<S> def;
        def.type = type;
        def.anchorA = at3<S>(place + 0.5, place + 0.25, 0);
        def.anchorB = at3<S>(0.3, 0.4, 0);
        def.length = R(0.5);
        typename JointSet<S>::Record record;
        record.joint = makeJoint<S>(def, bodies.pose[0], Vec::Zero(), bodies.pose[1], Vec::Zero());
        record.joint.b = 1;
        record.evaluate = findJoint<S>(type).evaluate;
        JointRows<S> far, near;
        record.evaluateHere(bodies, far);
        bodies.pose[1].p = Vec::Zero();
        record.joint.anchorA -= at3<S>(place, place, 0);
        record.evaluateHere(bodies, near);
        ASSERT_EQ(far.count, near.count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(far.count); ++i)
            EXPECT_NEAR(far.error[i], near.error[i], 4 * std::numeric_limits<R>::epsilon()) << i;
    }
}

}  // namespace
}  // namespace rigor::engine::test
