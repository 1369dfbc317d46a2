// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts and free motion as ODE solves and reports them in `matched`.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kG = 9.81;

TEST(OdeRestitution, RatioIsThePairsCoefficient) {
    for (const double e : {0.3, 0.7, 1.0})
        for (const double dt : {1.0 / 60, 1.0 / 240}) {
            Scenario s = scene(0.0, e);
            s.gravity = {};
            addStatic(s, HalfSpace{});
            addBody(s, Sphere{0.5}, {0, 0.6, 0}, 1.0, even(sphereMoment(1.0, 0.5)));
            s.bodies[1].velocity = {0, -2, 0};
            EXPECT_NEAR(Simulation(s, dt).seconds(0.5).state(1).velocity.y, 2 * e, 1e-6) << e << " " << dt;
        }
}

/// A penetration of 0.2 m at the start: ERP takes a part of it per step, through the velocity.
TEST(OdePenetration, IsPushedOutNoFasterThanTheLimit) {
    const auto fastest = [](const std::string& options) {
        Scenario s = scene();
        addStatic(s, HalfSpace{});
        addBody(s, Sphere{0.5}, {0, 0.3, 0});
        Simulation run(s, 1.0 / 60, options);
        double most = 0.0;
        for (int i = 0; i < 300; ++i) most = std::max(most, run.steps(1).state(1).velocity.y);
        return most;
    };
    EXPECT_NEAR(fastest("preset=matched,contact_cfm=0"), 0.1, 1e-6);
    // A softened row gives way at CFM times the weight that hangs on it.
    EXPECT_NEAR(fastest("preset=matched"), 0.1, 1e-4);
    EXPECT_NEAR(fastest("preset=default"), 0.2 * 0.2 * 60, 1e-6);
}

struct Resting {
    const char* name;
    Geometry geometry;
    double height;
};
void PrintTo(const Resting& r, std::ostream* out) {
    *out << r.name;
}

class OdeResting : public testing::TestWithParam<Resting> {};

/// Capsules and cylinders of ODE lie along z: lying down they would rest at their radius.
TEST_P(OdeResting, StandsAtItsHeight) {
    Scenario s = scene(0.5);
    addStatic(s, HalfSpace{});
    const double h = GetParam().height, dt = 1.0 / 240;
    addBody(s, GetParam().geometry, {0, h + 0.01, 0}, 1.0, even(1.0 / 6));
    Simulation run(s, dt);
    run.seconds(2);
    EXPECT_NEAR(run.state(1).position.y, h, 1e-5);
    double sum = 0.0;
    for (const auto& c : run.contacts()) sum += c.normalImpulse;
    EXPECT_NEAR(sum, kG * dt, 1e-3 * kG * dt);
}

INSTANTIATE_TEST_SUITE_P(Shapes, OdeResting,
                         testing::Values(Resting{"sphere", Sphere{0.5}, 0.5},
                                         Resting{"box", Box{{0.4, 0.5, 0.3}}, 0.5},
                                         Resting{"hull", boxHull({0.4, 0.5, 0.3}), 0.5},
                                         Resting{"cylinder", Cylinder{0.3, 0.5}, 0.5},
                                         Resting{"capsule", Capsule{0.2, 0.3}, 0.5}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(OdeContacts, PointFromAToBWhicheverBodyComesFirst) {
    for (const bool ballFirst : {true, false}) {
        Scenario s = scene(0.5);
        s.gravity = {};
        const auto addBall = [&] { addBody(s, Sphere{0.5}, {0, 0.45, 0}, 1.0, even(0.1)); };
        if (ballFirst) addBall();
        addStatic(s, Box{{2, 0.5, 2}}, {0, -0.5, 0});
        if (!ballFirst) addBall();
        const int ball = ballFirst ? 0 : 1;
        s.bodies[ball].velocity = {1, -2, 0};
        Simulation run(s, 1.0 / 240);
        const auto contacts = run.steps(1).contacts();
        ASSERT_EQ(contacts.size(), 1u);
        const ContactPoint& c = contacts[0];
        EXPECT_NEAR(norm(c.normal - Vec3{0, ballFirst ? -1.0 : 1.0, 0}), 0.0, 1e-12);
        EXPECT_NEAR(c.depth, 0.05, 1e-12);
        EXPECT_NEAR(dot(c.pointA - c.pointB, c.normal), c.depth, 1e-12);
        EXPECT_NEAR((ballFirst ? c.pointA : c.pointB).y, -0.05, 1e-12);
        // The approach is stopped and at most the limit of 0.1 m/s is added by the correction.
        // Softness takes a part of CFM / (dt K) of it, K = 1 / 1 kg.
        EXPECT_NEAR(c.normalImpulse, 2.1 / (1.0 + 3e-6 * 240.0), 1e-6);
        const double onBall = ballFirst ? -c.frictionImpulse.x : c.frictionImpulse.x;
        EXPECT_LT(onBall, -0.05);
        EXPECT_NEAR(run.state(ball).velocity.x, 1.0 + onBall, 1e-9);
    }
}

/// The lever of an impact ends on the floor, the depth of the overlap short of the ball's surface: a ball
/// that grips loses v / (1 + m l^2 / I) with that lever, not with its radius.
TEST(OdeContacts, LeverOfAnImpactIsShorterByTheOverlap) {
    const double r = 0.1, inertia = sphereMoment(1.0, r);
    for (const double depth : {0.0, 0.01, 0.02}) {
        Scenario s = scene(5.0, 0.8);
        s.gravity = {};
        addStatic(s, Box{{20, 0.5, 20}}, {0, -0.5, 0});
        addBody(s, Sphere{r}, {0, r - depth - 1e-9, 0}, 1.0, even(inertia));
        s.bodies[1].velocity = {3, -2, 0};
        const double lever = r - depth, gripped = 3.0 - 3.0 / (1.0 + lever * lever / inertia);
        EXPECT_NEAR(Simulation(s, 1.0 / 60).steps(1).state(1).velocity.x, gripped, 1e-5) << depth;
    }
}

/// Ten cubes, each `overlap` into what is below it.
Scenario stack(double overlap, bool onBox) {
    Scenario s = scene(0.5);
    if (onBox)
        addStatic(s, Box{{20, 0.5, 20}}, {0, -0.5, 0});
    else
        addStatic(s, HalfSpace{});
    for (int i = 0; i < 10; ++i)
        addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 0.5 + i - overlap * (i + 1), 0}, 1.0,
                boxMoments(1.0, {0.5, 0.5, 0.5}));
    return s;
}

TEST(OdeContacts, AStackWithALittleOverlapStandsOnABox) {
    Simulation run(stack(1e-5, true), 1.0 / 60);
    run.seconds(2);
    for (int i = 1; i <= 10; ++i)
        EXPECT_NEAR(norm(run.state(i).position - Vec3{0, i - 0.5, 0}), 0.0, 1e-3) << i;
}

/// Contacts that start at depth zero: the direct solver gives up and says so, whatever the softness.
TEST(OdeContacts, ASolverThatGivesUpIsInTheLedger) {
    Simulation run(stack(0.0, false), 1.0 / 60, "preset=matched,cfm=1e-5");
    run.seconds(2);
    EXPECT_NE(run.ledgerLine("solver_messages"), nullptr);
}

TEST(OdeMotion, DampingKeepsTheGivenPartPerSecondAtAnySpeed) {
    for (const double speed : {2.0, 0.005})  // ODE's own threshold is 0.01
        for (const double dt : {1.0 / 60, 1.0 / 240}) {
            Scenario s = scene();
            s.gravity = {};
            addBody(s, Sphere{0.1}, {});
            s.bodies[0].velocity = {speed, 0, 0};
            s.bodies[0].angularVelocity = {0, 0, speed};
            s.bodies[0].linearVelocityKept = 0.25;
            s.bodies[0].angularVelocityKept = 0.5;
            const BodyState end = Simulation(s, dt).seconds(1).state(0);
            EXPECT_NEAR(end.velocity.x, 0.25 * speed, 1e-12);
            EXPECT_NEAR(end.angularVelocity.z, 0.5 * speed, 1e-12);
        }
}

TEST(OdeMotion, ForceActsForOneStepWithTheFullTensor) {
    Scenario s = scene();
    s.gravity = {};
    addBody(s, Sphere{0.1}, {}, 2.0);
    Mat3 inertia = Mat3::diagonal(1.0, 2.0, 2.5);
    inertia(0, 1) = inertia(1, 0) = 0.4;
    s.bodies[0].massProperties.inertia = inertia;
    const double dt = 1.0 / 60;
    Simulation run(s, dt);
    run.world->applyForce(0, {3, 0, 0}, {1, 0, 0});
    run.world->applyForce(0, {1, 0, 0}, {});
    const Vec3 back = inertia * run.steps(1).state(0).angularVelocity;
    EXPECT_NEAR(norm(back - Vec3{dt, 0, 0}), 0.0, 1e-12);
    EXPECT_NEAR(run.steps(5).state(0).velocity.x, 2.0 * dt, 1e-14);
}

TEST(OdeMotion, KinematicBodiesKeepTheirVelocityAndDrag) {
    Scenario s = scene(0.5);
    addStatic(s, Box{{50, 0.5, 5}}, {0, -0.5, 0});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].velocity = {1, 0, 0};
    addBody(s, Box{{0.5, 0.25, 0.5}}, {0, 0.25, 0}, 1.0, boxMoments(1.0, {0.5, 0.25, 0.5}));
    Simulation run(s, 1.0 / 240);
    EXPECT_NEAR(run.seconds(0.1).state(1).velocity.x, 0.5 * kG * 0.1, 1e-3);
    EXPECT_NEAR(run.seconds(0.9).state(1).velocity.x, 1.0, 1e-3);
    EXPECT_NEAR(norm(run.state(0).position - Vec3{1, -0.5, 0}), 0.0, 1e-9);
}

TEST(OdeJoints, AnchorsOfAPendulumHold) {
    for (const JointType type : {JointType::Ball, JointType::Hinge}) {
        Scenario s = scene();
        addBody(s, Sphere{0.1}, {1, 0, 0});
        Joint joint;
        joint.type = type;
        joint.bodyA = scenario::kNone;
        joint.bodyB = 0;
        joint.anchorB = {-1, 0, 0};
        joint.axisA = {0, 0, 1};
        s.joints.push_back(joint);
        Simulation run(s, 1.0 / 240);
        for (int i = 0; i < 240; ++i) {
            const BodyState state = run.steps(1).state(0);
            EXPECT_LT(norm(state.position + rotate(state.orientation, {-1, 0, 0})), 2e-3);
        }
        EXPECT_LT(run.state(0).position.y, 0.01);
    }
}

}  // namespace
}  // namespace rigor::test
