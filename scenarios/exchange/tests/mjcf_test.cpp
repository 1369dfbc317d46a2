// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MJCF is read as libmujoco understands it: masses, inertia, poses and joints of every body are compared with the
// library's own model of the unchanged file.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <set>

#include "scenarios/exchange/tests/library_says.hpp"
#include "scenarios/exchange/tests/tool.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::models::testing {
namespace {

using ::testing::HasSubstr;
using namespace scenario;

void compareWithLibrary(const std::filesystem::path& file, const Scenario& s) {
    expectAsLibrarySays(s, libmujocoSays(file));
}

TEST(Mjcf, ModelsAreWhatTheLibrarySays) {
    const auto folder = modelsFolder();
    if (folder.empty()) GTEST_SKIP() << "RIGOR_DATA is not set";
    const std::pair<const char*, const char*> models[] = {{"mujoco/boxbox_deep.xml", ""},
                                                          {"bullet3/hello_mjcf.xml", ""},
                                                          {"mujoco/doc_pendulum.xml", ""},
                                                          {"mujoco/example.xml", ""},
                                                          {"mujoco/catenary.xml", "--without actuators"},
                                                          {"drake/acrobot_mjcf.xml", "--without actuators"},
                                                          {"mujoco/slider_crank.xml", "--without actuators"}};
    for (const auto& [name, options] : models) {
        SCOPED_TRACE(name);
        compareWithLibrary(folder / name, imported("mjcf", folder / name, options));
    }
}

constexpr const char* kMany = R"(<mujoco model="many">
  <compiler angle="radian" autolimits="true"/>
  <option timestep="0.001" gravity="0 0 -9.81"/>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" pos="0 0 -3" friction="0.8 0.01 0.002"/>
    <body name="base" pos="0.1 0.2 0.3" quat="0.9 0.1 0.2 0.3">
      <inertial pos="0.01 0.02 0.03" mass="2" fullinertia="0.02 0.03 0.04 0.001 0.002 -0.003"/>
      <joint name="hip" type="hinge" axis="0 1 1" pos="0 0.1 0" range="-1 2" ref="0.25" stiffness="3" damping="0.5" springref="0.5"/>
      <geom type="capsule" size="0.1 0.2" friction="0.4"/>
      <body name="arm" pos="0 0 -0.5" euler="0.3 0.2 0.1">
        <joint name="rail" type="slide" axis="1 0.5 0" range="-0.3 0.4" frictionloss="0.7"/>
        <geom type="box" size="0.1 0.05 0.2" mass="1.5" condim="6" friction="0.3 0.02 0.004"/>
        <body name="tip" pos="0 0 -0.4"><geom type="ellipsoid" size="0.1 0.07 0.05" mass="0.3"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

TEST(Mjcf, JointsSpringsAndFrictionAreMapped) {
    const auto file = writeText(freshFolder("many") / "many.xml", kMany);
    const Scenario s = imported("mjcf", file);
    compareWithLibrary(file, s);
    ASSERT_EQ(s.joints.size(), 3u);
    const JointAxis& hip = s.joints[0].axes[0];
    EXPECT_DOUBLE_EQ(hip.lower, -1.25);
    EXPECT_DOUBLE_EQ(hip.upper, 1.75);
    EXPECT_DOUBLE_EQ(hip.target, 0.25);
    EXPECT_DOUBLE_EQ(hip.stiffness, 3.0);
    EXPECT_DOUBLE_EQ(hip.damping, 0.5);
    EXPECT_DOUBLE_EQ(s.joints[1].axes[0].motorMaxForce, 0.7);
    EXPECT_EQ(s.joints[2].type, JointType::Fixed);
    const auto law = [&](const char* a, const char* b) {
        return pairCoefficients(s, s.bodies[static_cast<std::size_t>(findBody(s, a))].shapes[0].material,
                                s.bodies[static_cast<std::size_t>(findBody(s, b))].shapes[0].material);
    };
    // The larger value of each; the contact of the larger dimension.
    EXPECT_DOUBLE_EQ(law("ground", "base").friction, 0.8);
    EXPECT_DOUBLE_EQ(law("ground", "base").rollingFriction, 0.0);
    EXPECT_DOUBLE_EQ(law("ground", "arm").friction, 0.8);
    EXPECT_DOUBLE_EQ(law("ground", "arm").torsionalFriction, 0.02);
    EXPECT_DOUBLE_EQ(law("ground", "arm").rollingFriction, 0.004);
    // MuJoCo collides no body with the one above it, nor what is fixed to it.
    EXPECT_FALSE(mayCollide(s, findBody(s, "base"), findBody(s, "tip")));
    EXPECT_TRUE(mayCollide(s, findBody(s, "ground"), findBody(s, "tip")));
}

/// Defaults of classes within classes, a class for the children of a body, and one that an element names itself.
constexpr const char* kDefaults = R"(<mujoco model="classes">
  <compiler angle="degree" eulerseq="zyx"/>
  <default>
    <geom density="500" friction="0.7"/>
    <joint damping="0.1"/>
    <default class="limb">
      <geom type="capsule" size="0.05 0.2"/>
      <joint axis="0 1 0" range="-30 60" limited="true"/>
      <default class="thin"><geom size="0.02 0.1" density="2000"/><joint axis="1 0 0" stiffness="2"/></default>
    </default>
    <default class="block"><geom type="box" size="0.1 0.2 0.3" friction="0.2"/></default>
  </default>
  <worldbody>
    <body name="trunk" pos="0 0 2" euler="30 20 10" childclass="block">
      <freejoint/>
      <geom name="chest"/>
      <geom name="head" class="main" size="0.1" pos="0 0 0.4"/>
      <body name="upper" pos="0.1 0 -0.3" euler="0 90 0" childclass="limb">
        <joint name="shoulder"/>
        <geom name="upper"/>
        <body name="lower" pos="0 0 -0.4">
          <joint name="elbow" class="thin" range="-10 120"/>
          <geom name="lower" class="thin"/>
          <geom name="hand" class="block" size="0.03 0.03 0.03" pos="0 0 -0.1"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

TEST(Mjcf, ClassesOfDefaultsWithinClasses) {
    const auto file = writeText(freshFolder("classes") / "classes.xml", kDefaults);
    const Scenario s = imported("mjcf", file);
    compareWithLibrary(file, s);
    ASSERT_EQ(s.bodies.size(), 3u);
    ASSERT_EQ(s.joints.size(), 2u);
    const Body &trunk = s.bodies[0], &upper = s.bodies[1], &lower = s.bodies[2];
    constexpr double kPi = 3.14159265358979323846;
    EXPECT_NEAR(trunk.massProperties.mass, 500.0 * (0.048 + 4.0 / 3.0 * kPi * 1e-3), 1e-10);
    const auto capsule = [&](double r, double h) { return kPi * r * r * (2.0 * h + 4.0 / 3.0 * r); };
    EXPECT_NEAR(upper.massProperties.mass, 500.0 * capsule(0.05, 0.2), 1e-12);
    EXPECT_NEAR(lower.massProperties.mass, 2000.0 * capsule(0.02, 0.1) + 500.0 * 2.16e-4, 1e-12);
    const JointAxis &shoulder = s.joints[0].axes[0], &elbow = s.joints[1].axes[0];
    EXPECT_NEAR(shoulder.upper, kPi / 3.0, kTolerance);
    EXPECT_DOUBLE_EQ(shoulder.damping, 0.1);
    EXPECT_DOUBLE_EQ(shoulder.stiffness, 0.0);
    EXPECT_NEAR(elbow.upper, 2.0 * kPi / 3.0, kTolerance);
    EXPECT_DOUBLE_EQ(elbow.stiffness, 2.0);
    const auto law = [&](std::size_t a, std::size_t b) {
        return pairCoefficients(s, trunk.shapes[a].material, lower.shapes[b].material).friction;
    };
    EXPECT_DOUBLE_EQ(law(0, 1), 0.2);
    EXPECT_DOUBLE_EQ(law(1, 1), 0.7);
}

TEST(Mjcf, ReplicasAndFramesAreExpanded) {
    const auto file = writeText(freshFolder("replicas") / "r.xml", R"(<mujoco><worldbody>
      <frame pos="1 0 0" euler="0 0 90">
        <replicate count="3" offset="0.5 0 0" euler="0 0 30">
          <body name="b" pos="0 0 1"><freejoint/><geom size="0.1"/></body>
        </replicate>
      </frame></worldbody></mujoco>)");
    const Scenario s = imported("mjcf", file);
    ASSERT_EQ(s.bodies.size(), 3u);
    // The second copy moves by the offset and turns, the third by an offset that has turned by 30 degrees.
    const double c = std::sqrt(3.0) / 2.0;
    const Vec3 expected[] = {{1, 0, 1}, {1, 0.5, 1}, {1 - 0.25, 0.5 + 0.5 * c, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(s.bodies[i].name, "b" + std::to_string(i));
        expectNear(s.bodies[i].pose.position, expected[i], kTolerance, s.bodies[i].name);
    }
}

TEST(Mjcf, AKeyframeIsTheStart) {
    const auto file = writeText(freshFolder("key") / "k.xml", R"(<mujoco><worldbody>
      <body name="b" pos="0 0 1"><freejoint/><geom type="box" size="0.1 0.2 0.3" pos="0.1 0 0"/></body></worldbody>
      <keyframe><key name="go" qpos="1 2 3 1 0 0 0" qvel="1 0 0 0 0 2"/></keyframe></mujoco>)");
    const Scenario s = imported("mjcf", file, "--keyframe go");
    expectNear(s.bodies[0].pose.position, {1, 2, 3}, kTolerance, "position");
    expectNear(s.bodies[0].velocity, {1, 0.2, 0}, kTolerance, "velocity of the centre");
    expectNear(s.bodies[0].angularVelocity, {0, 0, 2}, kTolerance, "spin");
    EXPECT_THAT(refusal("mjcf", file, "--keyframe other"),
                HasSubstr("k.xml: file: --keyframe: found 'other'"));
}

TEST(Mjcf, FiltersOfContactsBecomeLayers) {
    const auto file = writeText(freshFolder("filters") / "f.xml", R"(<mujoco><worldbody>
      <geom name="f" type="plane" size="0 0 1" friction=".3"/>
      <body name="a" pos="0 0 1"><freejoint/><geom size=".1" contype="2" conaffinity="1"/></body>
      <body name="b" pos="1 0 1"><freejoint/><geom size=".1" contype="1" conaffinity="4"/></body>
      <body name="c" pos="2 0 1"><freejoint/><geom name="gc" size=".1" contype="4" conaffinity="0"/></body>
      <body name="d" pos="3 0 1"><freejoint/><geom size=".1"/></body></worldbody>
      <contact><exclude body1="a" body2="d"/>
      <pair geom1="gc" geom2="f" friction="0.7 0.7 0.01 0.001 0.001" condim="4"/></contact></mujoco>)");
    const Scenario s = imported("mjcf", file);
    const auto index = [&](const char* name) { return findBody(s, name); };
    const std::set<std::string> apart{"ac", "cd", "ad"};
    for (const char* one : {"a", "b", "c", "d"})
        for (const char* two : {"a", "b", "c", "d"}) {
            const std::string pair = std::string(one) + two;
            if (*one >= *two) continue;
            EXPECT_EQ(mayCollide(s, index(one), index(two)), !apart.contains(pair)) << pair;
        }
    // A pair of shapes touches whatever their bits are, by its own law.
    EXPECT_TRUE(mayCollide(s, index("ground"), index("c")));
    const auto law = pairCoefficients(s, s.bodies[0].shapes[0].material,
                                      s.bodies[static_cast<std::size_t>(index("c"))].shapes[0].material);
    EXPECT_DOUBLE_EQ(law.friction, 0.7);
    EXPECT_DOUBLE_EQ(law.torsionalFriction, 0.01);
    EXPECT_DOUBLE_EQ(law.rollingFriction, 0.0);
}

TEST(Mjcf, AHeightFieldIsWhereItWas) {
    const auto folder = freshFolder("field");
    constexpr int kRows = 3, kColumns = 4;
    std::string bytes(sizeof(int) * 2 + sizeof(float) * kRows * kColumns, '\0');
    const int size[2] = {kRows, kColumns};
    float heights[kRows * kColumns];
    for (int i = 0; i < kRows * kColumns; ++i) heights[i] = static_cast<float>(i) / (kRows * kColumns - 1);
    std::memcpy(bytes.data(), size, sizeof size);
    std::memcpy(bytes.data() + sizeof size, heights, sizeof heights);
    writeText(folder / "h.bin", bytes);
    const auto file =
        writeText(folder / "h.xml", R"(<mujoco><asset><hfield name="h" file="h.bin" size="3 2 1 0.5"/></asset>
      <worldbody><geom type="hfield" hfield="h" pos="1 0 0"/><body pos="0 0 3"><freejoint/><geom size=".1"/></body>
      </worldbody></mujoco>)");
    const Scenario s = imported("mjcf", file);
    const Shape& shape = s.bodies[0].shapes[0];
    const auto& field = std::get<HeightField>(shape.geometry);
    EXPECT_DOUBLE_EQ(field.thickness, 0.5);
    const auto vertices = surfaceVertices(field);
    ASSERT_EQ(vertices.size(), 12u);
    for (int r = 0; r < kRows; ++r)
        for (int c = 0; c < kColumns; ++c) {
            const Vec3 expected{1.0 + 6.0 * c / (kColumns - 1) - 3.0, 4.0 * r / (kRows - 1) - 2.0,
                                static_cast<double>(heights[r * kColumns + c])};
            expectNear(shape.pose * vertices[static_cast<std::size_t>(c * kRows + r)], expected, kTolerance,
                       "vertex");
        }
}

TEST(Mjcf, SlidesAndAHingeAreOneJoint) {
    const auto file = writeText(freshFolder("planar") / "p.xml", R"(<mujoco><worldbody><body pos="5 0 1">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1" range="-1 2"/>
      <joint name="turn" type="hinge" axis="0 1 0" range="-20 20"/><geom size=".1"/></body></worldbody></mujoco>)");
    const Scenario s = imported("mjcf", file);
    ASSERT_EQ(s.joints.size(), 1u);
    const Joint& j = s.joints[0];
    EXPECT_EQ(j.type, JointType::SixDof);
    expectNear(j.axisB, {0, 1, 0}, kTolerance, "axis");
    expectNear(j.normalA, {1, 0, 0}, kTolerance, "normal");
    EXPECT_EQ(j.axes[0].mode, AxisMode::Locked);
    EXPECT_EQ(j.axes[1].mode, AxisMode::Free);
    // The third direction is axis x normal = -z: the limits change places.
    EXPECT_DOUBLE_EQ(j.axes[2].lower, -2.0);
    EXPECT_DOUBLE_EQ(j.axes[2].upper, 1.0);
    EXPECT_NEAR(j.axes[3].upper, 20.0 * 3.14159265358979323846 / 180.0, kTolerance);
    EXPECT_EQ(j.axes[4].mode, AxisMode::Locked);
}

/// A pendulum as MJCF and written by hand moves the same for ten seconds.
TEST(Mjcf, APendulumMovesAsTheHandWrittenOne) {
    const auto folder = freshFolder("pendulum");
    const auto file = writeText(folder / "p.xml", R"(<mujoco>
      <option timestep="0.001" gravity="0 0 -9.81"/><worldbody><body name="bob" pos="0 0 0" euler="0 60 0">
      <inertial pos="0 0 -0.5" mass="1.5" diaginertia="0.02 0.03 0.01"/>
      <joint name="pin" type="hinge" axis="0 1 0" damping="0.05"/>
      </body></worldbody></mujoco>)");
    ASSERT_EQ(
        rigor("import mjcf " + file.string() + " --duration 10 --out " + (folder / "read.json").string())
            .code,
        0);
    const std::string text = R"({"rigor": 1, "name": "hand", "title": "a pendulum", "dimension": 3,
      "gravity": [0, 0, -9.81], "duration": 10, "dt": [0.001], "bodies": [
      {"name": "bob", "axis_angle_deg": {"axis": [0, 1, 0], "angle_deg": 60}, "mass": 1.5,
       "center_of_mass": [0, 0, -0.5], "inertia": [0.02, 0.03, 0.01]}], "joints": [{"name": "pin", "type": "hinge",
       "a": "world", "b": "bob", "anchor": [0, 0, 0], "axis": [0, 1, 0], "spring": {"stiffness": 0, "damping": 0.05}}]})";
    writeText(folder / "hand.json", text);
    const auto read = lastState(folder / "read.json"), hand = lastState(folder / "hand.json");
    ASSERT_EQ(read.size(), 14u);
    ASSERT_EQ(hand.size(), read.size());
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(read[i], hand[i], kTolerance) << i;
    EXPECT_GT(std::abs(hand[11]) + std::abs(hand[12]) + std::abs(hand[13]), 1e-3) << "it does not move";
}

}  // namespace
}  // namespace rigor::models::testing
