// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers worked out by hand for terms that the other tests leave at zero or one: slanted gravity, masses
// other than 1 kg, shapes beside their centre of mass, anchors beside the origin, the scales of quantities.
// Each stands for a formula that mutate.py could break unnoticed.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/references/parts.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;

const Quantity& quantity(const std::vector<Quantity>& all, const std::string& name) {
    const Quantity* found = findQuantity(all, name);
    if (found == nullptr) throw std::runtime_error("no quantity " + name);
    return *found;
}

TEST(HandValues, ABouncingBallIsDrivenAlongTheFloorByWhatIsLeftOfGravity) {
    Scenario s = emptyScene(3, {1.5, -9.81, 0.5}, 4);
    addBall(s, "ball", 0.1, 1, 0.4, {2, 1.1, 0}, {-1, 0, 3});
    addFloor(s);
    s.materials[0].restitution = 0.8;
    setReference(s, "bouncing_ball");
    const auto state = makeReference(s)->exact(0, 3);
    EXPECT_NEAR(state.position->x, 2 - 3 + 0.5 * 1.5 * 9, 1e-12);
    EXPECT_NEAR(state.position->z, 3 * 3 + 0.5 * 0.5 * 9, 1e-12);
    EXPECT_NEAR(state.velocity->x, -1 + 1.5 * 3, 1e-12);
}

TEST(HandValues, AForceOnAFlyingBodyIsDividedByItsMass) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    addBall(s, "ball", 0.1, 4, 0.4, {0, 50, 0});
    s.forces.push_back(ConstantForce{0, {6, 0, 0}, {}, 0.5, 1.5});
    setReference(s, "free_flight");
    const auto state = makeReference(s)->exact(0, 2);
    EXPECT_NEAR(state.velocity->x, 6.0 / 4, 1e-14);                // state after one second
    EXPECT_NEAR(state.position->x, 0.5 * 1.5 + 1.5 * 0.5, 1e-14);  // state half a second later
    EXPECT_NEAR(state.position->y, 50 - 5.0 * 4, 1e-12);
}

TEST(HandValues, TheDeflectionOfASlidingBlockIsItsWayAsideOverItsWay) {
    Scenario s = emptyScene(3, {0, -10, 0}, 1);
    s.materials[0].friction = 0.5;
    addFloor(s);
    addBox(s, "block", {0.2, 0.02, 0.2}, 1, {0, 0.02, 0}, {3, 0, 0});
    setReference(s, "friction_sweep");
    const auto reference = makeReference(s);
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    Trajectory run = exactRun(s, *reference, 0.01, 100);
    const Quantity& deflection = quantity(quantities, "deflection_block");
    EXPECT_NEAR(deflection.measure(run).value(), 0, 1e-14);
    EXPECT_EQ(deflection.scale, 1.0);
    for (const double aside : {0.09, -0.09}) {  // offsets from the arm of 0.9 m
        run.states.back() = run.states[1];
        const auto stopped = reference->exact(1, 1.0);
        run.states.back() = {*stopped.position + Vec3{0, 0, aside}, {}, {}, {}};
        EXPECT_NEAR(deflection.measure(run).value(), 0.1, 1e-13);
    }
    s.bodies[1].velocity = {};
    EXPECT_EQ(findQuantity(makeReference(s)->quantities(0.01, Scheme::Unknown), "deflection_block"), nullptr)
        << "what does not start goes nowhere";
}

TEST(HandValues, OnASlopeErrorsAreMeasuredAgainstTheFallWithoutFriction) {
    Scenario s = emptyScene(3, {3, -9, 0}, 2);
    s.materials[0].friction = 0.5;
    addFloor(s);
    addBox(s, "block", {0.2, 0.02, 0.2}, 1, {0, 0.02, 0});
    setReference(s, "incline_slide");
    const auto sticking = makeReference(s)->quantities(0.01, Scheme::Unknown);
    EXPECT_EQ(quantity(sticking, "displacement").exact, 0.0);
    EXPECT_NEAR(quantity(sticking, "displacement").scale, 0.5 * 3 * 4, 1e-12);
    EXPECT_NEAR(quantity(sticking, "final_speed").scale, 0.5 * 3 * 2, 1e-12);
    s.bodies[1].velocity = {0, 0, 0.5};
    const auto sliding = makeReference(s)->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(quantity(sliding, "final_speed").scale, 0.5 * 3 * 2 + 0.5, 1e-12);
}

TEST(HandValues, ACollisionIsWhereTheShapesMeetNotTheCentresOfMass) {
    Scenario s = emptyScene(3, {}, 2);
    addBox(s, "a", {0.1, 0.1, 0.1}, 1, {-1, 0, 0}, {2, 0, 0});
    s.bodies[0].shapes[0].pose.position = {0.15, 0, 0};  // its face at -0.75
    addBox(s, "b", {0.2, 0.1, 0.1}, 3, {1, 0, 0}, {-1, 0, 0});
    s.bodies[1].shapes[0].pose.position = {0.05, 0, 0};  // its face at 0.85
    s.materials[0].restitution = 0.5;
    setReference(s, "collision_1d");
    const auto quantities = makeReference(s)->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(quantity(quantities, "impact_time").exact, 1.6 / 3, 1e-13);
    // 1/2 mu u^2 with mu = 3/4 kg, u = 3 m/s
    EXPECT_NEAR(quantity(quantities, "energy_loss").scale, 0.5 * 0.75 * 9, 1e-13);
}

TEST(HandValues, ARopeBesideTheOriginIsAsLongAsItsAnchorsAreApart) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    addBall(s, "body", 0.1, 2, 0.4, {3, 1.5, -1});
    Joint j;
    j.name = "rope";
    j.type = JointType::Distance;
    j.bodyB = 0;
    j.anchorA = {3, 2, -1};
    j.length = 0.5;
    j.axes[0].mode = AxisMode::Limited;
    j.axes[0].lower = 0;
    j.axes[0].upper = 1.3;
    s.joints = {j};
    setReference(s, "joint_coordinate");
    const auto state = makeReference(s)->exact(0, 0.5);  // taut after 0.4 s
    EXPECT_NEAR(state.position->y, 2 - 1.3, 1e-12);
    EXPECT_EQ(state.velocity->y, 0);
}

TEST(HandValues, LittleDragIsASmallCorrectionNotAJump) {
    // rates at 1 s on both sides of the threshold of the series
    for (const double rate : {9.9e-4, 1.01e-3}) {
        Scenario s = emptyScene(3, {0, -10, 0}, 2);
        addBall(s, "ball", 0.1, 2, 0.4, {}, {});
        s.forces.push_back(DragForce{0, 2 * rate});
        setReference(s, "linear_drag");
        const long double k = 2 * rate / 2.0L;
        // g (t - (1 - e^-kt)/k)/k as its series, of which the fifth term is below the last bit.
        long double sum = 0, term = 0.5L;
        for (int n = 0; n < 8; ++n, term *= -k / (n + 2)) sum += term;
        EXPECT_NEAR(makeReference(s)->exact(0, 1).position->y, static_cast<double>(-10 * sum), 1e-12) << rate;
    }
}

TEST(HandValues, AStanceReachesAsFarAsItsNearerEnd) {
    const std::vector<Vec3> feet{{-1, 0, 0}, {2, 0, 0}};
    EXPECT_NEAR(supportMargin(feet, {1.5, 0, 0}, {0, 1, 0}, 2), 0.5, 1e-14);
    EXPECT_NEAR(supportMargin(feet, {-0.75, 0, 0}, {0, 1, 0}, 2), 0.25, 1e-14);
    EXPECT_NEAR(supportMargin(feet, {2.5, 0, 0}, {0, 1, 0}, 2), -0.5, 1e-14);
    EXPECT_NEAR(supportMargin(feet, {-3, 0, 0}, {0, 1, 0}, 2), -2, 1e-14);
}

TEST(HandValues, FacesEndWhereTheirShapesDo) {
    Scenario s = emptyScene(3, {}, 1);
    HeightField field;
    field.columns = 5;
    field.rows = 3;
    field.spacingX = 0.5;
    field.spacingZ = 2;
    field.heights.assign(15, 0.25);
    addBody(s, "field", BodyType::Static, field, {10, 0, 0});
    const Plane top = planeOf(s, 0, {10, 3, 0});
    EXPECT_NEAR(top.height({10, 3, 0}), 2.75, 1e-14);
    for (const double side : {-1.0, 1.0}) {  // 2 m wide, 4 m deep
        EXPECT_TRUE(top.holds({10 + side * 0.99, 1, 0}));
        EXPECT_FALSE(top.holds({10 + side * 1.01, 1, 0}));
        EXPECT_TRUE(top.holds({10, 1, side * 1.99}));
        EXPECT_FALSE(top.holds({10, 1, side * 2.01}));
    }
    addBody(s, "can", BodyType::Static, Cylinder{0.5, 1.5}, {0, 1, 0});
    EXPECT_NEAR(planeOf(s, 1, {0, 4, 0}).height({0, 4, 0}), 1.5, 1e-14);
    EXPECT_NEAR(planeOf(s, 1, {0, -4, 0}).height({0, -4, 0}), 3.5, 1e-14);
    EXPECT_NEAR(planeOf(s, 1, {0, -4, 0}).normal.y, -1, 1e-14);
}

TEST(HandValues, AHalfSpaceInTheWayStandsWhereItsOffsetSays) {
    const auto scene = [](double wall) {
        Scenario s = emptyScene(3, {0, -10, 0}, 2);
        s.materials[0].friction = 0.2;
        addFloor(s);
        addBody(s, "wall", BodyType::Static, HalfSpace{{-1, 0, 0}, -wall}, {});  // solid from x = wall on
        addBox(s, "block", {0.2, 0.1, 0.2}, 1, {0, 0.1, 0}, {3, 0, 0});
        setReference(s, "sliding_stop", {{"body", std::string("block")}, {"on", std::string("floor")}});
        return s;
    };
    const Scenario near = scene(2.4), far = scene(2.6);  // its front comes to 2.45
    EXPECT_THROW(makeReference(near), AssumptionViolated);
    EXPECT_NE(makeReference(far), nullptr);
}

TEST(HandValues, WhatRestsHasSomethingUnderItAndAPendulumOneJoint) {
    for (const double height : {0.2, 0.3}) {
        Scenario s = emptyScene(3, {0, -10, 0}, 1);
        addFloor(s);
        addBall(s, "ball", 0.2, 1, 0.4, {0, height, 0});
        setReference(s, "at_rest");
        if (height == 0.2) {
            EXPECT_NE(makeReference(s), nullptr);
        } else {
            EXPECT_THROW(makeReference(s), AssumptionViolated);
        }
    }
    Scenario s = emptyScene(3, {0, -10, 0}, 1);
    addBox(s, "bob", {0.1, 0.1, 0.1}, 1, {1, 0, 0});
    Joint hinge;
    hinge.name = "hinge";
    hinge.type = JointType::Hinge;
    hinge.bodyB = 0;
    hinge.anchorB = {-1, 0, 0};
    s.joints = {hinge};
    setReference(s, "physical_pendulum", {{"joint", std::string("hinge")}});
    EXPECT_NE(makeReference(s), nullptr);
    s.joints.push_back(hinge);
    s.joints.back().name = "another";
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(HandValues, TheCentreOfMassIsWhereTheBodysTurnHasTakenIt) {
    Scenario s = emptyScene(3, {}, 1);
    addBall(s, "ball", 0.1, 1, 0.4, {});
    Body& b = s.bodies[0];
    b.massProperties.centerOfMass = {0, 2, 0};
    b.pose = {{1, 0, 0}, fromAxisAngle({0, 0, 1}, M_PI)};
    const Vec3 start = centerOfMass(b),
               now = centerOfMass(b, {{5, 6, 7}, fromAxisAngle({0, 0, 1}, M_PI / 2), {}, {}});
    EXPECT_NEAR(norm(start - Vec3{1, -2, 0}), 0, 1e-14);
    EXPECT_NEAR(norm(now - Vec3{3, 6, 7}), 0, 1e-14);
}

TEST(HandValues, ACradleIsMeasuredOnceItsLastImpactIsOver) {
    Scenario s = emptyScene(3, {}, 2);
    addBall(s, "a", 0.1, 1, 0.4, {-1, 0, 0}, {2, 0, 0});
    addBall(s, "b", 0.1, 1, 0.4, {0, 0, 0});
    addBall(s, "c", 0.1, 1, 0.4, {1, 0, 0});
    s.materials[0].restitution = 1;
    setReference(s, "newtons_cradle");
    const auto reference = makeReference(s);
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    ASSERT_EQ(quantities.size(), 3u);
    const Trajectory run = exactRun(s, *reference, 0.01, 200);
    for (const auto& [name, speed] :
         {std::pair{"velocity_a", 0.0}, {"velocity_b", 0.0}, {"velocity_c", 2.0}}) {
        const Quantity& q = quantity(quantities, name);
        EXPECT_NEAR(q.exact, speed, 1e-13) << name;
        EXPECT_NEAR(q.scale, 2, 1e-13) << name;
        EXPECT_NEAR(q.measure(run).value(), speed, 1e-12) << name;
    }
    s.duration = 0.7;  // impacts after 0.4 and 0.8 s
    EXPECT_TRUE(makeReference(s)->quantities(0.01, Scheme::Unknown).empty());
}

TEST(HandValues, AMotorThatBrakesIsMeasuredLikeOneThatDrives) {
    for (const double speed : {6.0, -6.0}) {
        Scenario s = emptyScene(3, {}, 2);
        for (const char* name : {"a", "b"}) addBox(s, name, {0.1, 0.1, 0.1}, 1, {});
        s.bodies[0].massProperties.inertia = Mat3::diagonal(2, 2, 2);
        s.bodies[1].massProperties.inertia = Mat3::diagonal(1, 1, 1);
        Joint hinge;
        hinge.name = "hinge";
        hinge.type = JointType::Hinge;
        hinge.bodyA = 0;
        hinge.bodyB = 1;
        hinge.axes[0].motorSpeed = speed;
        hinge.axes[0].motorMaxForce = 3;
        s.joints = {hinge};
        setReference(s, "motor_pair");
        const auto quantities = makeReference(s)->quantities(0.01, Scheme::Unknown);
        // The motor reaches its speed in 6/(3/2 + 3/1) s: b turns by 4 rad/s, a by -2.
        EXPECT_NEAR(quantity(quantities, "ramp_time").exact, 4.0 / 3, 1e-12);
        EXPECT_NEAR(quantity(quantities, "spin_b").exact, speed * 4 / 6, 1e-12);
        EXPECT_NEAR(quantity(quantities, "spin_a").exact, -speed * 2 / 6, 1e-12);
        EXPECT_NEAR(quantity(quantities, "spin_a").scale, 6, 1e-12) << "the speed between them";
    }
}

TEST(HandValues, RollingIsMeasuredAgainstTheSpeedsThereAre) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    addBall(s, "ball", 0.5, 2, 0.4, {0, 0.5, 0}, {3, 0, 0}, {0, 0, 4});
    addFloor(s);
    s.materials[0].friction = 0.3;
    setReference(s, "slip_to_roll");
    const auto quantities = makeReference(s)->quantities(0.01, Scheme::Unknown);
    for (const auto& q : quantities)
        if (q.unit == "m/s") {
            EXPECT_NEAR(q.scale, 3 + 0.5 * 4, 1e-13) << q.name << ": |v| + r |w|";
        }
    s.duration = 0.2;  // it still slips: (3 + 2)/(0.3 10 (1 + 1/0.4)) = 0.476 s
    EXPECT_EQ(findQuantity(makeReference(s)->quantities(0.01, Scheme::Unknown), "roll_time"), nullptr);
}

TEST(HandValues, RollingDownhillIsMeasuredAgainstTheFall) {
    Scenario s = emptyScene(3, {3, -9, 0}, 2);
    addBall(s, "ball", 0.5, 2, 0.4, {0, 0.5, 0});
    addFloor(s);
    s.materials[0].friction = 0.6;
    setReference(s, "rolling_incline");
    const auto quantities = makeReference(s)->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(quantity(quantities, "final_speed").scale, 3 * 2, 1e-12);
    EXPECT_NEAR(quantity(quantities, "final_spin").scale, 3 * 2 / 0.5, 1e-12);
    EXPECT_TRUE(quantity(quantities, "final_speed").schemeExact.has_value()) << "it rolls from the start";
}

Scenario hung(Vec3 bob) {
    Scenario s = emptyScene(3, {0, -10, 0}, 20);
    addBox(s, "bob", {0.1, 0.1, 0.1}, 1, bob);
    Joint hinge;
    hinge.name = "hinge";
    hinge.type = JointType::Hinge;
    hinge.bodyB = 0;
    hinge.anchorB = -bob;
    s.joints = {hinge};
    setReference(s, "physical_pendulum");
    return s;
}

TEST(HandValues, APendulumThatHangsStillHasNoPeriod) {
    const Scenario still = hung({0, -1, 0}), swinging = hung({0.1, -0.99, 0});
    EXPECT_TRUE(makeReference(still)->quantities(0.01, Scheme::Unknown).empty());
    EXPECT_EQ(makeReference(still)->exact(0, 7).position->y, -1);
    EXPECT_EQ(makeReference(swinging)->quantities(0.01, Scheme::Unknown).size(), 2u);
}

TEST(HandValues, ADamperAloneIsAForceToo) {
    for (const double damping : {0.0, 0.5}) {
        Scenario s = emptyScene(3, {0, -10, 0}, 1);
        addBall(s, "ball", 0.1, 1, 0.4, {});
        s.forces.push_back(SpringForce{kNone, 0, {0, 5, 0}, {}, 0, damping, 1});
        setReference(s, "free_flight");
        if (damping == 0.0) {
            EXPECT_NE(makeReference(s), nullptr);
        } else {
            EXPECT_THROW(makeReference(s), AssumptionViolated);
        }
    }
}

/// A rod of 0.4 m beside the origin keeps length, energy and the momentum about the vertical; a wrong power
/// of its length would not.
TEST(HandValues, AShortRodBesideTheOriginKeepsItsEnergy) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    const Vec3 pivot{3, 2, -1};
    addBall(s, "bob", 0.05, 2, 0.4, pivot + Vec3{0.24, -0.32, 0}, {0, 0, 1.5});
    Joint rod;
    rod.name = "rod";
    rod.type = JointType::Distance;
    rod.bodyB = 0;
    rod.anchorA = pivot;
    rod.length = 0.4;
    s.joints = {rod};
    setReference(s, "rod_pendulum");
    const auto reference = makeReference(s);
    const auto at = [&](double t) { return reference->exact(0, t); };
    const auto energy = [&](const PartialState& x) {
        return 0.5 * dot(*x.velocity, *x.velocity) + 10 * x.position->y;
    };
    const auto turning = [&](const PartialState& x) { return cross(*x.position - pivot, *x.velocity).y; };
    for (const double t : {0.3, 1.1, 2.0}) {
        EXPECT_NEAR(norm(*at(t).position - pivot), 0.4, 1e-12);
        EXPECT_NEAR(energy(at(t)), energy(at(0)), 1e-11);
        EXPECT_NEAR(turning(at(t)), turning(at(0)), 1e-12);
    }
    // T/m at the start from its curvature: v^2/l + g cos.
    const Vec3 inwards = unit(pivot - *at(0).position), g{0, -10, 0};
    const double h = 1e-4;
    const Vec3 a = (*at(2 * h).velocity - *at(0).velocity) / (2 * h);
    EXPECT_NEAR(dot(a - g, unit(pivot - *at(h).position)), 1.5 * 1.5 / 0.4 + 10 * 0.8, 1e-3);
    EXPECT_NEAR(inwards.y, 0.8, 1e-14);
}

}  // namespace
}  // namespace rigor::validation::testing
