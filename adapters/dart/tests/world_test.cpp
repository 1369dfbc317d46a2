// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Behaviour of DART's own: contacts that no joint lets move, runs that escape, what stands for a half-space.
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

/// Two balls on a hinge whose anchors lie on the line between them: no coordinate brings them nearer, and the row of
/// their contact is zero. DART by itself ends the process there.
TEST(DartWorld, AContactThatNoJointLetsMoveIsReportedAndNotSolved) {
    Scenario s = scene(0.5);
    s.gravity = {};
    const int a = addBody(s, Sphere{0.5}, {0, 0, 0}, 1.0, even(0.1));
    const int b = addBody(s, Sphere{0.5}, {0.8, 0, 0}, 1.0, even(0.1));
    Joint joint;
    joint.name = "pin";
    joint.type = JointType::Hinge;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = {0.4, 0, 0};
    joint.anchorB = {-0.4, 0, 0};
    joint.collideConnected = true;
    s.joints.push_back(joint);
    Simulation simulation(s, 0.01, "preset=matched");
    simulation.steps(3);
    std::vector<adapter::ContactPoint> contacts;
    simulation.world->readContacts(contacts);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].depth, 0.2, 1e-12);
    EXPECT_EQ(contacts[0].normalImpulse, 0.0);
    EXPECT_LE(norm(simulation.state(b).velocity), 1e-12);
}

/// A block slides over triangles of different lengths. FCL's contacts with their backs would stop it at the first one.
TEST(DartWorld, ABlockSlidesOverTheTrianglesOfAChain) {
    Scenario s = scene(0.5);
    scenario::TriangleMesh mesh;
    for (const double x : {-1.5, -1.0, -0.98, -0.7, -0.69, -0.28, 0.583, 0.603, 0.963, 4.0})
        for (const double z : {-1.0, 1.0}) mesh.vertices.push_back({x, 0, z});
    for (int i = 0; i + 3 < static_cast<int>(mesh.vertices.size()); i += 2) {
        mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.triangles.push_back({i + 2, i + 1, i + 3});
    }
    addStatic(s, mesh);
    const Vec3 half{0.25, 0.05, 0.5};
    const int block = addBody(s, Box{half}, {-1, 0.05, 0}, 2.0, boxMoments(2.0, half));
    s.bodies[block].velocity = {4, 0, 0};
    for (const std::string phase : {"fcl_mesh", "ode"}) {
        SCOPED_TRACE(phase);
        Simulation simulation(s, 1.0 / 240.0, "preset=default,narrow_phase=" + phase);
        simulation.steps(240);
        EXPECT_NEAR(simulation.state(block).position.x + 1.0, 16.0 / (2.0 * 0.5 * 9.81), 0.02);
        EXPECT_NEAR(simulation.state(block).position.y, 0.05, 1e-3);
    }
}

/// A top that Euler's step in DART's coordinates drives beyond all bounds ends as numbers that are none, not in an
/// assertion of the library.
TEST(DartWorld, AnEscapedRunHasNoNumbersAndComesBackBySnapshot) {
    Scenario s = scene();
    s.gravity = {0, -9.81, 0};
    const int top = addBody(s, Sphere{0.25}, {0, 1, 0}, 15.0, {0.234375, 0.46875, 0.234375});
    s.bodies[top].collides = false;
    s.bodies[top].velocity = {4.61538, 0, 0};
    s.bodies[top].angularVelocity = {0, 150, -4.61538};
    Joint tip;
    tip.name = "tip";
    tip.type = JointType::Ball;
    tip.bodyB = top;
    tip.anchorB = {0, -1, 0};
    s.joints.push_back(tip);
    Simulation simulation(s, 1.0 / 240.0, "preset=matched");
    ASSERT_NE(simulation.world->snapshots(), nullptr);
    std::vector<unsigned char> start;
    simulation.world->snapshots()->save(start);
    simulation.steps(480);
    EXPECT_TRUE(std::isnan(simulation.state(top).position.x));
    ASSERT_TRUE(simulation.world->snapshots()->restore(start));
    EXPECT_EQ(simulation.state(top).angularVelocity.y, 150.0);
}

/// FCL's narrow phases have no planes: a box of 200 m has a face where the half-space has its surface.
TEST(DartWorld, ABallRestsOnATiltedHalfSpaceInEveryNarrowPhase) {
    const double angle = 0.1;
    const Vec3 normal{std::sin(angle), std::cos(angle), 0};
    for (const std::string phase : {"fcl_mesh", "fcl_primitive", "dart", "ode"}) {
        SCOPED_TRACE(phase);
        Scenario s = scene(1.0);
        s.gravity = -9.81 * normal;
        addStatic(s, scenario::HalfSpace{normal, 0.3});
        const int box = addBody(s, Box{{0.1, 0.1, 0.1}}, 0.4 * normal, 1.0, even(0.01));
        s.bodies[box].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, -angle);
        Simulation simulation(s, 1.0 / 240.0, "preset=matched,narrow_phase=" + phase);
        simulation.steps(240);
        EXPECT_NEAR(dot(simulation.state(box).position, normal), 0.4, 1e-4);
        // FCL's trees remember where shapes have been.
        EXPECT_EQ(simulation.world->snapshots() != nullptr, phase == "ode" || phase == "dart");
    }
}

TEST(DartWorld, WhatClosesALoopIsAPointTwoPointsOrAWeld) {
    for (const JointType type : {JointType::Ball, JointType::Hinge, JointType::Fixed, JointType::Slider}) {
        SCOPED_TRACE(scenario::jointName(type));
        Scenario s = scene();
        s.gravity = {};
        const int a = addBody(s, Sphere{0.1}, {0, 0, 0}, 1.0, even(0.01));
        const int b = addBody(s, Sphere{0.1}, {1, 0, 0}, 1.0, even(0.01));
        for (int k = 0; k < 2; ++k) {
            Joint joint;
            joint.name = "joint" + std::to_string(k);
            joint.type = type;
            joint.bodyA = a;
            joint.bodyB = b;
            joint.anchorA = {0.5, 0.0, 0.0};
            joint.anchorB = {-0.5, 0.0, 0.0};
            s.joints.push_back(joint);
        }
        if (type == JointType::Slider) {
            try {
                Simulation simulation(s, 0.01, "preset=matched");
                FAIL() << "a slider closed a loop";
            } catch (const adapter::Unsupported& refusal) {
                EXPECT_NE(std::string(refusal.what()).find("BallJointConstraint"), std::string::npos);
            }
            continue;
        }
        s.bodies[a].velocity = {0, 1, 0};
        s.bodies[b].velocity = {0, 1, 0};
        Simulation simulation(s, 0.01, "preset=matched");
        simulation.steps(100);
        EXPECT_NEAR(simulation.state(b).position.y, 1.0, 1e-6);
        EXPECT_NEAR(simulation.state(b).position.x - simulation.state(a).position.x, 1.0, 1e-6);
    }
}

/// A joint with a strength is a constraint even where it closes no loop. The body hangs away from the origin, turned, by a
/// point half a metre beside its centre of mass.
TEST(DartWorld, AJointBreaksByForceAndByTorqueAboutItsAnchor) {
    constexpr double kStep = 1.0 / 240.0;
    for (const JointType type : {JointType::Fixed, JointType::Hinge})
        for (const bool torque : {false, true}) {
            SCOPED_TRACE(std::string(scenario::jointName(type)) + (torque ? ", torque" : ", force"));
            Scenario s = scene();
            s.gravity = {0, -9.81, 0};
            const Quat turned = scenario::fromAxisAngle({0, 1, 0}, 0.7);
            const int b = addBody(s, Sphere{0.1}, {3, 2, -1}, 4.0, {0.2, 0.3, 0.4});
            s.bodies[b].pose.orientation = turned;
            Joint joint;
            joint.name = "hold";
            joint.type = type;
            joint.bodyB = b;
            joint.anchorB = {-0.5, 0, 0};
            joint.anchorA = s.bodies[b].pose * joint.anchorB;
            joint.axisB = {1, 0, 0};
            joint.axisA = rotate(turned, joint.axisB);
            (torque ? joint.breakTorque : joint.breakForce) =
                torque ? 0.5 * 4.0 * 9.81 + 1.0 : 4.0 * 9.81 + 2.0;
            s.joints.push_back(joint);
            Simulation simulation(s, kStep, "preset=matched");
            std::vector<unsigned char> whole;
            for (int i = 0; i < 240; ++i) {
                if (i == 100) simulation.world->snapshots()->save(whole);
                // 1.9 N more hold either, 2.1 N more at the body (1.05 N m about the anchor) neither.
                simulation.world->applyForce(b, {0, i < 120 ? -1.9 : -2.1, 0}, {});
                simulation.steps(1);
                ASSERT_EQ(simulation.world->jointHolds(0), i < 120) << i;
            }
            // It falls from the step after the one that broke it.
            const double t = 119 * kStep;
            EXPECT_NEAR(simulation.state(b).position.y, 2.0 - 0.5 * (9.81 + 2.1 / 4.0) * t * t, 3e-2);
            ASSERT_TRUE(simulation.world->snapshots()->restore(whole));
            EXPECT_TRUE(simulation.world->jointHolds(0));
            simulation.steps(20);
            EXPECT_NEAR(simulation.state(b).position.y, 2.0, 1e-4);
        }
}

/// The anchor of a constraint is where the bodies stand, not where DART creates them.
TEST(DartWorld, TwoFreeBodiesTurnAboutTheAnchorOfAJointWithAStrength) {
    Scenario s = scene();
    s.gravity = {};
    const int a = addBody(s, Sphere{0.1}, {3, 2, -1}, 1.0, even(0.01));
    const int b = addBody(s, Sphere{0.1}, {4, 2, -1}, 1.0, even(0.01));
    Joint joint;
    joint.name = "pin";
    joint.type = JointType::Ball;
    joint.bodyA = a;
    joint.bodyB = b;
    joint.anchorA = {0.5, 0, 0};
    joint.anchorB = {-0.5, 0, 0};
    joint.breakForce = 1e6;
    s.joints.push_back(joint);
    s.bodies[a].angularVelocity = {0, 2, 0};
    s.bodies[a].velocity = {0, 0, 1};
    s.bodies[b].angularVelocity = {0, -2, 0};
    s.bodies[b].velocity = {0, 0, 1};
    Simulation simulation(s, 1.0 / 960.0, "preset=matched");
    for (int i = 0; i < 20; ++i) {
        simulation.steps(24);
        const BodyState A = simulation.state(a), B = simulation.state(b);
        EXPECT_LE(norm(A.position + rotate(A.orientation, joint.anchorA) - B.position -
                       rotate(B.orientation, joint.anchorB)),
                  1e-3);
    }
    EXPECT_GT(norm(simulation.state(a).angularVelocity), 0.1);
}

TEST(DartWorld, ShapesOfSingleNarrowPhasesAreRefusedByTheOthers) {
    for (const std::string phase : {"fcl_mesh", "fcl_primitive", "ode"})
        for (const bool field : {false, true}) {
            SCOPED_TRACE(phase + (field ? ", height field" : ", ellipsoid"));
            Scenario s = scene(0.5);
            s.gravity = {0, -9.81, 0};
            const double ground = field ? 0.3 : 0.5;
            if (field)
                addStatic(s, scenario::HeightField{4, 3, 0.5, 0.5, std::vector<double>(12, 0.3), 1.0});
            else
                addStatic(s, scenario::Ellipsoid{{2.0, 0.5, 1.5}});
            const int ball = addBody(s, Sphere{0.2}, {0, ground + 0.21, 0}, 1.0, even(0.016));
            const std::string spec = "preset=matched,narrow_phase=" + phase;
            if (field != (phase == "ode")) {
                EXPECT_THROW(Simulation(s, 1.0 / 240.0, spec), adapter::Unsupported);
                continue;
            }
            Simulation simulation(s, 1.0 / 240.0, spec);
            simulation.steps(120);
            // Meshes have facets.
            EXPECT_NEAR(simulation.state(ball).position.y, ground + 0.2, phase == "fcl_mesh" ? 2e-2 : 1e-3);
        }
}

/// Two triangles bear bodies from both sides, whichever way they run, in every narrow phase that has meshes.
TEST(DartWorld, ATriangleMeshBearsFromBothSides) {
    for (const std::string phase : {"fcl_mesh", "fcl_primitive", "ode"})
        for (const bool turned : {false, true})
            for (const double side : {1.0, -1.0}) {
                SCOPED_TRACE(phase + (turned ? ", turned" : "") + (side > 0 ? ", above" : ", below"));
                Scenario s = scene(0.5);
                s.gravity = {0, -9.81 * side, 0};
                scenario::TriangleMesh mesh;
                mesh.vertices = {{-4, 0, -2}, {-4, 0, 2}, {4, 0, -2}, {4, 0, 2}};
                mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
                if (turned) mesh.triangles = {{0, 2, 1}, {2, 3, 1}};
                addStatic(s, mesh);
                const Geometry shapes[] = {Sphere{0.2}, Box{{0.2, 0.2, 0.2}}, boxHull({0.2, 0.2, 0.2}),
                                           Cylinder{0.3, 0.2}, Capsule{0.2, 0.2}};
                std::vector<int> steady, rocking;
                for (const Geometry& shape : shapes) {
                    // FCL gives a ball on a triangle a negative depth, and DART solves no such contact.
                    if (phase == "fcl_primitive" && std::holds_alternative<Sphere>(shape)) continue;
                    const double x = -2.9 + 1.4 * static_cast<double>(s.bodies.size() - 1);
                    const bool hull = std::holds_alternative<ConvexHull>(shape);
                    (hull ? rocking : steady)
                        .push_back(addBody(s, shape, {x, 0.201 * side, 0.1}, 1.0, even(0.02)));
                    if (std::holds_alternative<Capsule>(shape))
                        s.bodies.back().pose.orientation =
                            scenario::fromAxisAngle({1, 0, 0}, 1.5707963267948966);
                }
                Simulation simulation(s, 1.0 / 240.0, "preset=matched,narrow_phase=" + phase);
                simulation.steps(120);
                // A body that falls through is 1.2 m away. Hulls are meshes too, and rock.
                for (const int b : steady) EXPECT_NEAR(simulation.state(b).position.y, 0.2 * side, 3e-2) << b;
                for (const int b : rocking) EXPECT_NEAR(simulation.state(b).position.y, 0.2 * side, 0.1) << b;
            }
}

}  // namespace
}  // namespace rigor::test
