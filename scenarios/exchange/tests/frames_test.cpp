// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames of URDF and SDF: models whose poses are written by hand here, in quarter turns, and pendulums that move
// as the scenario written by hand does.
#include <gmock/gmock.h>

#include <cmath>

#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace {

using ::testing::HasSubstr;
using namespace scenario;

const Body& bodyOf(const Scenario& s, const char* name) {
    static const Body none;
    const int index = findBody(s, name);
    EXPECT_NE(index, kNone) << name;
    return index == kNone ? none : s.bodies[static_cast<std::size_t>(index)];
}
/// The world's direction of a joint's axis, and the place of its anchor.
void expectJoint(const Scenario& s, const Joint& j, const Vec3& anchor, const Vec3& axis) {
    const Pose pose = s.bodies[static_cast<std::size_t>(j.bodyB)].pose;
    expectNear(pose * j.anchorB, anchor, kTolerance, j.name + ", anchor");
    expectNear(rotate(pose.orientation, j.axisB), axis, kTolerance, j.name + ", axis");
}

/// Nested models, a placement frame, a frame attached to a link, poses relative to frames, an axis of another frame.
constexpr const char* kNested = R"(<?xml version="1.0"?>
<sdf version="1.9"><world name="w"><gravity>0 0 -9.81</gravity>
  <frame name="table"><pose>1 2 3 0 0 1.5707963267948966</pose></frame>
  <model name="arm" placement_frame="base">
    <pose relative_to="table">0.5 0 0 0 0 0</pose>
    <link name="base"><pose>0 0 1 0 0 0</pose>
      <inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
    <frame name="elbow" attached_to="base"><pose>0.3 0 0 0 1.5707963267948966 0</pose></frame>
    <model name="hand"><pose relative_to="elbow">0 0 0.2 0 0 0</pose>
      <link name="palm"><pose>0.1 0 0 0 0 0</pose>
        <inertial><pose>0 0.05 0 0 0 1.5707963267948966</pose><mass>0.5</mass>
          <inertia><ixx>0.02</ixx><iyy>0.01</iyy><izz>0.025</izz></inertia></inertial>
        <collision name="c"><geometry><cylinder><radius>0.1</radius><length>0.4</length></cylinder></geometry></collision>
      </link></model>
    <joint name="wrist" type="revolute"><pose relative_to="elbow">0 0 0 0 0 0</pose>
      <parent>base</parent><child>hand::palm</child>
      <axis><xyz expressed_in="elbow">0 1 0</xyz><limit><lower>-1</lower><upper>0.5</upper></limit></axis></joint>
  </model></world></sdf>)";

TEST(Sdf, NestedModelsAndFrames) {
    const Scenario s = imported("sdf", writeText(freshFolder("nested") / "nested.sdf", kNested));
    ASSERT_EQ(s.bodies.size(), 2u);
    ASSERT_EQ(s.joints.size(), 1u);
    const Body &base = bodyOf(s, "arm.base"), &palm = bodyOf(s, "arm.hand.palm");
    // The placement frame is put half a metre along the table's x, which is the world's y.
    expectNear(base.pose.position, {1, 2.5, 3}, kTolerance, "base");
    expectNear(rotate(base.pose.orientation, {1, 0, 0}), {0, 1, 0}, kTolerance, "x of the base");
    // The elbow's z is the base's x, its x is down.
    expectNear(palm.pose.position, {1, 3, 2.9}, kTolerance, "palm");
    expectNear(rotate(palm.pose.orientation, {0, 0, 1}), {0, 1, 0}, kTolerance, "z of the palm");
    expectNear(palm.pose * palm.massProperties.centerOfMass, {0.95, 3, 2.9}, kTolerance, "centre");
    // Principal axes are turned about the palm's z: x of the palm, which is down, has iyy.
    expectNear(inertiaInWorld(palm), Mat3::diagonal(0.02, 0.025, 0.01), kTolerance, "inertia");
    expectNear(rotate((palm.pose * palm.shapes[0].pose).orientation, {0, 1, 0}), {0, 1, 0}, kTolerance,
               "axis of the cylinder");
    expectJoint(s, s.joints[0], {1, 2.8, 3}, {-1, 0, 0});
    EXPECT_DOUBLE_EQ(s.joints[0].axes[0].lower, -1.0);
    EXPECT_DOUBLE_EQ(s.joints[0].axes[0].upper, 0.5);
}

TEST(Sdf, APlacementFrameOfAModelWithoutAWorld) {
    const Scenario s = imported("sdf", writeText(freshFolder("placed") / "placed.sdf", R"(<sdf version="1.9">
      <model name="m" placement_frame="b"><pose>0 0 5 0 0 0</pose>
      <link name="a"/><link name="b"><pose>0 0 1 0 0 0</pose></link></model></sdf>)"));
    expectNear(bodyOf(s, "m.b").pose.position, {0, 0, 5}, kTolerance, "placed link");
    expectNear(bodyOf(s, "m.a").pose.position, {0, 0, 4}, kTolerance, "other link");
}

constexpr const char* kGripper = R"(<?xml version="1.0"?>
<robot name="gripper">
  <link name="world"/>
  <joint name="mount" type="fixed"><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><parent link="world"/><child link="base"/></joint>
  <link name="base"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><origin xyz="0.2 0 0" rpy="0 1.5707963267948966 0"/>
    <parent link="base"/><child link="upper"/><axis xyz="0 2 0"/><limit lower="-1" upper="2" effort="5" velocity="3"/>
    <dynamics damping="0.1" friction="0.2"/></joint>
  <link name="upper"><inertial><origin xyz="0 0 0.3" rpy="0 0 1.5707963267948966"/><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.15"/></inertial></link>
  <joint name="weld" type="fixed"><origin xyz="0 0 0.6"/><parent link="upper"/><child link="tool"/></joint>
  <link name="tool"><inertial><mass value="0.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="grip" type="prismatic"><origin xyz="0 0.1 0.6"/><parent link="upper"/><child link="finger"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.05" effort="5" velocity="1"/>
    <mimic joint="shoulder" multiplier="0.5"/></joint>
  <link name="finger"><inertial><mass value="0.1"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
</robot>)";

TEST(Urdf, FixedJointsAndAMimic) {
    const auto file = writeText(freshFolder("gripper") / "gripper.urdf", kGripper);
    EXPECT_THAT(refusal("urdf", file), HasSubstr("gripper.urdf:16: <mimic>: a joint that follows another"));
    const Scenario s = imported("urdf", file, "--without mimic");
    ASSERT_EQ(s.bodies.size(), 4u);
    ASSERT_EQ(s.joints.size(), 3u);
    EXPECT_EQ(bodyOf(s, "base").type, BodyType::Static);
    const Body& upper = bodyOf(s, "upper");
    expectNear(upper.pose.position, {0, 0.2, 1}, kTolerance, "upper");
    expectNear(rotate(upper.pose.orientation, {0, 0, 1}), {0, 1, 0}, kTolerance, "z of the upper link");
    expectNear(upper.pose * upper.massProperties.centerOfMass, {0, 0.5, 1}, kTolerance, "centre");
    // The frame of the inertia is turned about the link's z: its x, the world's -z, has iyy.
    expectNear(inertiaInWorld(upper), Mat3::diagonal(0.1, 0.15, 0.2), kTolerance, "inertia");
    expectNear(bodyOf(s, "tool").pose.position, {0, 0.8, 1}, kTolerance, "tool");
    expectNear(bodyOf(s, "finger").pose.position, {-0.1, 0.8, 1}, kTolerance, "finger");
    EXPECT_EQ(s.joints[0].type, JointType::Hinge);
    EXPECT_EQ(s.joints[0].bodyA, kNone);
    expectJoint(s, s.joints[0], {0, 0.2, 1}, {-1, 0, 0});
    EXPECT_DOUBLE_EQ(s.joints[0].axes[0].damping, 0.1);
    EXPECT_DOUBLE_EQ(s.joints[0].axes[0].motorMaxForce, 0.2);
    EXPECT_EQ(s.joints[1].type, JointType::Slider);
    EXPECT_EQ(s.joints[2].type, JointType::Fixed);
    EXPECT_DOUBLE_EQ(s.joints[1].axes[0].upper, 0.05);
}

/// The pendulum of all formats: at 60 degrees to the vertical, about the world's y.
constexpr const char* kByHand = R"({"rigor": 1, "name": "hand", "title": "a pendulum", "dimension": 3,
  "gravity": [0, 0, -9.81], "duration": 10, "dt": [0.001], "bodies": [
  {"name": "bob", "axis_angle_deg": {"axis": [0, 1, 0], "angle_deg": 60}, "mass": 1.5,
   "center_of_mass": [0, 0, -0.5], "inertia": [0.02, 0.03, 0.01]}], "joints": [{"name": "pin", "type": "hinge",
   "a": "world", "b": "bob", "anchor": [0, 0, 0], "axis": [0, 1, 0], "spring": {"stiffness": 0, "damping": 0.05}}]})";
constexpr const char* kUrdfPendulum = R"(<robot name="p"><link name="world"/>
  <joint name="pin" type="continuous"><origin rpy="0 1.0471975511965976 0"/><parent link="world"/><child link="bob"/>
    <axis xyz="0 1 0"/><dynamics damping="0.05"/></joint>
  <link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="1.5"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.01"/></inertial></link></robot>)";
constexpr const char* kSdfPendulum = R"(<sdf version="1.7"><world name="w"><gravity>0 0 -9.81</gravity>
  <physics name="p" type="ode"><max_step_size>0.001</max_step_size></physics>
  <model name="p"><link name="bob"><pose>0 0 0 0 1.0471975511965976 0</pose><inertial><pose>0 0 -0.5 0 0 0</pose>
    <mass>1.5</mass><inertia><ixx>0.02</ixx><iyy>0.03</iyy><izz>0.01</izz></inertia></inertial></link>
    <joint name="pin" type="revolute"><parent>world</parent><child>bob</child>
      <axis><xyz>0 1 0</xyz><dynamics><damping>0.05</damping></dynamics></axis></joint></model></world></sdf>)";

TEST(Frames, PendulumsMoveAsTheOneWrittenByHand) {
    const auto folder = freshFolder("pendulums");
    const auto hand = lastState(writeText(folder / "hand.json", kByHand));
    ASSERT_EQ(hand.size(), 14u);
    EXPECT_GT(std::abs(hand[11]) + std::abs(hand[12]) + std::abs(hand[13]), 1e-3) << "it does not move";
    const std::pair<const char*, const char*> models[] = {{"urdf", kUrdfPendulum}, {"sdf", kSdfPendulum}};
    for (const auto& [format, text] : models) {
        SCOPED_TRACE(format);
        const auto file = writeText(folder / (std::string("p.") + format), text);
        const auto out = folder / (std::string(format) + ".json");
        const Outcome outcome = rigor(std::string("import ") + format + " " + file.string() +
                                      " --dt 0.001 --duration 10 --out " + out.string());
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto read = lastState(out);
        ASSERT_EQ(read.size(), hand.size());
        for (std::size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(read[i], hand[i], kTolerance) << i;
    }
}

}  // namespace
}  // namespace rigor::models::testing
