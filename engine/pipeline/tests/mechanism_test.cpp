// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Closed loops with one degree of freedom against their exact kinematics: the crank is where its motor takes
// it, and the other bodies are where the crank's angle says. In 3D the loop of hinges holds three directions
// twice.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

using Point = Eigen::Vector2d;

template <class S>
class Mechanisms : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Mechanisms, Spaces);

/// Thin rods between points in 2D, hinged to each other and to the ground.
template <class S>
struct Mechanism {
    using R = typename S::Real;
    World<S> world{earthByEuler<S>()};
    static Eigen::Vector2d flat(const typename S::Vec& v) { return {double(v[0]), double(v[1])}; }

    BodyId rod(const Point& from, const Point& to, double mass) {
        const Point d = to - from;
        BodyDef<S> body;
        body.mass = static_cast<R>(mass);
        body.inertia = isotropic<S>(mass * d.squaredNorm() / 12);
        const Point middle = 0.5 * (from + to);
        body.pose.p = at<S>(middle.x(), middle.y());
        body.pose.q = expMap(spin<S>(std::atan2(d.y(), d.x())));
        return world.addBody(body);
    }
    /// Adds a hinge at a world point; a null body is the ground.
    JointId hinge(BodyId a, BodyId b, const Point& where, double speed = 0, double torque = 0) {
        const auto local = [&](BodyId id) {
            const typename S::Vec p = at<S>(where.x(), where.y());
            return id ? toLocal<S>(world.pose(id), p) : p;
        };
        JointDef<S> def;
        def.type = JointType::Hinge;
        def.bodyA = a;
        def.bodyB = b;
        def.anchorA = local(a);
        def.anchorB = local(b);
        def.axes[0].motorSpeed = static_cast<R>(speed);
        def.axes[0].motorMaxForce = static_cast<R>(torque);
        return world.addJoint(def);
    }
    Point end(BodyId body, double x) const { return flat(toWorld<S>(world.pose(body), at<S>(x, 0))); }
    double angle(BodyId body) const {
        const Point d = end(body, 1) - end(body, 0);
        return std::atan2(d.y(), d.x());
    }
};

/// The point at distance `rb` from B and `rc` from C, to the left of the way from B to C.
Point meet(const Point& B, const Point& C, double rb, double rc) {
    const Point d = C - B;
    const double l = d.norm(), x = (l * l + rb * rb - rc * rc) / (2 * l), y = std::sqrt(rb * rb - x * x);
    return B + (x * d + y * Point(-d.y(), d.x())) / l;
}

/// Grashof crank-rocker: ground 1.0, crank 0.3, coupler 0.9, rocker 0.7 (0.3 + 1.0 < 0.9 + 0.7).
TYPED_TEST(Mechanisms, FourBarFollowsItsKinematicsOverFourTurns) {
    using S = TypeParam;
    using R = typename S::Real;
    const Point O(0, 0), Q(1, 0);
    const auto joint = [&](double angle) { return Point(0.3 * std::cos(angle), 0.3 * std::sin(angle)); };
    double late[2];
    for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 1.0 / 120 : 1.0 / 480;
        Mechanism<S> m;
        const double start = 0.5;
        const Point P = joint(start), M = meet(P, Q, 0.9, 0.7);
        const BodyId crank = m.rod(O, P, 0.5), coupler = m.rod(P, M, 1), rocker = m.rod(Q, M, 0.8);
        const JointId drive = m.hinge({}, crank, O, 2 * 3.141592653589793, 500);
        m.hinge(crank, coupler, P);
        m.hinge(coupler, rocker, M);
        m.hinge({}, rocker, Q);
        double off = 0, gap = 0, rockerLow = 9, rockerHigh = -9;
        late[k] = 0;
        for (int i = 0; i < static_cast<int>(4 / h + 0.5); ++i) {
            ASSERT_FALSE(m.world.step(R(h)).nonFinite);
            const Point crankEnd = m.end(crank, 0.15), other = m.end(coupler, 0.45);
            const double angle = start + m.world.jointCoordinate(drive);
            const Point exact = meet(joint(angle), Q, 0.9, 0.7);
            off = std::max(off, (other - exact).norm());
            gap = std::max({gap, (m.end(rocker, 0.35) - other).norm(),
                            (m.end(coupler, -0.45) - crankEnd).norm(), m.end(crank, -0.15).norm(),
                            (m.end(rocker, -0.35) - Q).norm()});
            const double swing = m.angle(rocker);
            rockerLow = std::min(rockerLow, swing);
            rockerHigh = std::max(rockerHigh, swing);
            // The motor takes a step to reach its speed from rest and then turns by w h in every step.
            late[k] = std::max(late[k], std::abs(angle - start - 2 * 3.141592653589793 * h * (i + 1)));
        }
        EXPECT_LT(off, tol<S>(1e-9, 1e-4)) << "the loop is closed at every step, whatever h";
        EXPECT_LT(gap, tol<S>(1e-9, 1e-4));
        EXPECT_LT(late[k], tol<S>(1e-5, 2e-3));
        EXPECT_NEAR(m.world.jointCoordinate(drive), 8 * 3.141592653589793, tol<S>(1e-5, 2e-3))
            << "four turns";
        // Dead centres: crank and coupler in line, 1.2 and 0.6 from the crank's centre.
        const auto deadCenter = [](double reach) {
            return 3.141592653589793 - std::acos((1 + 0.49 - reach * reach) / (2 * 0.7));
        };
        EXPECT_NEAR(rockerHigh, deadCenter(0.6), 2e-2 * h * 120);
        EXPECT_NEAR(rockerLow, deadCenter(1.2), 2e-2 * h * 120);
    }
}

/// Slider-crank: x = r cos(a) + sqrt(l^2 - r^2 sin^2(a)), and its speed to first order in h.
TYPED_TEST(Mechanisms, SliderCrankFollowsItsKinematicsOverFourTurns) {
    using S = TypeParam;
    using R = typename S::Real;
    const double r = 0.25, l = 0.8, pi = 3.141592653589793, w = 2 * pi;
    double speedError[2];
    for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 1.0 / 120 : 1.0 / 480;
        Mechanism<S> m;
        const Point O(0, 0), P(r, 0), X(r + l, 0);
        const BodyId crank = m.rod(O, P, 1), rod = m.rod(P, X, 0.5);
        BodyDef<S> block;
        block.mass = 2;
        block.pose.p = at<S>(X.x(), 0);
        const BodyId piston = m.world.addBody(block);
        const JointId drive = m.hinge({}, crank, O, w, 1000);
        m.hinge(crank, rod, P);
        m.hinge(rod, piston, X);
        JointDef<S> rail;
        rail.type = JointType::Slider;
        rail.bodyB = piston;
        rail.anchorA = at<S>(X.x(), 0);
        rail.axisA = rail.axisB = at<S>(1, 0);
        const JointId line = m.world.addJoint(rail);
        double off = 0;
        speedError[k] = 0;
        for (int i = 0; i < static_cast<int>(4 / h + 0.5); ++i) {
            ASSERT_FALSE(m.world.step(R(h)).nonFinite);
            const double a = m.world.jointCoordinate(drive), s = r * std::sin(a),
                         root = std::sqrt(l * l - s * s);
            const double x = r * std::cos(a) + root, v = -w * (r * std::sin(a) + s * r * std::cos(a) / root);
            off = std::max(off, std::abs(m.world.jointCoordinate(line) + r + l - x));
            if (i > 10) speedError[k] = std::max(speedError[k], std::abs(m.world.jointSpeed(line) - v));
        }
        EXPECT_LT(off, tol<S>(1e-9, 1e-4));
        EXPECT_NEAR(m.world.jointCoordinate(drive), 4 * w, tol<S>(1e-5, 2e-3));
    }
    // The velocity is that of the middle of the step: h/2 times the largest acceleration, w^2 r (1 + r/l) at
    // most.
    EXPECT_LT(speedError[0], 0.5 / 120 * w * w * r * (1 + r / l) * 1.05 + tol<S>(0, 1e-2));
    if (sizeof(R) == 8) {
        EXPECT_NEAR(std::log2(speedError[0] / speedError[1]) / 2, 1, 0.05);
    }
}

/// A bridge of twenty rods between two fixed points swings after a push along it and to its side. In 3D its hinges hold
/// three directions twice, whose errors of position do not agree: no impulse can mend them, and none may grow from them
/// beyond the tension of the bridge.
TYPED_TEST(Mechanisms, BridgeTakesNoEndlessImpulses) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr int kRods = 20;
    const double span = 10, sag = 1, h = 1.0 / 60;
    const auto knot = [&](int i) {
        const double u = 2.0 * i / kRods - 1;
        return Point(span * i / kRods, sag * (u * u - 1));
    };
    Mechanism<S> m;
    std::vector<JointId> hinges;
    BodyId last;
    for (int i = 0; i < kRods; ++i) {
        const BodyId rod = m.rod(knot(i), knot(i + 1), 1);
        typename S::Vec push = at<S>(0.2, 0);
        push[S::dim - 1] += R(0.1);
        if (i == kRods / 3) m.world.setVelocity(rod, push, zeroAng<S>());
        hinges.push_back(m.hinge(last, rod, knot(i)));
        last = rod;
    }
    hinges.push_back(m.hinge({}, last, knot(kRods)));
    double largest = 0;
    for (int i = 0; i < 300; ++i) {
        ASSERT_FALSE(m.world.step(R(h)).nonFinite);
        for (const JointId id : hinges)
            for (const R impulse : m.world.jointImpulses(id))
                largest = std::max(largest, std::abs(double(impulse)));
    }
    const double tension = kRods * 9.81 * span / (8 * sag);
    EXPECT_GT(largest, tension * h);
    EXPECT_LT(largest, 10 * tension * h);
}

template <class S>
class LoadedBridge : public testing::Test {};
using Spaces3 = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(LoadedBridge, Spaces3);

/// A truck on a bridge of planks: contacts beside rows that contradict each other by more than the tolerance. Sweeps do not
/// go on over what no impulse can mend, the truck stays on the bridge, and no impulse grows from what the rows contradict.
TYPED_TEST(LoadedBridge, EndsItsSweeps) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr int kPlanks = 20;
    Mechanism<S> m{World<S>(earth<S>())};
    const std::uint32_t wood = m.world.addMaterial(0.5, 0);
    const auto knot = [&](int i) {
        const double u = 2.0 * i / kPlanks - 1;
        return Point(0.96 * i, 2.4 * (u * u - 1));
    };
    std::vector<JointId> hinges;
    BodyId last;
    for (int i = 0; i < kPlanks; ++i) {
        const BodyId plank = m.rod(knot(i), knot(i + 1), 324);
        attach<S>(m.world, plank, Box<S>{{R(0.45), R(0.1), R(1.5)}}, wood);
        hinges.push_back(m.hinge(last, plank, knot(i)));
        last = plank;
    }
    hinges.push_back(m.hinge({}, last, knot(kPlanks)));
    BodyDef<S> def;
    def.mass = 864;
    def.inertia = isotropic<S>(300);
    def.pose.p = {R(7.2), R(-1.1), R(0)};
    const BodyId truck = m.world.addBody(def);
    for (int i = 0; i < 4; ++i) {
        const BodyId wheel = addBall<S>(m.world, i < 2 ? 6.3 : 8.1, -1.3, 0.35, 108, wood);
        const R z(i % 2 == 0 ? 0.85 : -0.85);
        m.world.setPose(wheel, {{R(i < 2 ? 6.3 : 8.1), R(-1.3), z}, m.world.pose(wheel).q});
        JointDef<S> axle;
        axle.type = JointType::Hinge;
        axle.bodyA = truck;
        axle.bodyB = wheel;
        axle.anchorA = {R(i < 2 ? -0.9 : 0.9), R(-0.2), z};
        m.world.addJoint(axle);
    }
    int iterations = 0;
    double largest = 0;
    constexpr int kSteps = 300;
    for (int i = 0; i < kSteps; ++i) {
        const StepResult<S>& step = m.world.step(R(1.0 / 60));
        ASSERT_FALSE(step.nonFinite);
        iterations += step.iterations;
        for (const JointId id : hinges)
            for (const R impulse : m.world.jointImpulses(id))
                largest = std::max(largest, std::abs(double(impulse)));
    }
    // Measured: 14 and 10 a step; 28 in double precision with sweeps that go on.
    EXPECT_LT(iterations, 20 * kSteps);
    // The tension of the bridge with the truck in its middle; measured: 2.3 times that.
    const double span = 0.96 * kPlanks, sag = 2.4, weight = 1296 * 9.81;
    const double tension = kPlanks * 324 * 9.81 * span / (8 * sag) + weight * span / (4 * sag);
    EXPECT_LT(largest, 5 * tension / 60);
    EXPECT_GT(m.world.pose(truck).p[1], -4) << "on the bridge";
}

/// A chain of twenty links let go horizontally: its joints stay together for a minute, in the default
/// settings.
TYPED_TEST(Mechanisms, ChainOfTwentyLinksHoldsForAMinute) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earthByEuler<S>());
    std::vector<BodyId> links;
    for (int i = 0; i < 20; ++i) {
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = isotropic<S>(0.25 / 12);
        body.pose.p = at<S>(0.25 + 0.5 * i, 0);
        const BodyId id = world.addBody(body);
        JointDef<S> j;
        j.bodyA = links.empty() ? BodyId{} : links.back();
        j.bodyB = id;
        j.anchorA = links.empty() ? at<S>(0, 0) : at<S>(0.25, 0);
        j.anchorB = at<S>(-0.25, 0);
        world.addJoint(j);
        links.push_back(id);
    }
    double gap = 0;
    const int seconds = sizeof(R) == 8 && S::dim == 3 ? 60 : 4;
    for (int i = 0; i < 240 * seconds; ++i) {
        ASSERT_FALSE(world.step(R(1.0 / 240)).nonFinite);
        typename S::Vec end = S::Vec::Zero();
        for (const BodyId id : links) {
            gap = std::max(gap, double((toWorld<S>(world.pose(id), at<S>(-0.25, 0)) - end).norm()));
            end = toWorld<S>(world.pose(id), at<S>(0.25, 0));
        }
    }
    // Measured: 4e-15 m and 5e-6 m.
    EXPECT_LT(gap, tol<S>(1e-10, 1e-4));
}

}  // namespace
}  // namespace rigor::engine::test
