// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pendulum: a rod on a hinge, let go from the horizontal: one joint of a tree, as MuJoCo's models have it.
#include "adapters/conformance/plain_programs/mujoco/model.hpp"

namespace rigor::plain {
namespace {

TEST(PlainMujoco, Pendulum) {
    for (const char* integrator : {"Euler", "RK4", "implicit"}) {
        MujocoModel demo(
            std::string(
                "<mujoco><option timestep=\"0.016666666666666666\" gravity=\"0 -9.81 0\" integrator=\"") +
            integrator + R"("/><worldbody><body pos="0.5 0 0">
                           <joint type="hinge" axis="0 0 1" pos="-0.5 0 0"/>
                           <inertial pos="0 0 0" mass="1" diaginertia="0.0006 0.0836 0.0836"/>
                         </body></worldbody></mujoco>)");
        const Trajectory plain = demo.run(120);
        const Scenario scene = load("scenarios/library/3d/physical_pendulum.json",
                                    {"bodies.rod.inertia=[0.0006,0.0836,0.0836]"});
        EXPECT_GT(travel(plain, 0), 0.5);
        const std::string key = integrator == std::string("Euler") ? "euler"
                                : integrator == std::string("RK4") ? "rk4"
                                                                   : "implicit";
        EXPECT_TRUE(same(plain, adapterRun("mujoco:preset=default,integrator=" + key, scene, 1.0 / 60, 120),
                         {1e-12, 1e-12, 1e-11, 1e-11}))
            << integrator;
    }
}

}  // namespace
}  // namespace rigor::plain
