// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// six_dof, wheel, cone_twist, springs and breaking joints: signs, effective masses, and what Bullet's own
// defaults do instead.
#include <cmath>
#include <functional>

#include "adapters/bullet/tests/joints.hpp"
#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

using scenario::AxisMode;
using scenario::JointAxis;

Joint jointAlong(JointType type, int a, int b, Vec3 anchorA, Vec3 anchorB, Vec3 axis = {1, 0, 0}) {
    Joint j = joint(type, a, b, anchorA, anchorB, axis);
    j.normalA = {0, 1, 0};
    return j;
}
Scenario weightless() {
    Scenario s = scene();
    s.gravity = {};
    return s;
}
JointAxis limits(double lower, double upper) {
    JointAxis axis;
    axis.mode = AxisMode::Limited;
    axis.lower = lower;
    axis.upper = upper;
    return axis;
}

/// A joint frame that is none of the world's: x, y and z of the joint.
const Vec3 kX{0.6, 0.8, 0}, kY{-0.8, 0.6, 0}, kZ{0, 0, 1};
const Vec3 kAxes[] = {kX, kY, kZ};

class BulletSixDof : public ::testing::TestWithParam<int> {
  protected:
    /// One body on the world, coordinate `k` alone with `axis`, started at `speed` along it.
    static Scenario oneCoordinate(int k, const JointAxis& axis, double speed) {
        Scenario s = weightless();
        const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {0, 0, 0}, 2.0, even(0.5));
        const Vec3 along = speed * kAxes[k % 3];
        (k < 3 ? s.bodies[0].velocity : s.bodies[0].angularVelocity) = along;
        Joint j = jointAlong(JointType::SixDof, scenario::kNone, b, {}, {}, kX);
        j.normalA = kY;
        j.axes[k] = axis;
        s.joints.push_back(j);
        return s;
    }
    static double coordinate(const BodyState& state, int k) {
        if (k < 3) return dot(state.position, kAxes[k]);
        const Quat q = state.orientation;
        const Vec3 turned = Vec3{q.x, q.y, q.z};
        return 2.0 * std::atan2(dot(turned, kAxes[k - 3]), q.w);
    }
};

TEST_P(BulletSixDof, LimitsStopOnTheirOwnSides) {
    const int k = GetParam();
    for (const double speed : {1.0, -1.0}) {
        Simulation run(oneCoordinate(k, limits(-0.2, 0.5), speed), 1.0 / 240);
        run.seconds(2);
        EXPECT_NEAR(coordinate(run.state(0), k), speed > 0 ? 0.5 : -0.2, tol(2e-3, 3e-3));
    }
}

TEST_P(BulletSixDof, MotorsPushForwardsWithTheirForce) {
    const int k = GetParam();
    JointAxis axis;
    axis.mode = AxisMode::Free;
    axis.motorSpeed = 2.0;
    axis.motorMaxForce = 0.5;
    Simulation run(oneCoordinate(k, axis, 0.0), 1.0 / 240);
    run.seconds(1);
    const BodyState state = run.state(0);
    const double rate = dot(k < 3 ? state.velocity : state.angularVelocity, kAxes[k % 3]);
    EXPECT_NEAR(rate, k < 3 ? 0.25 : 1.0, tol(1e-9, 1e-4));
}

TEST_P(BulletSixDof, SpringsRestAtTheirTargets) {
    const int k = GetParam();
    JointAxis axis;
    axis.mode = AxisMode::Free;
    axis.target = 0.3;
    axis.stiffness = 20;
    axis.damping = 6;
    Simulation run(oneCoordinate(k, axis, 0.0), 1.0 / 240);
    run.seconds(8);
    EXPECT_NEAR(coordinate(run.state(0), k), 0.3, tol(1e-4, 1e-3));
}

TEST_P(BulletSixDof, LockedCoordinatesStay) {
    const int k = GetParam();
    Scenario s = oneCoordinate(k, limits(-0.2, 0.5), 1.0);
    s.gravity = {1, -9.81, 3};
    Simulation run(s, 1.0 / 240);
    run.seconds(1);
    for (int other = 0; other < 6; ++other) {
        if (other == k) continue;
        EXPECT_NEAR(coordinate(run.state(0), other), 0.0, 1e-3) << other;
    }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, BulletSixDof, ::testing::Range(0, 6));

/// Half a period after being let go a spring's coordinate is mirrored about its target.
double afterHalfAPeriod(Scenario s, double frequency, const std::string& options, double dt,
                        const std::function<double(Simulation&)>& coordinate) {
    Simulation run(s, dt, options);
    run.steps(static_cast<int>(0.5 / frequency / dt + 0.5));
    return coordinate(run);
}

TEST(BulletSprings, AFrequencyIsThatOfTheReducedMass) {
    Scenario s = weightless();
    const int a = addBody(s, Box{{0.1, 0.1, 0.1}}, {0, 0, 0}, 1.0);
    const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {1, 0, 0}, 3.0);
    Joint j = jointAlong(JointType::Slider, a, b, {0.5, 0, 0}, {-0.5, 0, 0});
    j.axes[0].frequency = 2.0;
    j.axes[0].target = 0.1;
    s.joints.push_back(j);
    const double u = afterHalfAPeriod(s, 2.0, "preset=matched", 1.0 / 1920, [](Simulation& run) {
        return run.state(1).position.x - run.state(0).position.x - 1.0;
    });
    EXPECT_NEAR(u, 0.2, 2e-3);
}

TEST(BulletSprings, AFrequencyIsThatOfTheMomentAboutAnOffsetHinge) {
    Scenario s = weightless();
    const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {0.7, 0, 0}, 3.0);
    Joint j = jointAlong(JointType::Hinge, scenario::kNone, b, {}, {-0.7, 0, 0}, {0, 0, 1});
    j.axes[0].frequency = 2.0;
    j.axes[0].target = 0.1;
    s.joints.push_back(j);
    const double u = afterHalfAPeriod(s, 2.0, "preset=matched", 1.0 / 1920, [](Simulation& run) {
        const Vec3 p = run.state(0).position;
        return std::atan2(p.y, p.x);
    });
    EXPECT_NEAR(u, 0.2, 2e-3);
}

/// Bullet lowers a stiffness above m / (16 dt^2): at 1/60 s every spring above 2.4 Hz.
TEST(BulletSprings, AStiffSpringIsSoftenedByDefaultAlone) {
    Scenario s = weightless();
    const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {}, 3.0);
    Joint j = jointAlong(JointType::Slider, scenario::kNone, b, {}, {});
    // 30 rad/s = 0.5 per step
    j.axes[0].stiffness = 3.0 * 900.0;
    j.axes[0].target = 0.1;
    s.joints.push_back(j);
    const auto velocityAfterAStep = [&](const char* options) {
        Simulation run(s, 1.0 / 60, options);
        run.steps(1);
        return run.state(0).velocity.x;
    };
    EXPECT_NEAR(velocityAfterAStep("preset=matched"), 900.0 * 0.1 / 60, 1e-4);
    EXPECT_NEAR(velocityAfterAStep("preset=default"), 225.0 * 0.1 / 60, 1e-4);
}

TEST(BulletWheel, SpringsAlongItsStrutAndTurnsWithItsMotor) {
    Scenario s = scene();
    const int chassis = addBody(s, Box{{0.5, 0.1, 0.5}}, {0, 2, 0}, 1e6, even(1e6));
    s.bodies[0].gravityScale = 0.0;
    const int wheel = addBody(s, Sphere{0.3}, {0, 1, 0}, 4.0, even(0.2));
    Joint j = jointAlong(JointType::Wheel, chassis, wheel, {0, -1, 0}, {}, {0, 1, 0});
    j.spinAxisB = {0, 0, 1};
    j.axes[0].stiffness = 400;
    j.axes[0].damping = 40;
    j.axes[1].motorSpeed = 5;
    j.axes[1].motorMaxForce = 0.4;
    s.joints.push_back(j);
    Simulation run(s, 1.0 / 480);
    run.seconds(1);
    EXPECT_NEAR(run.state(wheel).angularVelocity.z, 2.0, tol(1e-3, 1e-2));
    run.seconds(4);
    EXPECT_NEAR(run.state(wheel).position.y, 1.0 - 4.0 * 9.81 / 400, tol(1e-3, 1e-2));
    EXPECT_NEAR(run.state(wheel).angularVelocity.z, 5.0, tol(1e-3, 1e-2));
    EXPECT_NEAR(std::hypot(run.state(wheel).position.x, run.state(wheel).position.z), 0.0, 1e-3);
}

/// A spin axis that leans needs a second constraint: the hub travels along the strut, the wheel turns about the
/// axis in the chassis alone.
TEST(BulletWheel, TurnsAboutASpinAxisThatLeans) {
    Scenario s = scene();
    const int wheel = addBody(s, Sphere{0.3}, {0, 1, 0}, 4.0, even(0.2));
    s.bodies.back().collides = false;
    Joint j = jointAlong(JointType::Wheel, scenario::kNone, wheel, {0, 1, 0}, {}, {0, 1, 0});
    j.spinAxisB = {0, 0.6, 0.8};
    j.axes[0].stiffness = 400;
    j.axes[0].damping = 60;
    j.axes[0].mode = AxisMode::Free;
    j.axes[1].motorSpeed = 5;
    j.axes[1].motorMaxForce = 1;
    j.axes[1].mode = AxisMode::Free;
    s.joints.push_back(j);
    Simulation run(s, 1.0 / 480, "preset=matched");
    run.seconds(4);
    const BodyState state = run.state(wheel);
    EXPECT_NEAR(norm(state.position - Vec3{0, 1.0 - 4.0 * 9.81 / 400, 0}), 0.0, tol(1e-3, 1e-2));
    EXPECT_NEAR(norm(state.angularVelocity - 5.0 * j.spinAxisB), 0.0, tol(1e-2, 2e-2));
    EXPECT_NEAR(norm(rotate(state.orientation, j.spinAxisB) - j.spinAxisB), 0.0, 1e-3);
}

/// Trap: a hinge's angle and limits are normalised to half a turn. Limits over turns and on one side alone,
/// beside a motor and a spring.
TEST(BulletHinge, StopsBeyondHalfATurnAndOnOneSideAlone) {
    struct HingeCase {
        double lower, upper, speed, stop;
    };
    for (const HingeCase& c :
         {HingeCase{-0.5, 7.5, 4.0, 7.5}, HingeCase{-8.0, 1.0, -4.0, -8.0}, HingeCase{-1e300, 0.5, 4.0, 0.5},
          HingeCase{-0.5, 1e300, -4.0, -0.5}, HingeCase{-0.5, 3.3, 4.0, 3.3}}) {
        for (const bool sprung : {false, true}) {
            Scenario s = scene();
            s.gravity = {};
            const int b = addBody(s, Sphere{0.1}, {}, 1.0, even(0.1));
            s.bodies.back().collides = false;
            Joint j = jointAlong(JointType::Hinge, scenario::kNone, b, {}, {}, {0, 0, 1});
            j.axes[0] = limits(c.lower, c.upper);
            j.axes[0].motorSpeed = c.speed;
            j.axes[0].motorMaxForce = 1.0;
            if (sprung) {
                j.axes[0].stiffness = 1e-6;
                j.axes[0].damping = 0.05;
            }
            s.joints.push_back(j);
            Simulation run(s, 1.0 / 480, "preset=matched");
            double turned = 0.0;
            Quat before;
            for (int i = 0; i < 1920; ++i) {
                run.steps(1);
                const Quat q = run.state(b).orientation, d = conjugate(before) * q;
                turned += 2.0 * std::atan2(d.w < 0 ? -d.z : d.z, std::abs(d.w));
                before = q;
                ASSERT_TRUE(turned < c.upper + 0.05 && turned > c.lower - 0.05)
                    << turned << " of " << c.lower << " to " << c.upper << ", sprung " << sprung;
            }
            EXPECT_NEAR(turned, c.stop, tol(5e-3, 1e-2)) << sprung;
        }
    }
}

/// Twist is driven and sprung by a second constraint that leaves the cone to the first.
TEST(BulletConeTwist, ItsTwistIsDrivenAndSprung) {
    for (const bool sprung : {false, true}) {
        Scenario s = scene();
        s.gravity = {};
        const int b = addBody(s, Sphere{0.1}, {}, 1.0, even(0.1));
        s.bodies.back().collides = false;
        Joint j = jointAlong(JointType::ConeTwist, scenario::kNone, b, {}, {}, {1, 0, 0});
        j.axes[1] = limits(-1e300, 0.5);
        if (sprung) {
            j.axes[0].stiffness = 20;
            j.axes[0].damping = 1;
            j.axes[0].target = 0.4;
        } else {
            j.axes[0].motorSpeed = 2.0;
            j.axes[0].motorMaxForce = 0.4;
        }
        j.axes[0].mode = AxisMode::Free;
        s.joints.push_back(j);
        Simulation run(s, 1.0 / 480, "preset=matched");
        run.seconds(0.25);
        if (!sprung) {
            EXPECT_NEAR(run.state(b).angularVelocity.x, 1.0, tol(1e-3, 5e-3));
        }
        run.seconds(4);
        const Quat q = run.state(b).orientation;
        if (sprung)
            EXPECT_NEAR(2.0 * std::atan2(q.x, q.w), 0.4, tol(1e-3, 5e-3));
        else
            EXPECT_NEAR(run.state(b).angularVelocity.x, 2.0, tol(1e-3, 5e-3));
    }
}

/// A coordinate has one motor, which a damper takes too: beside a motor it is a second constraint's.
TEST(BulletDampers, StandBesideAMotor) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addBody(s, Sphere{0.1}, {}, 2.0, even(0.1));
    Joint j = jointAlong(JointType::Slider, scenario::kNone, b, {}, {}, {1, 0, 0});
    j.axes[0].mode = AxisMode::Free;
    j.axes[0].damping = 4.0;
    j.axes[0].motorSpeed = 10.0;
    j.axes[0].motorMaxForce = 8.0;
    s.joints.push_back(j);
    Simulation run(s, 1.0 / 480, "preset=matched");
    run.seconds(1);
    // m v' = F - c v
    EXPECT_NEAR(run.state(b).velocity.x, 2.0 * (1.0 - std::exp(-2.0)), 0.02);
}

/// Twist range off zero: Bullet's own is symmetric. A body spun about the axis stops at either end.
TEST(BulletConeTwist, TwistStopsAtBothEndsOfAnUnevenRange) {
    for (const double speed : {2.0, -2.0}) {
        Scenario s = weightless();
        const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {});
        s.bodies[0].angularVelocity = {speed, 0, 0};
        Joint j = jointAlong(JointType::ConeTwist, scenario::kNone, b, {}, {});
        j.axes[0] = limits(-0.2, 0.9);
        s.joints.push_back(j);
        Simulation run(s, 1.0 / 240);
        double most = 0.0, least = 0.0;
        for (int i = 0; i < 480; ++i) {
            run.steps(1);
            const Quat q = run.state(b).orientation;
            const double twist = 2.0 * std::atan2(q.x, q.w);
            most = std::max(most, twist);
            least = std::min(least, twist);
        }
        EXPECT_NEAR(speed > 0 ? most : least, speed > 0 ? 0.9 : -0.2, 0.02);
    }
}

TEST(BulletConeTwist, SwingStopsAtItsConeInAnyDirection) {
    for (const Vec3 turn : {Vec3{0, 2, 0}, Vec3{0, 0, -2}, Vec3{0, 1.2, 1.6}})
        for (const auto type : {JointType::ConeTwist, JointType::Ball}) {
            Scenario s = weightless();
            const int b = addBody(s, Box{{0.1, 0.1, 0.1}}, {});
            s.bodies[0].angularVelocity = turn;
            Joint j = jointAlong(type, scenario::kNone, b, {}, {});
            j.axes[type == JointType::Ball ? 0 : 1] = limits(-1e300, 0.6);
            s.joints.push_back(j);
            Simulation run(s, 1.0 / 240);
            double most = 0.0;
            for (int i = 0; i < 480; ++i) {
                run.steps(1);
                most = std::max(most, std::acos(rotate(run.state(b).orientation, Vec3{1, 0, 0}).x));
            }
            EXPECT_NEAR(most, 0.6, 0.02);
        }
}

/// 9.9 N across the axes of the joint: 7 N along each. Bullet's threshold tests each axis by itself.
TEST(BulletBreaking, TheForceIsAVectorInMatched) {
    Scenario s = scene();
    s.gravity = {-7, -7, 0};
    const int b = addBody(s, Sphere{0.1}, {});
    Joint j = jointAlong(JointType::Fixed, scenario::kNone, b, {}, {});
    j.breakForce = 9.0;
    s.joints.push_back(j);
    Simulation matched(s, 0.01), shipped(s, 0.01, "preset=default");
    EXPECT_TRUE(matched.world->jointHolds(0));
    matched.steps(1);
    shipped.steps(1);
    EXPECT_FALSE(matched.world->jointHolds(0));
    EXPECT_TRUE(shipped.world->jointHolds(0));
    s.joints[0].breakForce = 6.9;
    Simulation weaker(s, 0.01, "preset=default");
    weaker.steps(1);
    EXPECT_FALSE(weaker.world->jointHolds(0));
    s.joints[0].breakForce = 10.0;
    Simulation stronger(s, 0.01);
    stronger.steps(50);
    EXPECT_TRUE(stronger.world->jointHolds(0));
}

TEST(BulletBreaking, ATorqueIsThatAboutTheAnchor) {
    for (const double strength : {9.0, 11.0})
        for (const char* preset : {"preset=matched", "preset=default"}) {
            Scenario s = scene();
            const int b = addBody(s, Sphere{0.1}, {1, 0, 0});  // 9.81 N m about the wall
            Joint j = jointAlong(JointType::Fixed, scenario::kNone, b, {}, {-1, 0, 0});
            j.breakTorque = strength;
            s.joints.push_back(j);
            Simulation run(s, 1.0 / 240, std::string(preset) + ",iterations=200");
            run.steps(60);
            EXPECT_EQ(run.world->jointHolds(0), strength > 10.0) << preset;
            EXPECT_EQ(run.state(b).position.y < -0.1, strength < 10.0) << preset;
        }
}

/// A rod on a kinematic shaft that turns about y: Bullet's frame offset weights the anchors by the masses,
/// and lets the hinge drift behind the shaft.
TEST(BulletHinge, OnATurningShaftItStaysWithItsOwnAnchors) {
    Scenario s = scene();
    Body shaft;
    shaft.name = "shaft";
    shaft.type = BodyType::Kinematic;
    shaft.angularVelocity = {0, 6, 0};
    s.bodies.push_back(shaft);
    const int rod = addBody(s, Sphere{0.05}, {0.3, -0.4, 0}, 1.0, even(0.001));
    s.bodies[1].velocity = cross(Vec3{0, 6, 0}, Vec3{0.3, -0.4, 0});
    s.bodies[1].angularVelocity = {0, 6, 0};
    s.joints.push_back(jointAlong(JointType::Hinge, 0, rod, {}, {-0.3, 0.4, 0}, {0, 0, 1}));
    const auto worst = [&](const std::string& options) {
        Simulation run(s, 1.0 / 60, options);
        double gap = 0.0;
        for (int i = 0; i < 300; ++i) {
            run.steps(1);
            const BodyState state = run.state(rod);
            gap = std::max(gap, norm(state.position + rotate(state.orientation, Vec3{-0.3, 0.4, 0})));
        }
        return gap;
    };
    const double own = worst("preset=matched"), weighted = worst("preset=matched,frame_offset=on");
    EXPECT_LT(own, 0.2 * weighted);
}

/// Force of a slider's spring or damper in one step of 0.1 s, in addition to another force [N].
double springForce(double stiffness, double damping, double travel, double speed, double other) {
    Scenario s = scene();
    s.gravity = {};
    const int b = addBody(s, Sphere{0.1}, {}, 2.0);
    s.bodies[0].velocity = {speed, 0, 0};
    Joint j = jointAlong(JointType::Slider, scenario::kNone, b, {}, {}, {1, 0, 0});
    j.axes[0].mode = scenario::AxisMode::Free;
    j.axes[0].stiffness = stiffness;
    j.axes[0].damping = damping;
    j.axes[0].target = -travel;
    s.joints.push_back(j);
    Simulation run(s, 0.1);
    run.world->applyForce(b, {other, 0, 0}, {});
    return 2.0 * (run.steps(1).state(b).velocity.x - speed) / 0.1 - other;
}

/// Trap: Bullet's springs are motors towards the speed that they alone would leave: what another force does
/// the same way is taken off theirs.
TEST(BulletSprings, AForceTheSameWayIsTakenOffTheSprings) {
    EXPECT_NEAR(springForce(100, 0, 0.1, 0, 0), -10.0, tol(1e-9, 1e-4));
    EXPECT_NEAR(springForce(100, 0, 0.1, 0, 4), -10.0, tol(1e-9, 1e-4));
    EXPECT_NEAR(springForce(100, 0, 0.1, 0, -4), -6.0, tol(1e-9, 1e-4));
    EXPECT_NEAR(springForce(100, 0, 0.1, 0, -20), 0.0, tol(1e-9, 1e-4));
}

/// Trap: the same makes about half of a damper over a swing under gravity.
TEST(BulletDampers, AreNotWeakenedByOtherForces) {
    for (const double other : {0.0, 8.0, -3.0, -20.0, -39.0})
        EXPECT_NEAR(springForce(0, 1.5, 0, 4.0, other), -6.0, tol(1e-9, 1e-4)) << other;
    // It stops and does not turn back: 30 N s/m and 4 m/s would reverse 2 kg within 0.1 s.
    EXPECT_NEAR(springForce(0, 30.0, 0, 4.0, 0.0), -80.0, tol(1e-9, 1e-4));
}

/// Travel and turn, between two bodies, beside their centres of mass: exp(-c t / m) of the reduced mass, and
/// the swings of a damped rod against those of the linear equation.
TEST(BulletDampers, DampAHingeUnderGravity) {
    for (const double dt : {1e-3, 1e-4}) {
        Scenario s = scene();
        s.gravity = {0, -9.81, 0};
        const int b = addBody(s, Sphere{0.1}, {}, 1.0, even(0.02));
        const Quat tilt = scenario::fromAxisAngle({0, 0, 1}, 0.02);
        s.bodies[0].pose = {rotate(tilt, Vec3{0, -0.5, 0}), tilt};
        s.bodies[0].collides = false;
        Joint j = jointAlong(JointType::Hinge, scenario::kNone, b, {}, {0, 0.5, 0}, {0, 0, 1});
        j.axes[0].mode = scenario::AxisMode::Free;
        const double moment = 0.02 + 0.25, w = std::sqrt(9.81 * 0.5 / moment), zeta = 0.05;
        j.axes[0].damping = 2.0 * zeta * w * moment;
        s.joints.push_back(j);
        Simulation run(s, dt);
        double worst = 0.0;
        for (int i = 1; i <= static_cast<int>(3.0 / dt); ++i) {
            const Quat q = run.steps(1).state(b).orientation;
            const double t = i * dt, wd = w * std::sqrt(1.0 - zeta * zeta);
            const double exact =
                0.02 * std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
            worst = std::max(worst, std::abs(2.0 * std::atan2(q.z, q.w) - exact));
        }
        // First order; half the damping would be 0.006 rad off.
        EXPECT_LT(worst, tol(0.15 * dt + 2e-6, 1e-3)) << dt;
        ASSERT_NE(run.ledgerLine("joint_dampers"), nullptr);
    }
}

TEST(BulletJointKinds, WhatTheLibraryLacksIsRefused) {
    Scenario s = scene();
    const int b = addBody(s, Sphere{0.1}, {});
    Joint motored = jointAlong(JointType::Ball, scenario::kNone, b, {}, {});
    motored.axes[0].motorSpeed = 1;
    motored.axes[0].motorMaxForce = 1;
    Joint rod = jointAlong(JointType::Distance, scenario::kNone, b, {0, 1, 0}, {});
    rod.length = 1.0;
    Joint oneSided = jointAlong(JointType::SixDof, scenario::kNone, b, {}, {});
    oneSided.axes[5] = limits(-0.5, 1e300);
    for (const Joint& j : {motored, rod, oneSided}) {
        s.joints = {j};
        EXPECT_THROW(Simulation(s, 0.01), adapter::Unsupported) << jointName(j.type);
    }
}

}  // namespace
}  // namespace rigor::test
