// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stop: a rod falls to the edge of its cone, a ball joint with an AMotor in user mode, whose one axis and
// angle are set before each step (manual, "AMotor"). The stop acts in the first step that starts beyond it,
// and takes the velocity out there: until then the rod falls as freely as without one, so that it overshoots
// by the rest of a step, here 0.0601 rad of the 0.0725 that it turns in 1/60 s.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

constexpr double kStopStep = 1.0 / 60, kStop = 0.6981317007977318;

double angleOf(dBodyID rod) {
    const dReal* q = dBodyGetQuaternion(rod);
    return -2 * std::atan2(q[3], q[0]);
}

Trajectory fall(bool stops, std::vector<double>& angles) {
    OdeSimulation demo;
    dMass mass;
    dMassSetBoxTotal(&mass, 2, 1, 0.06, 0.06);
    const dBodyID rod = demo.addBody(&mass, {0.5, 0, 0});
    const dJointID socket = dJointCreateBall(demo.world, nullptr);
    dJointAttach(socket, rod, nullptr);
    dJointSetBallAnchor(socket, 0, 0, 0);
    const dJointID motor = dJointCreateAMotor(demo.world, nullptr);
    dJointAttach(motor, rod, nullptr);
    dJointSetAMotorMode(motor, dAMotorUser);
    dJointSetAMotorNumAxes(motor, 1);
    dJointSetAMotorAxis(motor, 0, 0, 0, 0, -1);
    if (stops) dJointSetAMotorParam(motor, dParamHiStop, kStop);
    Trajectory trajectory{demo.states()};
    for (int i = 0; i < 120; ++i) {
        angles.push_back(angleOf(rod));
        dJointSetAMotorAngle(motor, 0, angles.back());
        demo.step(kStopStep);
        trajectory.push_back(demo.states());
    }
    return trajectory;
}

/// The adapter takes axis and angle from the cone's gradient: the same to rounding.
TEST(PlainOde, StopOfACone) {
    std::vector<double> angles, freely;
    const Trajectory plain = fall(true, angles), unstopped = fall(false, freely);
    const Scenario scene = load("scenarios/library/3d/cone_twist_stop.json");
    EXPECT_TRUE(
        same(plain, adapterRun("ode:preset=default", scene, kStopStep, 120), {1e-12, 1e-12, 1e-11, 1e-11}));

    std::size_t beyond = 0;
    while (angles[beyond] < kStop) ++beyond;
    for (std::size_t i = 0; i <= beyond; ++i) EXPECT_EQ(angles[i], freely[i]);
    EXPECT_NEAR(angles[beyond] - kStop, 0.0601, 1e-4);
    EXPECT_LT(angles[beyond + 1], angles[beyond]) << "the step that starts beyond the stop takes it back";
    EXPECT_NEAR(angles.back(), kStop, 1e-3);
}

}  // namespace
}  // namespace rigor::plain
