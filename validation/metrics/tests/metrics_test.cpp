// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every metric on trajectories with an injected error of known size: it returns exactly that; and where it
// does not apply it returns nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "validation/metrics/closed_forms.hpp"
#include "validation/metrics/energy.hpp"
#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;

struct MetricCase {
    Scenario scenario;
    std::unique_ptr<Reference> reference;
    Trajectory run;
    MetricInput input(Scheme scheme = Scheme::SymplecticEuler) const {
        return {scenario, run, reference.get(), scheme};
    }
    std::vector<MetricValue> rows(const char* name, Scheme scheme = Scheme::SymplecticEuler) const {
        const auto* entry = findMetric(name);
        if (!entry) throw std::invalid_argument(name);
        return entry->evaluate(input(scheme));
    }
    double worst(const char* name, Scheme scheme = Scheme::SymplecticEuler) const {
        const auto all = rows(name, scheme);
        return all.empty() ? -1.0 : all.front().value;
    }
    BodyState& state(std::size_t frame, std::size_t body) { return run.states[frame * run.bodyCount + body]; }
};

/// Two balls in free flight, recorded exactly: 101 frames of 0.01 s.
std::unique_ptr<MetricCase> flight() {
    auto c = std::make_unique<MetricCase>();
    c->scenario = emptyScene(3, {0, -9.81, 0}, 1);
    addBall(c->scenario, "a", 0.1, 2, 0.4, {0, 10, 0}, {3, 1, 0}, {0, 0, 4});
    addBall(c->scenario, "b", 0.2, 1, 0.4, {0, 20, 5}, {0, 0, -2});
    setReference(c->scenario, "free_flight");
    c->reference = makeReference(c->scenario);
    c->run = exactRun(c->scenario, *c->reference, 0.01, 100);
    return c;
}

TEST(StateError, ExactRunHasNone) {
    const auto c = flight();
    for (const char* name :
         {"position_final", "position_max", "position_rmse", "velocity_final", "velocity_max",
          "orientation_final", "orientation_max", "spin_final", "energy_error", "linear_momentum_drift",
          "angular_momentum_drift", "energy_drift", "energy_final", "energy_gain", "quaternion_norm_error"}) {
        ASSERT_FALSE(c->rows(name).empty()) << name;
        EXPECT_LT(c->worst(name), 2e-14) << name;
    }
}

TEST(StateError, InjectedOffsetsComeBackExactly) {
    const auto c = flight();
    c->state(100, 0).position += {0.03, 0, -0.04};
    c->state(40, 1).position += {0, 0.2, 0};
    c->state(100, 1).velocity += {0, 0, 0.7};
    c->state(60, 0).orientation =
        fromAxisAngle(scenario::Vec3{0.6, 0, 0.8}, 0.25) * c->state(60, 0).orientation;
    c->state(100, 0).angularVelocity += {0, 0.1, 0};
    const auto final = c->rows("position_final");
    ASSERT_EQ(final.size(), 3U);
    EXPECT_EQ(final[0].subject, "");
    EXPECT_NEAR(final[0].value, 0.05, 1e-14);
    EXPECT_EQ(final[1].subject, "a");
    EXPECT_LT(final[2].value, 1e-14);
    const auto largest = c->rows("position_max");
    EXPECT_NEAR(largest[0].value, 0.2, 1e-14);
    EXPECT_NEAR(largest[0].at, 0.4, 1e-14);
    EXPECT_NEAR(largest[1].value, 0.05, 1e-14);
    EXPECT_NEAR(c->worst("position_rmse"), 0.2 / std::sqrt(101.0), 1e-14);
    EXPECT_NEAR(c->worst("velocity_final"), 0.7, 1e-14);
    EXPECT_NEAR(c->worst("velocity_max"), 0.7, 1e-14);
    EXPECT_NEAR(c->worst("orientation_max"), 0.25, 1e-14);
    EXPECT_LT(c->worst("orientation_final"), 1e-14);
    EXPECT_NEAR(c->worst("spin_final"), 0.1, 1e-14);
    // The sign of a quaternion means nothing.
    auto& q = c->state(60, 0).orientation;
    q = {-q.w, -q.x, -q.y, -q.z};
    EXPECT_NEAR(c->worst("orientation_max"), 0.25, 1e-14);
}

TEST(StateError, OnlyObservedBodiesAndValidFramesCount) {
    const auto c = flight();
    c->state(100, 0).position += {1, 0, 0};
    c->scenario.observed = {1};
    EXPECT_LT(c->worst("position_max"), 1e-14);
    MetricCase none{c->scenario, nullptr, c->run};
    for (const char* name : {"position_final", "velocity_max", "orientation_max", "quantity_error",
                             "scheme_position_max", "rest_motion", "energy_error"})
        EXPECT_TRUE(none.rows(name).empty()) << name;
}

TEST(SchemeError, AnIdealSymplecticRunHasNoneButMissesThePhysicsByHalfAStep) {
    const auto c = flight();
    for (std::size_t k = 1; k < c->run.frames(); ++k)
        for (std::size_t b = 0; b < 2; ++b) {
            c->state(k, b).velocity = c->state(k - 1, b).velocity + 0.01 * c->scenario.gravity;
            c->state(k, b).position = c->state(k - 1, b).position + 0.01 * c->state(k, b).velocity;
        }
    EXPECT_LT(c->worst("scheme_position_max"), 1e-12);
    EXPECT_LT(c->worst("scheme_velocity_max"), 1e-12);
    EXPECT_NEAR(c->worst("position_final"), 0.5 * 9.81 * 0.01 * 1, 1e-12);
    // Judged as explicit Euler the whole g t h shows; an unknown scheme has no ideal run.
    EXPECT_NEAR(c->worst("scheme_position_final", Scheme::ExplicitEuler), 9.81 * 0.01, 1e-12);
    EXPECT_TRUE(c->rows("scheme_position_final", Scheme::Unknown).empty());
}

TEST(SchemeError, FramesFartherApartThanStepsFindTheirStep) {
    const auto c = flight();
    Trajectory sparse;
    sparse.dt = 0.001;
    sparse.stride = 10;
    sparse.bodyCount = 2;
    for (std::size_t k = 0; k <= 10; ++k) {
        sparse.times.push_back(k * 0.01);
        for (int b = 0; b < 2; ++b) {
            const auto ideal = c->reference->schemeExact(b, k * 10, 0.001, Scheme::SymplecticEuler);
            const auto exact = c->reference->exact(b, sparse.times.back());
            sparse.states.push_back({ideal->position.value_or(*exact.position), *exact.orientation,
                                     *ideal->velocity, *exact.angularVelocity});
        }
    }
    c->run = sparse;
    EXPECT_LT(c->worst("scheme_position_max"), 1e-13);
}

TEST(Mechanics, ClosedForms) {
    Scenario s = emptyScene(3, {0, -10, 0}, 1);
    addBox(s, "box", {0.5, 1, 1.5}, 12, {});
    s.bodies[0].gravityScale = 0.5;
    s.bodies[0].massProperties.centerOfMass = {0, 1, 0};
    s.forces.push_back(SpringForce{kNone, 0, {0, 0, 3}, {}, 8, 0, 1});
    const Mat3 I = s.bodies[0].massProperties.inertia;  // 12/3 (1 + 2.25), ...
    EXPECT_NEAR(I(0, 0), 13, 1e-13);
    const Quat q = fromAxisAngle({0, 0, 1}, M_PI / 2);  // body x to world y, the centre of mass to (-1, 0, 0)
    const std::vector<BodyState> states{{{2, 3, 0}, q, {1, 2, 2}, {0, 0.5, 0}}};
    const Mechanics m = mechanicsOf(s, states);
    EXPECT_NEAR(m.kinetic, 0.5 * 12 * 9 + 0.5 * 13 * 0.25, 1e-12);
    // -m g.x with half gravity, and a spring from (0,0,3) to (2,3,0): length sqrt(22).
    EXPECT_NEAR(m.potential, 12 * 5 * 3 + 0.5 * 8 * std::pow(std::sqrt(22.0) - 1, 2), 1e-12);
    EXPECT_NEAR(m.centerOfMass.x, 1, 1e-14);
    EXPECT_NEAR(m.momentum.y, 24, 1e-14);
    EXPECT_NEAR(m.angularMomentum.y, 13 * 0.5, 1e-13);
    Scenario flat = s;
    flat.dimension = 2;
    flat.forces.clear();
    const std::vector<BodyState> planar{{{0, 0, 0}, {}, {}, {0, 0, 3}}};
    EXPECT_NEAR(mechanicsOf(flat, planar).kinetic, 0.5 * I(2, 2) * 9, 1e-13);
}

TEST(Energy, InjectedDriftAndGain) {
    const auto c = flight();
    const double scale = energyScale(c->input());
    const double kinetic = mechanicsOf(c->scenario, c->run.frame(100)).kinetic;
    EXPECT_NEAR(scale, kinetic, 1e-9 * kinetic);  // the falling bodies are fastest at the end
    // A lift of 0.5 m at one frame: 2 kg x 9.81 x 0.5.
    c->state(50, 0).position += {0, 0.5, 0};
    EXPECT_NEAR(c->worst("energy_drift"), 9.81 / scale, 1e-12);
    EXPECT_NEAR(c->worst("energy_gain"), 9.81 / scale, 1e-12);
    EXPECT_NEAR(c->worst("energy_error"), 9.81 / scale, 1e-12);
    EXPECT_LT(c->worst("energy_final"), 1e-12);
    // Falling below the exact energy is drift, and coming back from there is gain.
    c->state(50, 0).position += {0, -1.0, 0};
    EXPECT_NEAR(c->worst("energy_drift"), 9.81 / scale, 1e-12);
    EXPECT_NEAR(c->worst("energy_gain"), 9.81 / scale, 1e-12);
}

TEST(Energy, AppliesOnlyWhereItShould) {
    auto c = flight();
    c->scenario.forces.push_back(ConstantForce{0, {1, 0, 0}, {}});
    EXPECT_TRUE(c->rows("energy_drift").empty());
    EXPECT_TRUE(c->rows("energy_gain").empty());
    c->scenario.forces = {DragForce{0, 0.5}};
    EXPECT_TRUE(c->rows("energy_drift").empty());
    EXPECT_FALSE(c->rows("energy_gain").empty());  // drag can only take
    // A sliding block loses energy: no drift, but gain and the exact solution's energy.
    MetricCase slide;
    slide.scenario = emptyScene(3, {0, -9.81, 0}, 1);
    addFloor(slide.scenario);
    addBox(slide.scenario, "block", {0.2, 0.1, 0.2}, 1, {0, 0.1, 0}, {2, 0, 0});
    slide.scenario.materials[0].friction = 0.5;
    setReference(slide.scenario, "sliding_stop");
    slide.reference = makeReference(slide.scenario);
    slide.run = exactRun(slide.scenario, *slide.reference, 0.01, 100);
    EXPECT_TRUE(slide.rows("energy_drift").empty());
    EXPECT_LT(slide.worst("energy_error"), 1e-12);
    EXPECT_LT(slide.worst("energy_gain"), 1e-12);
    slide.state(100, 1).velocity = {1, 0, 0};
    EXPECT_NEAR(slide.worst("energy_gain"), 0.5 / 2.0, 1e-12);
    // Rolling keeps energy in spite of friction: the exact solution says so.
    MetricCase roll;
    roll.scenario = emptyScene(3, {1, -9.81, 0}, 1);
    addFloor(roll.scenario);
    addBall(roll.scenario, "ball", 0.1, 1, 0.4, {0, 0.1, 0});
    roll.scenario.materials[0].friction = 0.5;
    setReference(roll.scenario, "rolling_incline");
    roll.reference = makeReference(roll.scenario);
    roll.run = exactRun(roll.scenario, *roll.reference, 0.01, 100);
    EXPECT_GE(roll.worst("energy_drift"), 0.0);
    EXPECT_LT(roll.worst("energy_drift"), 1e-12);
}

TEST(Momentum, InjectedDriftAndInapplicability) {
    const auto c = flight();
    const double scale = 2 * std::sqrt(10.0) + 2 + 3 * 9.81;
    c->state(30, 0).velocity += {0, 0, 0.6};
    EXPECT_NEAR(c->worst("linear_momentum_drift"), 2 * 0.6 / scale, 1e-12);
    EXPECT_GT(c->worst("angular_momentum_drift"), 1e-3);
    const auto spin = flight();
    const Mechanics start = mechanicsOf(spin->scenario, spin->run.frame(0));
    spin->state(30, 0).angularVelocity += {0, 5, 0};
    EXPECT_NEAR(spin->worst("angular_momentum_drift"), 0.4 * 2 * 0.01 * 5 / start.angularScale, 1e-12);
    EXPECT_LT(spin->worst("linear_momentum_drift"), 1e-13);
    addFloor(spin->scenario);
    spin->reference = makeReference(spin->scenario);  // it refers to the bodies, which have moved in memory
    spin->run = Trajectory{};
    MetricCase floor{spin->scenario, nullptr, exactRun(spin->scenario, *spin->reference, 0.01, 10)};
    EXPECT_TRUE(floor.rows("linear_momentum_drift").empty());
    EXPECT_TRUE(floor.rows("angular_momentum_drift").empty());
}

/// A ball at rest on a half-space and one on a box.
std::unique_ptr<MetricCase> restingBalls() {
    auto c = std::make_unique<MetricCase>();
    c->scenario = emptyScene(3, {0, -9.81, 0}, 1);
    addFloor(c->scenario);
    addBox(c->scenario, "box", {0.5, 0.5, 0.5}, 2, {0, 0.5, 0});
    addBall(c->scenario, "ball", 0.2, 1, 0.4, {0, 1.2, 0});
    setReference(c->scenario, "at_rest");
    c->reference = makeReference(c->scenario);
    c->run = exactRun(c->scenario, *c->reference, 0.01, 100);
    return c;
}

/// A contact is held against the poses of its own frame: the box is tilted at frame 20 alone.
TEST(Contacts, NormalsBelongToThePosesOfTheirFrame) {
    const auto c = restingBalls();
    c->state(20, 1).orientation = scenario::fromAxisAngle({0, 0, 1}, 0.1);
    ContactPoint touch;
    touch.bodyA = 1;
    touch.bodyB = 2;
    touch.normal = {-std::sin(0.1), std::cos(0.1), 0};
    c->run.contacts[20] = {touch};
    EXPECT_LT(c->worst("normal_error"), 1e-12);
    for (const std::size_t other : {19, 21}) {
        c->run.contacts[20].clear();
        c->run.contacts[other] = {touch};
        EXPECT_NEAR(c->worst("normal_error"), 0.1, 1e-12);
        EXPECT_NEAR(c->rows("normal_error")[0].at, 0.01 * other, 1e-12);
        c->run.contacts[other].clear();
    }
}

TEST(Contacts, DepthOverlapAndNormals) {
    const auto c = restingBalls();
    EXPECT_EQ(c->worst("penetration_max"), 0.0);
    EXPECT_LT(c->worst("overlap_max"), 1e-15);
    EXPECT_TRUE(c->rows("normal_error").empty());
    ContactPoint onFloor;
    onFloor.bodyA = 0;
    onFloor.bodyB = 1;
    onFloor.normal = {std::sin(0.02), std::cos(0.02), 0};
    onFloor.depth = 1e-3;
    ContactPoint onBox;
    onBox.bodyA = 1;
    onBox.bodyB = 2;
    onBox.normal = {0, 1, 0};
    onBox.depth = 4e-3;
    c->run.contacts[10] = {onFloor};
    c->run.contacts[20] = {onBox};
    const auto depth = c->rows("penetration_max");
    EXPECT_EQ(depth[0].value, 4e-3);
    EXPECT_NEAR(depth[0].at, 0.2, 1e-14);
    EXPECT_NEAR(c->worst("normal_error"), 0.02, 1e-12);
    // The wrong direction is an error of pi.
    c->run.contacts[20][0].normal = {0, -1, 0};
    EXPECT_NEAR(c->worst("normal_error"), M_PI, 1e-12);
    c->state(50, 2).position.y -= 0.01;
    c->state(60, 1).position.y -= 0.003;
    const auto overlap = c->rows("overlap_max");
    EXPECT_NEAR(overlap[0].value, 0.01, 1e-14);
    EXPECT_NEAR(overlap[0].at, 0.5, 1e-14);
    EXPECT_TRUE(flight()->rows("overlap_max").size() > 0);
}

TEST(ClosedForms, DistancesAndNormalsOfPosedPairs) {
    const Pose at{{1, 2, 3}, normalized(Quat{0.8, 0.1, -0.4, 0.3})};
    // A sphere 0.3 above the +x face of a posed box.
    const auto pair =
        closedFormPair(Sphere{0.1}, {at * Vec3{0.8, 0.1, -0.2}, {}}, Box{{0.5, 0.6, 0.7}}, at, 3);
    ASSERT_TRUE(pair.has_value());
    EXPECT_NEAR(pair->distance, 0.2, 1e-14);
    EXPECT_NEAR(dot(pair->normal, rotate(at.orientation, {-1, 0, 0})), 1, 1e-14);
    const auto corner =
        closedFormPair(Box{{0.5, 0.6, 0.7}}, at, Sphere{0.1}, {at * Vec3{0.7, 0.8, 0.9}, {}}, 3);
    EXPECT_NEAR(corner->distance, std::sqrt(3.0) * 0.2 - 0.1, 1e-14);
    const HalfSpace half{{0, 1, 0}, -0.5};
    const auto capsule =
        closedFormPair(half, {}, Capsule{0.2, 1.0}, {{0, 2, 0}, fromAxisAngle({0, 0, 1}, M_PI / 6)}, 3);
    EXPECT_NEAR(capsule->distance, 2 - std::cos(M_PI / 6) - 0.2 + 0.5, 1e-14);
    EXPECT_NEAR(capsule->normal.y, 1, 1e-15);
    EXPECT_FALSE(closedFormPair(Box{{1, 1, 1}}, {}, Box{{1, 1, 1}}, {}, 3).has_value());
}

TEST(Joints, InjectedSeparationAndTilt) {
    MetricCase c;
    c.scenario = emptyScene(3, {}, 1);
    addBox(c.scenario, "rod", {0.1, 0.5, 0.1}, 1, {0, -0.5, 0});
    addBox(c.scenario, "slide", {0.1, 0.1, 0.1}, 1, {3, 0, 0});
    addBox(c.scenario, "weight", {0.1, 0.1, 0.1}, 1, {6, -2, 0});
    Joint hinge{"hinge", JointType::Hinge, kNone,     0, {}, {0, 0.5, 0}, {0, 0, 1}, {0, 0, 1}, 0,
                false,   {1, 0, 0},        {0, 0, 1}, {}};
    Joint slider{"slider", JointType::Slider, kNone,     1, {3, 0, 0}, {}, {1, 0, 0}, {1, 0, 0}, 0,
                 false,    {1, 0, 0},         {0, 0, 1}, {}};
    Joint rope{"rope", JointType::Distance, kNone,     2, {6, 0, 0}, {}, {}, {}, 2,
               false,  {1, 0, 0},           {0, 0, 1}, {}};
    c.scenario.joints = {hinge, slider, rope};
    setReference(c.scenario, "free_flight");
    Scenario still = c.scenario;
    still.joints.clear();
    c.run = exactRun(still, *makeReference(still), 0.01, 10);
    EXPECT_EQ(c.worst("joint_drift"), 0.0);
    c.state(4, 0).position += {0.003, 0, 0.004};
    c.state(5, 1).position += {0.5, 0.002, 0};  // the motion along the axis is free
    c.state(6, 2).position += {0, -0.07, 0};
    const auto rows = c.rows("joint_drift");
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_NEAR(rows[0].value, 0.07, 1e-14);
    EXPECT_NEAR(rows[1].value, 0.005, 1e-14);
    EXPECT_NEAR(rows[2].value, 0.002, 1e-14);
    c.state(7, 0).orientation = fromAxisAngle({1, 0, 0}, 0.03);
    c.state(7, 1).orientation = fromAxisAngle({0, 1, 0}, 0.02);
    const auto axes = c.rows("joint_axis_drift");
    EXPECT_NEAR(axes[1].value, 0.03, 1e-14);
    EXPECT_NEAR(axes[2].value, 0.02, 1e-14);
    EXPECT_EQ(axes.size(), 3U);
    EXPECT_TRUE(flight()->rows("joint_drift").empty());
}

/// A body at each joint with limits, and a run in which it stands still but for what the test moves.
TEST(Joints, InjectedLimitViolation) {
    MetricCase c;
    c.scenario = emptyScene(3, {}, 1);
    const Vec3 axis{0, 0, 1}, along{1, 0, 0};
    const auto add = [&](JointType type, std::size_t k, double lower, double upper, Vec3 a) {
        const int b = addBall(c.scenario, std::string("b") + jointName(type), 0.1, 1, 0.4,
                              {2.0 * c.scenario.bodies.size(), 1, 0});
        Joint j;
        j.name = jointName(type);
        j.type = type;
        j.bodyB = b;
        j.anchorA = c.scenario.bodies.back().pose.position;
        if (type == JointType::Distance) j.anchorA.y -= 0.5;
        j.axisA = j.axisB = a;
        j.normalA = {0, 1, 0};
        j.spinAxisB = axis;
        j.axes[k].mode = AxisMode::Limited;
        j.axes[k].lower = lower;
        j.axes[k].upper = upper;
        c.scenario.joints.push_back(j);
    };
    add(JointType::Hinge, 0, -0.4, 8.0, axis);
    add(JointType::Slider, 0, -0.2, 0.3, along);
    add(JointType::Distance, 0, 0.4, 0.6, along);
    add(JointType::Ball, 0, -1e300, 0.5, along);
    add(JointType::ConeTwist, 1, -1e300, 0.25, along);
    add(JointType::Wheel, 0, -0.1, 0.1, Vec3{0, 1, 0});
    add(JointType::SixDof, 4, -0.3, 0.3, along);
    setReference(c.scenario, "free_flight");
    Scenario still = c.scenario;
    still.joints.clear();
    c.run = exactRun(still, *makeReference(still), 0.1, 10);
    ASSERT_EQ(c.rows("joint_limit_violation").size(), 8U);
    EXPECT_EQ(c.worst("joint_limit_violation"), 0.0);

    // The hinge turns on and on: 8.2 rad are counted over the turn, whatever the quaternion says.
    for (std::size_t k = 0; k <= 10; ++k) c.state(k, 0).orientation = fromAxisAngle(axis, 0.82 * k);
    c.state(3, 1).position += {-0.25, 0.7, 0};                       // 0.05 beyond; across does not count
    c.state(4, 2).position += {0, -0.2, 0};                          // 0.3 long
    c.state(5, 3).orientation = fromAxisAngle({0, 0.6, 0.8}, 0.57);  // swings 0.57
    c.state(5, 4).orientation = fromAxisAngle(along, 1.0) * fromAxisAngle({0, 1, 0}, 0.28);  // twist is free
    c.state(6, 5).position += {0.3, 0.12, 0};
    c.state(6, 6).orientation = fromAxisAngle({0, 1, 0}, -0.36);
    const double expected[] = {0.2, 0.05, 0.1, 0.07, 0.03, 0.02, 0.06};
    const char* subjects[] = {"hinge.angle",      "slider.travel", "distance.length", "ball.swing",
                              "cone_twist.swing", "wheel.travel",  "six_dof.swing_y"};
    const auto rows = c.rows("joint_limit_violation");
    EXPECT_NEAR(rows[0].value, 0.2, 1e-12);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(rows[i + 1].subject, subjects[i]);
        EXPECT_NEAR(rows[i + 1].value, expected[i], 1e-12) << subjects[i];
    }
    // The free coordinates of a six_dof joint do not count as drift.
    c.scenario.joints[6].axes[0].mode = AxisMode::Free;
    c.state(7, 6).position += {0.4, 0.003, 0.004};
    const auto drift = c.rows("joint_drift");
    EXPECT_EQ(drift.back().subject, "six_dof");
    EXPECT_NEAR(drift.back().value, 0.005, 1e-14);
    for (Joint& j : c.scenario.joints) j.breakForce = 10;
    EXPECT_TRUE(c.rows("joint_limit_violation").empty()) << "broken joints keep nothing";
    EXPECT_TRUE(flight()->rows("joint_limit_violation").empty());
}

/// Springs, motors and stops of joints store, add and take energy: its change measures nothing there.
TEST(Energy, DoesNotJudgeDrivenJoints) {
    MetricCase c;
    c.scenario = emptyScene(3, {0, -9.81, 0}, 1);
    addBall(c.scenario, "ball", 0.1, 1, 0.4, {0, 1, 0});
    c.scenario.bodies[0].collides = false;
    Joint j;
    j.name = "slider";
    j.type = JointType::Slider;
    j.bodyB = 0;
    j.anchorA = {0, 1, 0};
    j.axisA = j.axisB = {0, 1, 0};
    c.scenario.joints = {j};
    setReference(c.scenario, "joint_coordinate");
    const auto judged = [&](const char* metric) {
        c.reference = makeReference(c.scenario);
        c.run = exactRun(c.scenario, *c.reference, 0.01, 100);
        return !c.rows(metric).empty();
    };
    EXPECT_TRUE(judged("energy_drift"));
    EXPECT_LT(c.worst("energy_drift"), 1e-13) << "a free slider falls";
    JointAxis& axis = c.scenario.joints[0].axes[0];
    axis.mode = AxisMode::Limited;
    axis.lower = -2;
    axis.upper = 1;
    EXPECT_FALSE(judged("energy_drift")) << "the stop is hit at 0.64 s";
    EXPECT_TRUE(judged("energy_gain"));
    axis.lower = -50;
    EXPECT_TRUE(judged("energy_drift")) << "the stop is out of reach";
    axis.stiffness = 30;
    EXPECT_FALSE(judged("energy_drift"));
    EXPECT_FALSE(judged("energy_gain"));
    axis.stiffness = 0;
    axis.motorMaxForce = 5;
    EXPECT_FALSE(judged("energy_gain"));
}

TEST(Rest, SinkCreepJitterTurn) {
    const auto c = restingBalls();
    for (const char* name :
         {"rest_motion", "rest_sink", "rest_creep", "rest_turn", "rest_jitter", "kinetic_energy_final"})
        EXPECT_EQ(c->worst(name), 0.0) << name;
    c->state(30, 2).position += {0, -0.004, 0.003};
    EXPECT_NEAR(c->worst("rest_sink"), 0.004, 1e-15);
    EXPECT_NEAR(c->worst("rest_motion"), 0.005, 1e-15);
    EXPECT_EQ(c->worst("rest_creep"), 0.0);
    c->state(100, 1).position += {0.006, 0.5, 0.008};
    EXPECT_NEAR(c->worst("rest_creep"), 0.01, 1e-15);
    EXPECT_NEAR(c->worst("rest_sink"), 0.004, 1e-15);
    c->state(10, 1).orientation = fromAxisAngle({0, 0, 1}, 0.1);
    EXPECT_NEAR(c->worst("rest_turn"), 0.1, 1e-14);
    for (std::size_t k = 76; k <= 100; ++k) c->state(k, 2).velocity = {0.03, 0, k % 2 ? 0.04 : -0.04};
    EXPECT_NEAR(c->worst("rest_jitter"), 0.05, 1e-14);
    EXPECT_NEAR(c->worst("kinetic_energy_final"), 0.5 * 0.0025, 1e-15);
    EXPECT_TRUE(flight()->rows("rest_motion").empty());
    EXPECT_TRUE(flight()->rows("rest_jitter").empty());
}

TEST(Quantities, RelativeErrorsMissingEventsAndTimes) {
    MetricCase c;
    c.scenario = emptyScene(3, {0, -9.81, 0}, 2);
    addBall(c.scenario, "ball", 0.1, 1, 0.4, {0, 1.1, 0});
    addFloor(c.scenario);
    c.scenario.materials[0].restitution = 0.8;
    setReference(c.scenario, "bouncing_ball");
    c.reference = makeReference(c.scenario);
    c.run = exactRun(c.scenario, *c.reference, 0.01, 200);
    EXPECT_LT(c.worst("quantity_error"), 1e-10);
    EXPECT_LT(c.worst("event_time_error"), 1e-10);
    // A clock that runs 1 % fast: every event time is off by 1 % of itself.
    MetricCase fast{c.scenario, makeReference(c.scenario), c.run};
    for (auto& t : fast.run.times) t *= 1.01;
    fast.run.dt *= 1.01;
    for (const auto& row : fast.rows("event_time_error")) {
        EXPECT_GT(row.value, 0.009 * 0.4515);
        EXPECT_LT(row.value, 0.011 * 1.752);
    }
    // A ball that never comes back counts fully.
    MetricCase stuck{c.scenario, makeReference(c.scenario), c.run};
    for (std::size_t k = 0; k < stuck.run.frames(); ++k) stuck.state(k, 0).velocity = {};
    EXPECT_EQ(stuck.worst("quantity_error"), 1.0);
    EXPECT_EQ(stuck.worst("event_time_error"), 2.0);
    EXPECT_TRUE(flight()->rows("quantity_error").empty());
}

TEST(Robustness, NotANumberIsInfinitelyWrongAndNothingThrows) {
    for (auto* make : {+[] { return flight(); }, +[] { return restingBalls(); }}) {
        const auto c = make();
        const double nan = std::numeric_limits<double>::quiet_NaN();
        for (std::size_t k = 50; k < c->run.frames(); ++k)
            for (std::size_t b = 0; b < c->run.bodyCount; ++b)
                c->state(k, b) = {{nan, nan, nan}, {nan, nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}};
        for (const auto& entry : metricTable())
            EXPECT_NO_THROW((void)entry.evaluate(c->input())) << entry.name;
        EXPECT_EQ(c->worst("position_final"), std::numeric_limits<double>::infinity());
        EXPECT_EQ(c->worst("energy_gain"), std::numeric_limits<double>::infinity());
        EXPECT_NO_THROW((void)diagnosticSeries(c->input()));
        MetricCase empty{c->scenario, makeReference(c->scenario), Trajectory{}};
        empty.run.bodyCount = c->run.bodyCount;
        for (const auto& entry : metricTable())
            EXPECT_TRUE(entry.evaluate(empty.input()).empty()) << entry.name;
    }
}

TEST(Series, CurvesCarryTheErrorsOfTheFrames) {
    const auto c = flight();
    c->state(70, 1).position += {0, 0, 0.3};
    bool seen = false;
    for (const auto& s : diagnosticSeries(c->input())) {
        EXPECT_EQ(s.values.size(), 101U) << s.name;
        if (s.name == "position_error" && s.subject == "b") {
            EXPECT_NEAR(s.values[70], 0.3, 1e-14);
            EXPECT_LT(s.values[71], 1e-14);
            seen = true;
        }
    }
    EXPECT_TRUE(seen);
}

TEST(Table, NamesAreUniqueAndComplete) {
    for (std::size_t i = 0; i < metricTable().size(); ++i) {
        const auto& entry = metricTable()[i];
        EXPECT_EQ(findMetric(entry.name), &entry);
        EXPECT_NE(std::string(entry.unit), "");
        EXPECT_STRNE(metricKindName(entry.kind), "unknown");
    }
    EXPECT_EQ(findMetric("no_such_metric"), nullptr);
}

}  // namespace
}  // namespace rigor::validation::testing
