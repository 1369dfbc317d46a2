// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Heavy chain: eight light links of a chain on ball joints that carry a weight of a hundred of them (heavy_end_chain). No
// contacts, no constraints: joints are coordinates, and solvers have nothing to do. Hanging at rest, the chain's fastest
// vibration has w = 229.94 rad/s (M th'' + K th = 0, linearised), so that an Euler step that is explicit in the positions
// is stable below 2 / w = 1/115.0 s: it is at 1/116 s, and grows at 1/114 s. With 1/60 s the chain's numbers become
// infinite, with a weight of 1 kg (2 / w = 1/42.8 s) or a step of 1/240 s they do not.
#include "adapters/conformance/plain_programs/mujoco/model.hpp"

namespace rigor::plain {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// The chain of the file, turned about z by `turn` [rad] from hanging straight.
MujocoModel heavyChain(double step, double endMass, double turn) {
    char text[400];
    std::snprintf(text, sizeof text, "<mujoco><option timestep=\"%.17g\" gravity=\"0 -9.81 0\"/><worldbody>",
                  step);
    std::string mjcf = text, ends;
    for (int i = 0; i < 9; ++i) {
        const double length = i == 0 ? 0.1 : 0.2, mass = i == 8 ? endMass : 0.1;
        const double across = i == 8 ? 0.4 * mass * 0.01 : mass * (0.01 + 0.0004) / 3;
        const double along = i == 8 ? across : mass * 0.0008 / 3;
        const double x = std::sin(turn), y = -std::cos(turn);
        std::snprintf(text, sizeof text,
                      "<body pos=\"%.17g %.17g 0\"><joint type=\"ball\" pos=\"%.17g %.17g 0\"/>"
                      "<inertial pos=\"0 0 0\" quat=\"%.17g 0 0 %.17g\" mass=\"%.17g\" "
                      "diaginertia=\"%.17g %.17g %.17g\"/>",
                      length * x, length * y, -0.1 * x, -0.1 * y, std::cos(0.5 * turn), std::sin(0.5 * turn),
                      mass, across, along, across);
        mjcf += text;
        ends += "</body>";
    }
    return MujocoModel(mjcf + ends + "</worldbody></mujoco>");
}

/// Whether the numbers stay within MuJoCo's bounds (below 1e10) for `seconds`.
bool lasts(MujocoModel demo, double step, double seconds) {
    // A thousandth of a radian per second, against each other, so that vibrations begin.
    demo.data->qvel[2] = 1e-3;
    demo.data->qvel[11] = -1e-3;
    for (int i = 0; i < seconds / step; ++i) {
        mj_step(demo.model, demo.data);
        if (demo.data->warning[mjWARN_BADQACC].number > 0 || demo.data->warning[mjWARN_BADQVEL].number > 0)
            return false;
    }
    return true;
}

TEST(PlainMujoco, HeavyChain) {
    const double turn = 36.86989764584402 * kDegree;
    const Trajectory plain = heavyChain(1.0 / 240, 10, turn).run(120);
    EXPECT_GT(travel(plain, 8), 0.1);
    const Scenario scene = load("scenarios/library/3d/heavy_end_chain.json");
    EXPECT_TRUE(
        same(plain, adapterRun("mujoco:preset=default", scene, 1.0 / 240, 120), {1e-8, 1e-8, 1e-7, 1e-6}));

    EXPECT_FALSE(lasts(heavyChain(1.0 / 60, 10, turn), 1.0 / 60, 2));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 240, 10, turn), 1.0 / 240, 2));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 60, 1, turn), 1.0 / 60, 2));
}

TEST(PlainMujoco, HangingChainAtTheLimitOfItsStep) {
    EXPECT_FALSE(lasts(heavyChain(1.0 / 110, 10, 0), 1.0 / 110, 10));
    EXPECT_TRUE(lasts(heavyChain(1.0 / 116, 10, 0), 1.0 / 116, 10));
}

}  // namespace
}  // namespace rigor::plain
