// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stack: ten boxes on each other, MuJoCo as it comes.
#include "adapters/conformance/plain_programs/mujoco/model.hpp"

namespace rigor::plain {
namespace {

TEST(PlainMujoco, Stack) {
    std::string boxes;
    for (int i = 0; i < 10; ++i)
        boxes += "<body pos=\"0 " + std::to_string(0.49999 + i * 0.99999) +
                 " 0\"><freejoint/>"
                 "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"0.16666666666666666 0.16666666666666666 "
                 "0.16666666666666666\"/><geom type=\"box\" size=\"0.5 0.5 0.5\" mass=\"1\" friction=\"0.5 0 "
                 "0\"/></body>";
    MujocoModel demo(R"(<mujoco><option timestep="0.016666666666666666" gravity="0 -9.81 0"/>
      <worldbody><body pos="0 -0.5 0"><geom type="box" size="20 0.5 20" friction="0.5 0 0"/></body>)" +
                     boxes + "</worldbody></mujoco>");
    const Trajectory plain = demo.run(60);
    const Scenario scene = load("scenarios/library/3d/box_stack.json");
    EXPECT_GT(travel(plain, 10), 0.005);
    EXPECT_TRUE(
        same(plain, adapterRun("mujoco:preset=default", scene, 1.0 / 60, 60), {1e-4, 1e-4, 1e-2, 1e-2}));
}

}  // namespace
}  // namespace rigor::plain
