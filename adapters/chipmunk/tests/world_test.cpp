// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Behaviour of Chipmunk's own: the order of a step, lines that its build writes, joints that break.
#include <cmath>
#include <cstdlib>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

Scenario flatScene(double friction = 0.0) {
    Scenario s = scene(friction, 0.0, 2);
    return s;
}
int addDisc(Scenario& s, const Vec3& position) {
    return addBody(s, Sphere{0.1}, position, 1.0, even(0.005));
}

/// cpSpaceStep moves with the velocities of the step before; positions=last moves with the new ones.
TEST(ChipmunkWorld, PositionsFirstAreExplicitEulerAndLastSymplectic) {
    const double dt = 0.01, g = 9.81;
    for (const bool last : {false, true}) {
        Scenario s = flatScene();
        const int b = addDisc(s, {});
        Simulation simulation(s, dt, last ? "positions=last" : "positions=first");
        EXPECT_EQ(simulation.world->scheme(),
                  last ? adapter::Scheme::SymplecticEuler : adapter::Scheme::ExplicitEuler);
        simulation.steps(100);
        const double squares = last ? 100.0 * 101.0 : 100.0 * 99.0;
        EXPECT_NEAR(simulation.state(b).position.y, -0.5 * g * dt * dt * squares, 1e-12);
        EXPECT_EQ(simulation.world->contactInstant(),
                  last ? adapter::ContactInstant::StepStart : adapter::ContactInstant::StepEnd);
    }
}

/// Debian's build writes two lines when the first space of a process is made. Run in a process of its own, in which
/// nothing has been loaded before.
TEST(ChipmunkDeathTest, NothingIsWrittenToTheStandardOutput) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto silent = [] {
        testing::internal::CaptureStdout();
        {
            Scenario s = flatScene();
            addDisc(s, {});
            Simulation(s, 0.01).steps(1);
        }
        std::fflush(stdout);
        std::exit(testing::internal::GetCapturedStdout().empty() ? 0 : 1);
    };
    EXPECT_EXIT(silent(), testing::ExitedWithCode(0), "");
}

/// A disc of 1 kg hangs on a pin that bears 9 N, and then on one that bears 11 N.
TEST(ChipmunkJoints, APinBreaksUnderALoadAboveItsStrength) {
    for (const double strength : {9.0, 11.0}) {
        Scenario s = flatScene();
        const int b = addDisc(s, {0, -1, 0});
        Joint joint;
        joint.name = "pin";
        joint.type = JointType::Hinge;
        joint.bodyB = b;
        joint.anchorA = {0, 0, 0};
        joint.anchorB = {0, 1, 0};
        joint.breakForce = strength;
        s.joints.push_back(joint);
        Simulation simulation(s, 1.0 / 240.0);
        simulation.steps(240);
        EXPECT_EQ(simulation.world->jointHolds(0), strength > 10.0);
        EXPECT_EQ(simulation.state(b).position.y < -2.0, strength < 10.0);
    }
}

TEST(ChipmunkWorld, TwoTravelsOfASixDofAreRefusedWithADocument) {
    Scenario s = flatScene();
    const int b = addDisc(s, {});
    Joint joint;
    joint.name = "table";
    joint.type = JointType::SixDof;
    joint.bodyB = b;
    joint.axisA = joint.axisB = {1, 0, 0};
    joint.normalA = {0, 1, 0};
    joint.axes[0].mode = joint.axes[1].mode = scenario::AxisMode::Free;
    s.joints.push_back(joint);
    try {
        Simulation simulation(s, 0.01);
        ADD_FAILURE() << "built";
    } catch (const adapter::Unsupported& refused) {
        EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInLibrary);
        EXPECT_NE(std::string(refused.what()).find("table"), std::string::npos) << refused.what();
    }
}

}  // namespace
}  // namespace rigor::test
