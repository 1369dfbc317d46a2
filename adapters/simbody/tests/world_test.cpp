// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Behaviour of Simbody's own: integrators and their order, refusals, motors that hold, loops of every kind, joints that
// break, impulses within a mechanism.
#include <cmath>

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {
namespace {

int addLink(Scenario& s, const Vec3& position, double mass = 1.0, const Vec3& moments = even(0.1)) {
    const int body = addBody(s, Sphere{0.1}, position, mass, moments);
    s.bodies[body].collides = false;
    return body;
}

/// A rod on a hinge, let go from the side.
Scenario pendulum() {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int rod = addLink(s, {0.5, 0, 0}, 1.0, {0.001, 1.0 / 12, 1.0 / 12});
    s.joints.push_back(jointOf(JointType::Hinge, scenario::kNone, rod, {}, {-0.5, 0, 0}));
    return s;
}

/// Largest distance between two runs of the pendulum for a second.
double distance(int steps, const std::string& one, const std::string& two) {
    Simulation a(pendulum(), 1.0 / steps, one), b(pendulum(), 1.0 / steps, two);
    double most = 0.0;
    for (int i = 0; i < steps; ++i) {
        a.steps(1);
        b.steps(1);
        most = std::max(most, norm(a.state(0).position - b.state(0).position));
    }
    return most;
}

TEST(SimbodyWorld, FixedStepsHaveTheOrderOfTheirIntegrator) {
    const std::pair<const char*, double> orders[] = {{"runge_kutta_merson", 4},
                                                     {"runge_kutta_feldberg", 4},
                                                     {"runge_kutta_3", 3},
                                                     {"runge_kutta_2", 2},
                                                     {"verlet", 2},
                                                     {"semi_explicit_euler_2", 1},
                                                     {"semi_explicit_euler", 1},
                                                     {"explicit_euler", 1}};
    for (const auto& [name, order] : orders) {
        SCOPED_TRACE(name);
        const std::string options = std::string("preset=matched,integrator=") + name;
        const double coarse = distance(40, options, "preset=reference");
        const double fine = distance(80, options, "preset=reference");
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.6) << coarse << " " << fine;
    }
}

TEST(SimbodyWorld, ControlledStepsFollowTheAccuracy) {
    for (const char* name : {"runge_kutta_merson", "runge_kutta_3", "verlet", "cpodes"}) {
        SCOPED_TRACE(name);
        const auto error = [&](const char* accuracy) {
            return distance(2, std::string("preset=default,integrator=") + name + ",accuracy=" + accuracy,
                            "preset=reference");
        };
        EXPECT_LE(error("1e-6"), 1e-4);
        EXPECT_LT(error("1e-6"), error("1e-2"));
    }
}

TEST(SimbodyWorld, IntegratorsRefuseStepsTheyDoNotHave) {
    EXPECT_THROW(Simulation(pendulum(), 0.01, "preset=matched,integrator=cpodes"), adapter::BadInput);
    EXPECT_THROW(Simulation(pendulum(), 0.01, "preset=default,integrator=semi_explicit_euler"),
                 adapter::BadInput);
}

/// Shapes that only give mass and a picture are no contacts.
TEST(SimbodyWorld, OnlyShapesThatCanTouchAreRefused) {
    Scenario s = scene();
    addBody(s, Sphere{0.5}, {0, 3, 0});
    EXPECT_NO_THROW(Simulation(s, 0.01));
    const int floor = addStatic(s, scenario::HalfSpace{});
    try {
        Simulation simulation(s, 0.01);
        FAIL() << "built with shapes that can touch";
    } catch (const adapter::Unsupported& refusal) {
        EXPECT_EQ(refusal.refusal(), adapter::Refusal::NotInLibrary);
        EXPECT_NE(std::string(refusal.what()).find("compliant"), std::string::npos) << refusal.what();
    }
    s.bodies[floor].collides = false;
    EXPECT_NO_THROW(Simulation(s, 0.01));
    s.bodies[floor].collides = true;
    s.joints.push_back(jointOf(JointType::Fixed, floor, 0, {0, 3, 0}, {}));
    EXPECT_NO_THROW(Simulation(s, 0.01)) << "a joint keeps them apart";
    s.joints[0].breakForce = 10.0;
    EXPECT_THROW(Simulation(s, 0.01), adapter::Unsupported) << "until it breaks";
}

TEST(SimbodyWorld, StopsAndImpossibleInertiasAreRefused) {
    Scenario stop = pendulum();
    stop.joints[0].axes[0].mode = scenario::AxisMode::Limited;
    stop.joints[0].axes[0].upper = 1.0;
    Scenario inertia = scene();
    addLink(inertia, {}, 1.0, {0.1, 0.1, 0.3});
    for (const auto& [s, what] : {std::pair{stop, "HardStopUpper"}, {inertia, "moment of inertia"}}) try {
            Simulation simulation(s, 0.01);
            FAIL() << what;
        } catch (const adapter::Unsupported& refusal) {
            EXPECT_NE(std::string(refusal.what()).find(what), std::string::npos) << refusal.what();
        }
}

/// The load of a driven rod changes all the time; a force that is held for a step would leave 1e-3 rad/s.
TEST(SimbodyWorld, AMotorThatIsStrongEnoughKeepsItsSpeedExactly) {
    Scenario s = pendulum();
    s.joints[0].axes[0].motorSpeed = 2.0;
    s.joints[0].axes[0].motorMaxForce = 100.0;
    Simulation simulation(s, 1.0 / 60.0);
    simulation.steps(10);
    for (int i = 0; i < 120; ++i) {
        simulation.steps(1);
        EXPECT_NEAR(simulation.state(0).angularVelocity.z, 2.0, 1e-9) << i;
    }
    // It lets go where its force does not suffice: 4.9 N m are needed to lift the rod.
    s.joints[0].axes[0].motorMaxForce = 1.0;
    s.joints[0].axes[0].motorSpeed = 0.0;
    Simulation weak(s, 1.0 / 60.0);
    weak.steps(12);
    EXPECT_LT(weak.state(0).angularVelocity.z, -1.0);
}

/// Two bodies between the same anchors: the second joint closes a loop.
TEST(SimbodyWorld, EveryKindOfLoopHolds) {
    for (const int dimension : {2, 3})
        for (const JointType type :
             {JointType::Ball, JointType::Hinge, JointType::Fixed, JointType::Slider}) {
            if (dimension == 2 && type == JointType::Ball) continue;
            SCOPED_TRACE(std::to_string(dimension) + " " + scenario::jointName(type));
            Scenario s = scene(0.0, 0.0, dimension);
            s.gravity = {};
            const int a = addLink(s, {0, 0, 0}), b = addLink(s, {1, 0, 0});
            for (int k = 0; k < 2; ++k) {
                Joint joint = jointOf(type, a, b, {0.5, 0, 0}, {-0.5, 0, 0});
                if (type == JointType::Slider) joint.axisA = joint.axisB = {1, 0, 0};
                s.joints.push_back(joint);
            }
            s.bodies[a].velocity = s.bodies[b].velocity = {0, 1, 0};
            Simulation simulation(s, 0.01);
            for (int i = 0; i < 100; ++i) {
                simulation.world->applyForce(b, {0, 0.5, 0}, {0, 0, 0.1});
                simulation.steps(1);
            }
            const BodyState A = simulation.state(a), B = simulation.state(b);
            const Vec3 gap = A.position + rotate(A.orientation, Vec3{0.5, 0, 0}) - B.position -
                             rotate(B.orientation, Vec3{-0.5, 0, 0});
            const bool slides = type == JointType::Slider;
            EXPECT_LE(slides ? std::abs(rotateInverse(A.orientation, gap).y) : norm(gap), 1e-9);
            if (slides || type == JointType::Fixed) {
                EXPECT_NEAR(A.orientation.z, B.orientation.z, 1e-9);
            }
            EXPECT_GT(B.position.y, 1.1);
        }
}

/// The body hangs away from the origin, turned, by a point half a metre beside its centre of mass.
TEST(SimbodyWorld, AJointBreaksByForceAndByTorqueAboutItsAnchor) {
    constexpr double kStep = 1.0 / 240.0;
    for (const JointType type : {JointType::Fixed, JointType::Hinge})
        for (const bool torque : {false, true}) {
            SCOPED_TRACE(std::string(scenario::jointName(type)) + (torque ? ", torque" : ", force"));
            Scenario s = scene();
            s.gravity = {0, -9.81, 0};
            const Quat turned = scenario::fromAxisAngle({0, 1, 0}, 0.7);
            const int b = addLink(s, {3, 2, -1}, 4.0, {0.2, 0.3, 0.4});
            s.bodies[b].pose.orientation = turned;
            Joint joint =
                jointOf(type, scenario::kNone, b, s.bodies[b].pose * Vec3{-0.5, 0, 0}, {-0.5, 0, 0});
            joint.axisB = {1, 0, 0};
            joint.axisA = rotate(turned, joint.axisB);
            (torque ? joint.breakTorque : joint.breakForce) =
                torque ? 0.5 * 4.0 * 9.81 + 1.0 : 4.0 * 9.81 + 2.0;
            s.joints.push_back(joint);
            Simulation simulation(s, kStep);
            std::vector<unsigned char> whole;
            for (int i = 0; i < 240; ++i) {
                if (i == 100) simulation.world->snapshots()->save(whole);
                // 1.9 N more hold either, 2.1 N more at the body (1.05 N m about the anchor) neither.
                simulation.world->applyForce(b, {0, i < 120 ? -1.9 : -2.1, 0}, {});
                simulation.steps(1);
                ASSERT_EQ(simulation.world->jointHolds(0), i < 120) << i;
            }
            // It falls in the step that overloads it.
            const double t = 120 * kStep;
            EXPECT_NEAR(simulation.state(b).position.y, 2.0 - 0.5 * (9.81 + 2.1 / 4.0) * t * t, 1e-6);
            ASSERT_TRUE(simulation.world->snapshots()->restore(whole));
            EXPECT_TRUE(simulation.world->jointHolds(0));
            simulation.steps(20);
            EXPECT_NEAR(simulation.state(b).position.y, 2.0, 1e-9);
        }
}

/// An impulse at the end of a rod on a hinge: w = p r / (I + m r^2), and nothing that the hinge does not allow.
TEST(SimbodyWorld, AnImpulseMovesAMechanismAsItsJointsAllow) {
    for (const bool loop : {false, true}) {
        SCOPED_TRACE(loop);
        Scenario s = pendulum();
        s.gravity = {};
        if (loop) s.joints.push_back(s.joints[0]);
        Simulation simulation(s, 0.01);
        ASSERT_TRUE(simulation.world->applyImpulse(0, {3, 2, 1}, {5, 0, 0.5}));
        const Vec3 turn = simulation.state(0).angularVelocity;
        EXPECT_NEAR(turn.z, (2 * 0.5 + 0.5) / (1.0 / 12 + 0.25), 1e-9);
        EXPECT_LE(std::abs(turn.x) + std::abs(turn.y), 1e-12);
    }
}

/// Steps of one size that lead beyond all numbers end the run; a snapshot brings it back.
TEST(SimbodyWorld, ALostRunHasNoNumbersAndComesBackBySnapshot) {
    Scenario s = scene();
    const int body = addLink(s, {1, 0, 0});
    scenario::SpringForce spring;
    spring.bodyB = body;
    spring.stiffness = 1e12;
    s.forces.push_back(spring);
    Simulation simulation(s, 0.01);
    std::vector<unsigned char> start;
    simulation.world->snapshots()->save(start);
    simulation.steps(200);
    EXPECT_TRUE(std::isnan(simulation.state(body).position.x));
    ASSERT_TRUE(simulation.world->snapshots()->restore(start));
    EXPECT_EQ(simulation.state(body).position.x, 1.0);
}

/// A wheel's and a six_dof's coordinates one behind the other, from either side.
TEST(SimbodyWorld, TravelAndTurnAreCoordinatesOfOneJoint) {
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(reversed);
        Scenario s = scene();
        s.gravity = {};
        const int b = addLink(s, {0.3, 0, 0}, 2.0, {0.2, 0.2, 0.2});
        const int a = reversed ? addStatic(s, Sphere{0.1}) : scenario::kNone;
        if (reversed) s.bodies[a].collides = false;
        Joint joint = jointOf(JointType::SixDof, reversed ? b : a, reversed ? a : b,
                              reversed ? Vec3{-0.3, 0, 0} : Vec3{}, reversed ? Vec3{} : Vec3{-0.3, 0, 0});
        joint.axisA = joint.axisB = {0, 1, 0};
        joint.normalA = {1, 0, 0};
        joint.axes[0].mode = scenario::AxisMode::Free;
        joint.axes[3].mode = scenario::AxisMode::Free;
        s.joints.push_back(joint);
        s.bodies[b].velocity = Vec3{0, 0.5, 0} + cross(Vec3{0, 2, 0}, Vec3{0.3, 0, 0});
        s.bodies[b].angularVelocity = {0, 2, 0};
        Simulation simulation(s, 0.01);
        simulation.steps(100);
        const BodyState end = simulation.state(b);
        EXPECT_NEAR(end.position.y, 0.5, 1e-8);
        EXPECT_NEAR(end.position.x, 0.3 * std::cos(2.0), 1e-6);
        EXPECT_NEAR(end.angularVelocity.y, 2.0, 1e-9);
    }
}

/// Travels with one turn and with all of them free, and a wheel whose pin is no axis of its strut.
TEST(SimbodyWorld, StatesThatTheJointAllowsAreSetAndReadBack) {
    expectStatesReadBack({{0, 1, 2}, {0, 4}, {0, 1, 2, 5}, {0, 1, 2, 3, 4, 5}});
}

/// Two free rods on a ball with a damped spring of the swing come to rest at its target; what turns them turns them against
/// each other.
TEST(SimbodyWorld, TheSpringOfASwingActsOnBothBodies) {
    Scenario s = scene();
    const int a = addLink(s, {-0.5, 0, 0}), b = addLink(s, {0.5, 0, 0});
    Joint joint = jointOf(JointType::Ball, a, b, {0.5, 0, 0}, {-0.5, 0, 0});
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.axes[0].mode = scenario::AxisMode::Free;
    joint.axes[0].stiffness = 4.0;
    joint.axes[0].damping = 1.0;
    joint.axes[0].target = 0.5;
    s.joints.push_back(joint);
    s.bodies[a].angularVelocity = {0, 0, 0.1};
    s.bodies[a].velocity = {0, -0.05, 0};
    s.bodies[b].angularVelocity = {0, 0, -0.1};
    s.bodies[b].velocity = {0, -0.05, 0};
    Simulation world(s, 1.0 / 240, "preset=matched");
    world.steps(4800);
    const BodyState atA = world.state(a), atB = world.state(b);
    EXPECT_NEAR(
        std::acos(dot(rotate(atA.orientation, Vec3{1, 0, 0}), rotate(atB.orientation, Vec3{1, 0, 0}))), 0.5,
        1e-6);
    EXPECT_NEAR(norm(atA.angularVelocity), 0.0, 1e-6);
    EXPECT_NEAR(norm(atB.angularVelocity), 0.0, 1e-6);
}

}  // namespace
}  // namespace rigor::test
