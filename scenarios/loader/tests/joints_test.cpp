// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Modes of the coordinates of joints: read as written, refused where they make no sense.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

std::string file(int dimension, const std::string& joint) {
    const std::string zero = dimension == 3 ? "[0, 0, 0]" : "[0, 0]",
                      one = dimension == 3 ? "[1, 0, 0]" : "[1, 0]";
    return R"({ "rigor": 1, "name": "joints", "title": "Joints", "dimension": )" + std::to_string(dimension) +
           R"(, "gravity": )" + zero +
           R"(, "duration": 1, "dt": [0.01], "materials": { "m": { "friction": 0, "restitution": 0 } },
  "bodies": [ { "name": "b", "mass": 1, "position": )" +
           one + R"(, "collides": false, "shapes": [ { "box": { "half_extents": )" +
           (dimension == 3 ? "[0.1, 0.1, 0.1]" : "[0.1, 0.1]") +
           R"( } } ] } ],
  "joints": [ { "name": "j", "a": "world", "b": "b", )" +
           joint + " } ] }";
}
Joint load(int dimension, const std::string& joint) {
    const LoadedScenario loaded = loadScenarioText(file(dimension, joint), "joints.json");
    return loaded.scenario.joints.at(0);
}
std::string refusal(int dimension, const std::string& joint) {
    try {
        load(dimension, joint);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "none";
}

TEST(JointControls, AreReadByCoordinate) {
    const Joint hinge =
        load(3, R"("type": "hinge", "anchor": [1, 0, 0], "axis": [0, 0, 2], "limits": [-0.5, null],
        "motor": { "speed": 3, "max_torque": 7 }, "spring": { "stiffness": 4, "damping": 0.5, "target": 0.2 },
        "break_force": 100, "break_torque": 20)");
    EXPECT_EQ(hinge.axes[0].mode, AxisMode::Limited);
    EXPECT_EQ(hinge.axes[0].lower, -0.5);
    EXPECT_GT(hinge.axes[0].upper, 1e299);
    EXPECT_EQ(hinge.axes[0].motorSpeed, 3);
    EXPECT_EQ(hinge.axes[0].motorMaxForce, 7);
    EXPECT_EQ(hinge.axes[0].stiffness, 4);
    EXPECT_EQ(hinge.axes[0].damping, 0.5);
    EXPECT_EQ(hinge.axes[0].target, 0.2);
    EXPECT_EQ(hinge.breakForce, 100);
    EXPECT_EQ(hinge.breakTorque, 20);
    EXPECT_THAT(hinge.features(), testing::ElementsAre("limit", "motor", "spring", "break"));

    const Joint rope =
        load(2, R"("type": "distance", "anchor_a": [0, 0], "anchor_b": [0, 0], "limits": [null, 2])");
    EXPECT_EQ(rope.axes[0].upper, 2);
    const Joint spring = load(2, R"("type": "distance", "anchor_a": [0, 0], "anchor_b": [0, 0], "length": 0.6,
        "spring": { "frequency": 2, "damping_ratio": 0.1 })");
    EXPECT_EQ(spring.axes[0].mode, AxisMode::Free);
    EXPECT_EQ(spring.axes[0].target, 0.6) << "a spring rests at the length";

    const Joint six =
        load(3, R"("type": "six_dof", "anchor": [1, 0, 0], "axis": [1, 0, 0], "normal": [0, 1, 0],
        "axes": { "x": "free", "twist": { "limits": [-1, 1] }, "swing_z": { "motor": { "speed": 1, "max_torque": 2 } } })");
    EXPECT_EQ(six.axes[0].mode, AxisMode::Free);
    EXPECT_EQ(six.axes[1].mode, AxisMode::Usual);
    EXPECT_EQ(six.axes[3].upper, 1);
    EXPECT_EQ(six.axes[5].mode, AxisMode::Free);
    EXPECT_EQ(six.axes[5].motorMaxForce, 2);
    EXPECT_EQ(six.normalA, (Vec3{0, 1, 0}));

    const Joint wheel =
        load(3, R"("type": "wheel", "anchor": [1, 0, 0], "axis": [0, 1, 0], "spin_axis": [0, 0, 1],
        "axes": { "travel": { "spring": { "frequency": 2 } }, "angle": { "motor": { "speed": 1, "max_torque": 2 } } })");
    EXPECT_EQ(wheel.axes[0].frequency, 2);
    EXPECT_EQ(wheel.axes[1].motorSpeed, 1);
    const Joint cone = load(3, R"("type": "ball", "anchor": [1, 0, 0], "axis": [0, 1, 0],
        "axes": { "swing": { "limits": [null, 0.6] } })");
    EXPECT_EQ(cone.axes[0].upper, 0.6);
    EXPECT_EQ(load(3, R"("type": "ball", "anchor": [1, 0, 0])").features().size(), 0u);
}

TEST(JointControls, NonsenseIsRefusedWithItsPlace) {
    using testing::HasSubstr;
    const std::string hinge = R"("type": "hinge", "anchor": [1, 0], )";
    EXPECT_THAT(refusal(2, hinge + R"("limits": [1, 0])"), HasSubstr("/joints/0/limits"));
    EXPECT_THAT(refusal(2, hinge + R"("limits": [1])"), HasSubstr("joint.limits"));
    EXPECT_THAT(refusal(2, hinge + R"("motor": { "speed": 1, "max_force": 2 })"), HasSubstr("max_force"));
    EXPECT_THAT(refusal(2, hinge + R"("motor": { "speed": 1, "max_torque": 0 })"), HasSubstr("max_torque"));
    EXPECT_THAT(refusal(2, hinge + R"("spring": { "frequency": 1, "stiffness": 2 })"),
                HasSubstr("joint.spring"));
    EXPECT_THAT(refusal(2, hinge + R"("spring": { "frequency": 1, "damping": 2 })"),
                HasSubstr("joint.spring"));
    EXPECT_THAT(refusal(2, hinge + R"("spring": { "stiffness": 0 })"), HasSubstr("above 0"));
    EXPECT_EQ(refusal(2, hinge + R"("spring": { "stiffness": 0, "damping": 2 })"), "none") << "a damper";
    EXPECT_THAT(refusal(2, hinge + R"("axes": { "travel": { "limits": [0, 1] } })"),
                HasSubstr("one of angle"));
    EXPECT_THAT(refusal(2, hinge + R"("break_force": 0)"), HasSubstr("/joints/0/break_force"));
    EXPECT_THAT(refusal(2, R"("type": "fixed", "anchor": [1, 0], "limits": [0, 1])"),
                HasSubstr("joint.axes"));
    EXPECT_THAT(refusal(2, R"("type": "cone_twist", "anchor": [1, 0], "axis": [1, 0])"),
                HasSubstr("joint.type"));
    EXPECT_THAT(refusal(3, R"("type": "wheel", "anchor": [1, 0, 0], "axis": [0, 1, 0])"),
                HasSubstr("spin_axis"));
    EXPECT_THAT(
        refusal(3, R"("type": "ball", "anchor": [1, 0, 0], "axes": { "swing": { "limits": [null, 0.6] } })"),
        HasSubstr("axis"));
    EXPECT_THAT(refusal(3, R"("type": "ball", "anchor": [1, 0, 0], "axis": [0, 1, 0],
        "axes": { "swing": { "limits": [null, 4] } })"),
                HasSubstr("half angle"));
}

}  // namespace
}  // namespace rigor::scenario
