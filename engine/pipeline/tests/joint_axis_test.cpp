// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Limits, motors and springs of joints against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

constexpr double kPi = 3.141592653589793;

template <class S>
class JointAxes : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(JointAxes, Spaces);

template <class S>
typename S::Vec along(double x, double y) {
    return at<S>(x, y);
}

/// A body on one joint to the world, the joint's anchor at the body's centre: mass 2, inertia 0.5.
template <class S>
struct OneBody {
    using R = typename S::Real;
    World<S> world;
    BodyId body;
    JointId joint;
    OneBody(const WorldDef<S>& settings, JointDef<S> def, double x = 0, double y = 0, double vx = 0,
            double vy = 0, double w = 0)
        : world(settings) {
        BodyDef<S> b;
        b.mass = 2;
        b.inertia = isotropic<S>(0.5);
        b.pose.p = at<S>(x, y);
        b.velocity = at<S>(vx, vy);
        b.angularVelocity = spin<S>(w);
        body = world.addBody(b);
        def.bodyB = body;
        joint = world.addJoint(def);
    }
    void run(int steps, double h) {
        for (int i = 0; i < steps; ++i) world.step(static_cast<R>(h));
    }
};

template <class S>
JointDef<S> hinge() {
    JointDef<S> def;
    def.type = JointType::Hinge;
    return def;
}
template <class S>
JointDef<S> slider(double x, double y) {
    JointDef<S> def;
    def.type = JointType::Slider;
    def.axisA = def.axisB = along<S>(x, y);
    return def;
}

/// w grows by T h / I in each step until the speed is reached, to the last bit of the precision.
TYPED_TEST(JointAxes, MotorAcceleratesByItsTorqueAndHoldsItsSpeed) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def = hinge<S>();
    def.axes[0].motorSpeed = 10;
    def.axes[0].motorMaxForce = R(0.8);
    OneBody<S> one(euler<S>(), def);
    const double h = 1.0 / 100, a = 0.8 / 0.5;
    for (int i = 1; i <= 800; ++i) {
        one.world.step(static_cast<R>(h));
        EXPECT_NEAR(spinOf<S>(one.world.angularVelocity(one.body)), std::min(a * h * i, 10.0),
                    tol<S>(1e-12, 1e-4));
    }
    EXPECT_NEAR(one.world.jointSpeed(one.joint), 10, tol<S>(1e-12, 2e-5));
    // Angles count turns: h * sum of the speeds.
    double angle = 0;
    for (int i = 1; i <= 800; ++i) angle += h * std::min(a * h * i, 10.0);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), angle, tol<S>(1e-10, 2e-3));
    // A new speed while running; the torque is reported.
    one.world.setJointMotor(one.joint, 0, R(-5), R(2));
    one.world.step(static_cast<R>(h));
    EXPECT_NEAR(spinOf<S>(one.world.angularVelocity(one.body)), 10 - 4 * h, tol<S>(1e-12, 2e-5));
    EXPECT_NEAR(spinOf<S>(one.world.jointTorque(one.joint)), -2, tol<S>(1e-10, 1e-4));
}

/// A lift of weight 19.62 N: below that the motor stalls and the load falls with a = g - F/m.
TYPED_TEST(JointAxes, MotorStallsAtItsLargestForce) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def = slider<S>(0, 1);
    def.axes[0].motorSpeed = 3;
    def.axes[0].motorMaxForce = R(15);
    OneBody<S> one(earth<S>(), def);
    one.run(100, 0.01);
    EXPECT_NEAR(one.world.velocity(one.body)[1], -(kGravity - 7.5), tol<S>(1e-10, 1e-4));
    EXPECT_NEAR(one.world.jointForce(one.joint)[1], 15, tol<S>(1e-10, 1e-3));
    one.world.setJointMotor(one.joint, 0, R(3), R(25));
    one.run(300, 0.01);
    EXPECT_NEAR(one.world.velocity(one.body)[1], 3, tol<S>(1e-10, 1e-5));
    EXPECT_NEAR(one.world.jointForce(one.joint)[1], 2 * kGravity, tol<S>(1e-9, 1e-2));
}

/// A rod released from horizontal falls on a stop at -30 degrees, loses its speed there, and rests with the
/// torque of its weight.
TYPED_TEST(JointAxes, HingeLimitStopsAndCarries) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def = hinge<S>();
    def.anchorB = at<S>(-0.5, 0);
    def.axes[0].mode = AxisMode::Limited;
    def.axes[0].lower = R(-kPi / 6);
    def.axes[0].upper = R(0.1);
    OneBody<S> one(earth<S>(), def, 0.5, 0);
    double deepest = 0, energyBefore = 0, landed = -1;
    const auto energy = [&] {
        const auto w = one.world.angularVelocity(one.body);
        return one.world.velocity(one.body).squaredNorm() + 0.25 * dotAng(w, w) +
               2 * kGravity * one.world.pose(one.body).p[1];
    };
    for (int i = 0; i < 240; ++i) {
        one.world.step(R(1.0 / 240));
        const double angle = one.world.jointCoordinate(one.joint);
        deepest = std::min(deepest, angle + kPi / 6);
        if (landed < 0 && angle < -kPi / 6 + 1e-4) landed = (i + 1) / 240.0;
        if (i < 240) energyBefore = std::max(energyBefore, double(energy()));
    }
    EXPECT_GT(deepest, tol<S>(-1e-9, -1e-5)) << "stays above the stop";
    EXPECT_LT(energyBefore, 0.09) << "h/2 of power at most: the middle of the step";
    EXPECT_NEAR(one.world.jointSpeed(one.joint), 0, tol<S>(1e-9, 1e-4));
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), -kPi / 6, tol<S>(1e-9, 1e-5));
    // T = quarter-period-like fall: t = integral d(theta) / sqrt(2 m g l sin(theta) / I), I = 1.0.
    double t = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {  // u^2 = theta removes the singularity at the start
        const double u = std::sqrt(kPi / 6) * (i + 0.5) / n, theta = u * u;
        t += 2 * u / std::sqrt(2 * 2 * kGravity * 0.5 * std::sin(theta) / 1.0) * std::sqrt(kPi / 6) / n;
    }
    EXPECT_NEAR(landed, t, 1.5 / 240);
    // Torque about the hinge: m g l cos(30 deg), by the stop; force: the weight.
    EXPECT_NEAR(spinOf<S>(one.world.jointTorque(one.joint)), 2 * kGravity * 0.5 * std::cos(kPi / 6),
                tol<S>(1e-6, 3e-2));
    EXPECT_NEAR(one.world.jointForce(one.joint)[1], 2 * kGravity, tol<S>(1e-6, 3e-2));
}

TYPED_TEST(JointAxes, HingeLimitBeyondATurnIsMetAfterThatManyTurns) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double sign : {1.0, -1.0}) {
        JointDef<S> def = hinge<S>();
        def.axes[0].mode = AxisMode::Limited;
        def.axes[0].lower = R(-5 * kPi);
        def.axes[0].upper = R(5 * kPi);
        OneBody<S> one(WorldDef<S>{}, def, 0, 0, 0, 0, sign * 10);
        one.run(100, 0.01);
        EXPECT_NEAR(one.world.jointCoordinate(one.joint), sign * 10, tol<S>(1e-9, 1e-4));
        one.run(100, 0.01);
        EXPECT_NEAR(one.world.jointCoordinate(one.joint), sign * 5 * kPi, tol<S>(1e-9, 1e-4));
        EXPECT_NEAR(spinOf<S>(one.world.angularVelocity(one.body)), 0, tol<S>(1e-9, 1e-4));
    }
}

TYPED_TEST(JointAxes, SliderStaysWithinItsLimits) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def = slider<S>(1, 0);
    def.axes[0].mode = AxisMode::Limited;
    def.axes[0].lower = R(-0.5);
    def.axes[0].upper = R(0.25);
    OneBody<S> one(WorldDef<S>{}, def, 0, 0, 2);
    one.run(12, 0.01);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), 0.24, tol<S>(1e-12, 1e-6));
    one.run(20, 0.01);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), 0.25, tol<S>(1e-12, 1e-6));
    EXPECT_NEAR(one.world.velocity(one.body)[0], 0, tol<S>(1e-12, 1e-6));
    one.world.setVelocity(one.body, at<S>(-30, 0), zeroAng<S>());
    one.run(20, 0.01);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), -0.5, tol<S>(1e-12, 1e-6));
}

/// Every spring's own discrete law: v' = (v - h w^2 x) / (1 + 2 zeta w h + h^2 w^2), x' = x + h v', exactly;
/// and the damped oscillator at first order in h.
template <class S>
void expectOscillator(const JointDef<S>& def, int axis, double x0, double (*read)(const OneBody<S>&),
                      double frequency, double zeta, double h, double& exactError, double startX = 0,
                      double startY = 0, double startAngle = 0) {
    using R = typename S::Real;
    OneBody<S> one(euler<S>(), def, startX, startY);
    (void)startAngle;
    one.world.setJointTarget(one.joint, axis, static_cast<R>(-x0));
    const double w = 2 * kPi * frequency, wd = w * std::sqrt(1 - zeta * zeta);
    double x = x0, v = 0;
    exactError = 0;
    for (int i = 1; i * h < 2; ++i) {
        one.world.step(static_cast<R>(h));
        v = (v - h * w * w * x) / (1 + 2 * zeta * w * h + h * h * w * w);
        x += h * v;
        const double found = read(one) + x0;
        ASSERT_NEAR(found, x, tol<S>(1e-9, 2e-4)) << "step " << i;
        const double t = i * h;
        const double exact =
            x0 * std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
        exactError = std::max(exactError, std::abs(found - exact));
    }
}

TYPED_TEST(JointAxes, SpringsAreTheImplicitOscillatorOfTheirFrequencyAndDamping) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto readAxis = [](const OneBody<S>& one) { return double(one.world.jointCoordinate(one.joint)); };
    for (const JointType type :
         {JointType::Hinge, JointType::Slider, JointType::Distance, JointType::Wheel, JointType::SixDof}) {
        SCOPED_TRACE(static_cast<int>(type));
        JointDef<S> def;
        def.type = type;
        double startX = 0;
        if (type != JointType::Hinge) def.axisA = def.axisB = along<S>(1, 0);
        if (type == JointType::Distance) {
            def.length = 2;
            startX = 2;
        }
        def.axes[0].mode = AxisMode::Free;
        def.axes[0].frequency = R(1.5);
        def.axes[0].dampingRatio = R(0.2);
        double errors[2];
        for (int k = 0; k < 2; ++k) {
            const double h = k == 0 ? 1.0 / 200 : 1.0 / 800;
            if (type == JointType::Distance) {
                // The anchor moves along x from the origin: the target is a length.
                OneBody<S> one(euler<S>(), def, startX);
                one.world.setJointTarget(one.joint, 0, R(1.7));
                const double w = 2 * kPi * 1.5, zeta = 0.2, wd = w * std::sqrt(1 - zeta * zeta);
                double x = 0.3, v = 0;
                errors[k] = 0;
                for (int i = 1; i * h < 2; ++i) {
                    one.world.step(static_cast<R>(h));
                    v = (v - h * w * w * x) / (1 + 2 * zeta * w * h + h * h * w * w);
                    x += h * v;
                    ASSERT_NEAR(readAxis(one) - 1.7, x, tol<S>(1e-9, 2e-4));
                    const double t = i * h, exact = 0.3 * std::exp(-zeta * w * t) *
                                                    (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
                    errors[k] = std::max(errors[k], std::abs(x - exact));
                }
            } else {
                expectOscillator<S>(def, 0, 0.3, readAxis, 1.5, 0.2, h, errors[k]);
            }
        }
        EXPECT_NEAR(std::log2(errors[0] / errors[1]) / 2, 1, 0.15);
    }
}

/// A door's spring by its frequency: what swings is the moment about the hinge, whatever the body's own is.
TYPED_TEST(JointAxes, ASpringsFrequencyIsThatOfWhatTheJointLetsMove) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def;
    def.type = JointType::Hinge;
    def.anchorB = at<S>(-0.9, 0);
    def.axes[0].frequency = R(1.5);
    def.axes[0].dampingRatio = R(0.2);
    def.axes[0].target = R(0.3);
    const double w = 2 * kPi * 1.5, zeta = 0.2, wd = w * std::sqrt(1 - zeta * zeta);
    double errors[2] = {};
    for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 1.0 / 200 : 1.0 / 800;
        OneBody<S> one(euler<S>(), def, 0.9);
        for (int i = 1; i * h < 2; ++i) {
            one.world.step(static_cast<R>(h));
            const double t = i * h, exact = -0.3 * std::exp(-zeta * w * t) *
                                            (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
            errors[k] =
                std::max(errors[k], std::abs(double(one.world.jointCoordinate(one.joint)) - 0.3 - exact));
        }
    }
    EXPECT_LT(errors[1], 0.01) << "by its own moment alone it would swing at half the frequency";
    EXPECT_NEAR(std::log2(errors[0] / errors[1]) / 2, 1, 0.2);
}

/// The same where the joint itself is soft: its softness grows as the step shrinks, the door's moment does
/// not.
TYPED_TEST(JointAxes, ASpringsFrequencyDoesNotDependOnHowSoftTheJointIs) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def;
    def.type = JointType::Hinge;
    def.anchorB = at<S>(-0.9, 0);
    def.axes[0].frequency = R(1.5);
    def.axes[0].dampingRatio = R(0.2);
    def.axes[0].target = R(0.3);
    WorldDef<S> settings;
    settings.solver = "tgs_soft";
    const double w = 2 * kPi * 1.5, zeta = 0.2, wd = w * std::sqrt(1 - zeta * zeta);
    for (const double h : {1.0 / 100, 1.0 / 400}) {
        OneBody<S> one(settings, def, 0.9);
        double error = 0;
        for (int i = 1; i * h < 2; ++i) {
            one.world.step(static_cast<R>(h));
            const double t = i * h, exact = -0.3 * std::exp(-zeta * w * t) *
                                            (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
            error = std::max(error, std::abs(double(one.world.jointCoordinate(one.joint)) - 0.3 - exact));
        }
        EXPECT_LT(error, 0.005 * h * 400) << "h = " << h;
    }
}

/// k = m w^2 and c = 2 zeta m w by hand is the same spring.
TYPED_TEST(JointAxes, StiffnessAndDampingAreTheSameSpring) {
    using S = TypeParam;
    using R = typename S::Real;
    const double w = 2 * kPi * 1.5;
    JointDef<S> one = slider<S>(1, 0), other = one;
    one.axes[0].frequency = R(1.5);
    one.axes[0].dampingRatio = R(0.2);
    one.axes[0].target = R(0.4);
    other.axes[0].stiffness = R(2 * w * w);
    other.axes[0].damping = R(2 * 0.2 * 2 * w);
    other.axes[0].target = R(0.4);
    OneBody<S> a(WorldDef<S>{}, one), b(WorldDef<S>{}, other);
    for (int i = 0; i < 200; ++i) {
        a.run(1, 0.005);
        b.run(1, 0.005);
        ASSERT_NEAR(a.world.pose(a.body).p[0], b.world.pose(b.body).p[0], tol<S>(1e-12, 1e-5));
    }
    EXPECT_GT(std::abs(a.world.pose(a.body).p[0]), 0.1);
    // A spring carries a weight where k x = m g.
    OneBody<S> hung(earth<S>(), [&] {
        JointDef<S> def = slider<S>(0, 1);
        def.axes[0].stiffness = R(100);
        def.axes[0].damping = R(20);
        return def;
    }());
    hung.run(1000, 0.01);
    EXPECT_NEAR(hung.world.jointCoordinate(hung.joint), -2 * kGravity / 100, tol<S>(1e-9, 1e-5));
}

/// Thrown up inside its rope a body flies freely; taut the rope is a rod.
TYPED_TEST(JointAxes, RopeIsSlackThenTaut) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def;
    def.type = JointType::Distance;
    def.length = 1;
    def.axes[0].mode = AxisMode::Limited;
    def.axes[0].upper = 1;
    OneBody<S> one(earthByEuler<S>(), def, 0.5, 0, 0, 1);
    const double h = 1.0 / 240;
    double y = 0, v = 1;
    int i = 0;
    for (; i < 60; ++i) {
        one.world.step(R(h));
        v -= h * kGravity;
        y += h * v;
        ASSERT_NEAR(one.world.pose(one.body).p[1], y, tol<S>(1e-11, 1e-5)) << "free flight while slack";
        EXPECT_EQ(one.world.jointForce(one.joint).norm(), R(0));
    }
    double longest = 0, energy = 0;
    for (; i < 960; ++i) {
        one.world.step(R(h));
        longest = std::max(longest, double(one.world.jointCoordinate(one.joint)));
        const double now =
            one.world.velocity(one.body).squaredNorm() + 2 * kGravity * one.world.pose(one.body).p[1];
        if (i == 480) energy = now;
    }
    EXPECT_LT(longest, 1 + tol<S>(1e-8, 1e-5));
    EXPECT_GT(longest, 1 - 1e-4) << "or it was never taut";
    const double last =
        one.world.velocity(one.body).squaredNorm() + 2 * kGravity * one.world.pose(one.body).p[1];
    EXPECT_NEAR(last, energy, 0.15)
        << "two seconds as a pendulum, taut: the energy of the middle of the step";
    EXPECT_LT(energy, 2 * kGravity * 0.1) << "the jerk took the radial speed";
}

TYPED_TEST(JointAxes, ShortestDistanceHolds) {
    using S = TypeParam;
    JointDef<S> def;
    def.type = JointType::Distance;
    def.length = 1;
    def.axes[0].mode = AxisMode::Limited;
    def.axes[0].lower = typename S::Real(0.6);
    def.axes[0].upper = typename S::Real(1.5);
    OneBody<S> one(WorldDef<S>{}, def, 1, 0, -2, 0.5);
    double shortest = 9, longest = 0;
    for (int i = 0; i < 400; ++i) {
        one.run(1, 0.005);
        shortest = std::min(shortest, double(one.world.jointCoordinate(one.joint)));
        longest = std::max(longest, double(one.world.jointCoordinate(one.joint)));
    }
    EXPECT_GT(shortest, 0.6 - tol<S>(1e-6, 1e-5));
    EXPECT_LT(shortest, 0.6 + 1e-3);
    EXPECT_LT(longest, 1.5 + tol<S>(1e-6, 1e-5));
    EXPECT_GT(longest, 1.5 - 1e-3);
}

/// A ball joint with a cone: thrown against it, a rod comes to rest on the cone's mantle.
template <class S>
class JointAxes3 : public testing::Test {};
using Solid = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(JointAxes3, Solid);

TYPED_TEST(JointAxes3, ConeLimitHolds) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointType type : {JointType::Ball, JointType::ConeTwist}) {
        JointDef<S> def;
        def.type = type;
        def.anchorB = at<S>(0, 0.5);
        def.axisA = def.axisB = at<S>(0, -1);
        const int cone = type == JointType::Ball ? 0 : 1;
        def.axes[cone] = {AxisMode::Limited, -1, R(0.6)};
        OneBody<S> one(earth<S>(), def, 0, -0.5);
        double widest = 0;
        for (int i = 0; i < 2000; ++i) {
            one.world.applyForce(one.body, {R(30 * std::cos(0.01 * i)), 0, R(30 * std::sin(0.01 * i))},
                                 {0, 0, 0});
            one.run(1, 0.005);
            widest = std::max(widest, double(one.world.jointCoordinate(one.joint, cone)));
        }
        EXPECT_LT(widest, 0.6 + tol<S>(2e-4, 5e-4));
        EXPECT_GT(widest, 0.599) << "or the limit was never met";
        EXPECT_LT(one.world.jointForce(one.joint).norm(), 100);
    }
}

TYPED_TEST(JointAxes3, TwistLimitHoldsUnderSwing) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def;
    def.type = JointType::ConeTwist;
    def.axisA = def.axisB = at<S>(0, 1);
    def.axes[0] = {AxisMode::Limited, R(-0.5), R(0.8)};
    def.axes[1] = {AxisMode::Limited, -1, R(1)};
    OneBody<S> one(WorldDef<S>{}, def);
    double most = -9, least = 9, widest = 0;
    for (int i = 0; i < 1500; ++i) {
        const R side = i < 750 ? R(1) : R(-1);
        one.world.applyForce(one.body, S::Vec::Zero(), {R(0.3 * std::cos(0.02 * i)), side, R(0.2)});
        one.run(1, 0.005);
        most = std::max(most, double(one.world.jointCoordinate(one.joint, 0)));
        least = std::min(least, double(one.world.jointCoordinate(one.joint, 0)));
        widest = std::max(widest, double(one.world.jointCoordinate(one.joint, 1)));
    }
    EXPECT_NEAR(most, 0.8, 2e-3);
    EXPECT_NEAR(least, -0.5, 2e-3);
    EXPECT_LT(widest, 1 + 1e-3);
    EXPECT_GT(widest, 0.2);
}

/// An isotropic body twisted and swung on springs: both are oscillators of their own.
TYPED_TEST(JointAxes3, TwistMotorAndSwingSpring) {
    using S = TypeParam;
    using R = typename S::Real;
    JointDef<S> def;
    def.type = JointType::ConeTwist;
    def.axisA = def.axisB = at<S>(0, 1);
    def.axes[0].motorSpeed = 2;
    def.axes[0].motorMaxForce = R(0.5);
    OneBody<S> turned(WorldDef<S>{}, def);
    turned.run(300, 0.01);
    EXPECT_NEAR(turned.world.jointSpeed(turned.joint, 0), 2, tol<S>(1e-9, 1e-5));
    EXPECT_NEAR(turned.world.jointCoordinate(turned.joint, 0), 2 * 3 - 0.5 * 2 * 2, 0.011);

    def.axes[0] = {};
    def.axes[1].frequency = R(2);
    def.axes[1].dampingRatio = R(0.1);
    OneBody<S> swung(euler<S>(), def);
    swung.world.setVelocity(swung.body, S::Vec::Zero(), {R(0.5), 0, 0});
    // phi of a spring pendulum about one axis: signed here.
    double x = 0, v = 0.5;
    const double h = 0.002, w = 2 * kPi * 2;
    for (int i = 0; i < 500; ++i) {
        swung.run(1, h);
        v = (v - h * w * w * x) / (1 + 0.2 * w * h + h * h * w * w);
        x += h * v;
        ASSERT_NEAR(swung.world.jointCoordinate(swung.joint, 1), std::abs(x), tol<S>(1e-9, 2e-5)) << i;
    }
}

/// A car on two wheels, suspended at rest: the springs carry it where k x = m g / 2; then the motors drive
/// it.
TYPED_TEST(JointAxes, WheelCarriesSpinsAndHoldsItsLine) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    BodyDef<S> b;
    b.mass = 10;
    b.inertia = isotropic<S>(1);
    b.pose.p = at<S>(0, 1);
    b.type = BodyType::Static;
    const BodyId frame = world.addBody(b);
    b.type = BodyType::Dynamic;
    b.mass = 1;
    b.inertia = isotropic<S>(0.02);
    b.pose.p = at<S>(0.5, 0.5);
    const BodyId wheel = world.addBody(b);
    JointDef<S> def;
    def.type = JointType::Wheel;
    def.bodyA = frame;
    def.bodyB = wheel;
    def.anchorA = at<S>(0.5, -0.5);
    def.axisA = def.axisB = at<S>(0, 1);
    def.axes[0].stiffness = R(200);
    def.axes[0].damping = R(15);
    def.axes[1].motorSpeed = R(-20);
    def.axes[1].motorMaxForce = R(0.2);
    const JointId joint = world.addJoint(def);
    for (int i = 0; i < 100; ++i) {
        world.step(R(0.01));
        EXPECT_NEAR(world.jointSpeed(joint, 1), -0.2 / 0.02 * std::min(0.01 * (i + 1), 2.0),
                    tol<S>(1e-9, 1e-3));
    }
    for (int i = 0; i < 300; ++i) world.step(R(0.01));
    EXPECT_NEAR(world.jointSpeed(joint, 1), -20, tol<S>(1e-9, 1e-3));
    EXPECT_NEAR(world.jointCoordinate(joint, 1), -20 * 4 + 0.5 * 10 * 4, 0.2);
    EXPECT_NEAR(world.jointCoordinate(joint, 0), -kGravity / 200, tol<S>(1e-6, 1e-4));
    EXPECT_NEAR(world.pose(wheel).p[0], 0.5, tol<S>(1e-9, 1e-5));
    if constexpr (S::dim == 3) {
        EXPECT_NEAR(world.pose(wheel).p[2], 0, tol<S>(1e-9, 1e-5));
        EXPECT_NEAR((world.pose(wheel).q * typename S::Vec(0, 0, 1)).z(), 1, tol<S>(1e-9, 1e-5));
    }
}

TYPED_TEST(JointAxes, DrivenJointsAreCheckedWhileRunning) {
    using S = TypeParam;
    using R = typename S::Real;
    OneBody<S> one(WorldDef<S>{}, hinge<S>());
    const auto id = [](auto call) {
        try {
            call();
        } catch (const EngineError& error) {
            return error.id();
        }
        return std::string("none");
    };
    EXPECT_EQ(one.world.jointAxes(one.joint), 1);
    EXPECT_EQ(id([&] { one.world.setJointMotor(one.joint, 0, R(1), R(-1)); }), "joint_motor");
    EXPECT_EQ(id([&] { one.world.setJointMotor(one.joint, 1, R(1), R(1)); }), "joint_axes");
    EXPECT_EQ(id([&] { one.world.jointCoordinate(one.joint, 3); }), "joint_axes");
    EXPECT_EQ(id([&] {
                  one.world.setJointAxis(one.joint, 0, {AxisMode::Limited, R(2), R(1)});
              }),
              "joint_limits");
    EXPECT_EQ(one.world.jointAxis(one.joint).motorMaxForce, R(0)) << "a refused change changes nothing";
    // Locked by equal limits, away from zero, and still so after another change.
    one.world.setJointAxis(one.joint, 0, {AxisMode::Limited, R(0.3), R(0.3)});
    one.run(50, 0.01);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), 0.3, tol<S>(1e-9, 1e-5));
    EXPECT_EQ(id([&] { one.world.setJointMotor(one.joint, 0, R(1), R(1)); }), "joint_motor");
    one.run(50, 0.01);
    EXPECT_NEAR(one.world.jointCoordinate(one.joint), 0.3, tol<S>(1e-9, 1e-5));
    one.world.removeJoint(one.joint);
    EXPECT_FALSE(one.world.contains(one.joint));
}

}  // namespace
}  // namespace rigor::engine::test
