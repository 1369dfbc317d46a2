// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Slide: a block slides over a floor until it rests, MuJoCo as it comes. MuJoCo's contacts are convex: a surface that
// slides at v over another with the coefficient mu leaves it at mu v, which the second test shows without the adapter.
#include "adapters/conformance/plain_programs/mujoco/model.hpp"

namespace rigor::plain {
namespace {

constexpr const char* kBlock = R"(
  <worldbody>
    <body pos="0 -0.5 0"><geom type="box" size="20 0.5 20" friction="0.5 0 0"/></body>
    <body pos="0 0.05 0"><freejoint/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.0433333333333333333 0.0833333333333333333 0.0433333333333333333"/>
      <geom type="box" size="0.25 0.05 0.25" friction="0.5 0 0"/></body>
  </worldbody></mujoco>)";

TEST(PlainMujoco, Slide) {
    MujocoModel demo(
        std::string("<mujoco><option timestep=\"0.0041666666666666667\" gravity=\"0 -9.81 0\"/>") + kBlock);
    demo.data->qvel[0] = 4;
    const Trajectory plain = demo.run(360);
    const Scenario scene = load("scenarios/library/3d/slide_and_stop.json");
    EXPECT_GT(travel(plain, 1), 1.5);
    EXPECT_TRUE(
        same(plain, adapterRun("mujoco:preset=default", scene, 1.0 / 240, 360), {1e-9, 1e-9, 1e-7, 1e-7}));
}

TEST(PlainMujoco, WhatSlidesLeavesItsFloor) {
    for (const double mu : {0.25, 0.5}) {
        MujocoModel demo(
            "<mujoco><option timestep=\"0.001\" gravity=\"0 0 0\" cone=\"elliptic\" impratio=\"100\"/>"
            "<default><geom solref=\"0.002 1\" solimp=\"0.9999 0.9999 0.001\" friction=\"" +
            std::to_string(mu) + " 0 0\"/></default>" + R"(<worldbody>
                           <geom type="plane" size="0 0 1"/>
                           <body pos="0 0 0.0999"><freejoint/><geom type="sphere" size="0.1" mass="1"/>
                             <inertial pos="0 0 0" mass="1" diaginertia="1e6 1e6 1e6"/></body>
                         </worldbody></mujoco>)");
        for (int g = 0; g < 2; ++g) demo.model->geom_friction[3 * g] = mu;
        demo.data->qvel[0] = 3;
        demo.data->qvel[2] = -0.1;
        mj_step(demo.model, demo.data);
        EXPECT_NEAR(demo.data->qvel[2] / (mu * demo.data->qvel[0]), 1.0, 0.05) << mu;
    }
}

}  // namespace
}  // namespace rigor::plain
