// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Top: a heavy top of 80 rad/s on a ball joint, as a model of its own. With Euler's step it gains half of its energy in half
// a second; RK4 keeps its energy.
#include "adapters/conformance/plain_programs/mujoco/model.hpp"

namespace rigor::plain {
namespace {

constexpr double kStep = 1.0 / 240;

Trajectory top(const char* integrator) {
    // Tilted by 25 degrees about z; 0.1 m from the tip to the centre of mass.
    MujocoModel demo(
        std::string(
            "<mujoco><option timestep=\"0.0041666666666666667\" gravity=\"0 -9.81 0\" integrator=\"") +
        integrator + R"("/><worldbody>
        <body pos="0.04226182617406995 0.090630778703665 0" quat="0.97629600711993336 0 0 -0.21643961393810288">
          <joint type="ball" pos="0 -0.1 0"/>
          <inertial pos="0 0 0" mass="1" diaginertia="0.003 0.004 0.003"/></body></worldbody></mujoco>)");
    // The spin in the axes of the body, as MuJoCo's ball joints have it.
    const double cosine = 0.90630778703664996, sine = 0.42261826174069944;
    const double x = 32.46027947498183, y = 73.1337566119638;
    demo.data->qvel[0] = cosine * x - sine * y;
    demo.data->qvel[1] = sine * x + cosine * y;
    return demo.run(120);
}
/// Kinetic and potential energy [J].
double energy(const BodyState& s) {
    const Vec3 w = rotateInverse(s.orientation, s.angularVelocity);
    return 0.5 * dot(s.velocity, s.velocity) + 0.5 * (0.003 * (w.x * w.x + w.z * w.z) + 0.004 * w.y * w.y) +
           9.81 * s.position.y;
}

TEST(PlainMujoco, Top) {
    const Scenario scene = load("scenarios/library/3d/heavy_top_steady.json");
    const Trajectory rk4 = top("RK4"), euler = top("Euler");
    EXPECT_NEAR(energy(rk4.back()[0]) / energy(rk4.front()[0]), 1.0, 1e-3);
    EXPECT_GT(energy(euler.back()[0]) / energy(euler.front()[0]), 1.3);
    EXPECT_GT(travel(rk4, 0), 0.05);
    EXPECT_TRUE(same(rk4, adapterRun("mujoco:preset=default,integrator=rk4", scene, kStep, 120),
                     {1e-9, 1e-9, 1e-8, 1e-7}));
    // The first steps, before its motion makes anything of rounding.
    const Trajectory found = adapterRun("mujoco:preset=default", scene, kStep, 10);
    EXPECT_TRUE(same(Trajectory(euler.begin(), euler.begin() + 11), found, {1e-9, 1e-9, 1e-8, 1e-7}));
}

}  // namespace
}  // namespace rigor::plain
