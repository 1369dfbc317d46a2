// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MJCF that is newer than libmujoco is compiled by MuJoCo 3 of npm: what is imported is what MuJoCo 3 says of the unchanged file,
// and a file that both read becomes the same scenario by either.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios/exchange/common/options.hpp"
#include "scenarios/exchange/tests/library_says.hpp"
#include "scenarios/exchange/tests/tool.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::models::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;
using ::testing::Not;

class NewerMjcf : public ::testing::Test {
  protected:
    void SetUp() override {
        if (mujoco3Package().empty())
            GTEST_SKIP() << "MuJoCo 3 of npm is not installed: ./rigor --with guests";
    }
};

TEST_F(NewerMjcf, ModelsAreWhatMujoco3Says) {
    const auto folder = modelsFolder();
    if (folder.empty()) GTEST_SKIP() << "RIGOR_DATA is not set";
    // Both libraries agree on these; README.md has one on which they do not (car.xml).
    const std::pair<const char*, const char*> models[] = {{"mujoco/boxbox_deep.xml", ""},
                                                          {"mujoco/doc_pendulum.xml", ""},
                                                          {"mujoco/abacus.xml", ""},
                                                          {"mujoco/stonehenge.xml", ""},
                                                          {"bullet3/hello_mjcf.xml", ""},
                                                          {"mujoco/catenary.xml", "--without actuators"},
                                                          {"mujoco/slider_crank.xml", "--without actuators"}};
    for (const auto& [name, options] : models) {
        SCOPED_TRACE(name);
        expectAsLibrarySays(imported("mjcf", folder / name, options), mujoco3Says(folder / name));
    }
}

/// Shapes and meshes that libmujoco 2.2.2 does not know, equalities of sites, a keyframe.
constexpr const char* kNewer = R"(<mujoco model="newer">
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <asset>
    <mesh name="wedge" builtin="wedge" params="3 3 90 90 0" inertia="convex" scale="0.2 0.3 0.4"/>
    <mesh name="shell" inertia="shell" vertex="0 0 0  1 0 0  0 1 0  0 0 1" scale="0.5 0.4 0.3"/>
    <hfield name="hill" nrow="2" ncol="3" size="2 1 0.5 0.1" elevation="0 1 0  0 2 1"/>
  </asset>
  <worldbody>
    <geom name="hill" type="hfield" hfield="hill" pos="0 0 -2"/>
    <site name="nail" pos="0.3 0 1"/>
    <body name="door" pos="0.3 0.2 1" euler="0.1 0.2 0.3">
      <joint name="hinge" axis="0 1 1" range="-1 2" stiffness="3"/>
      <geom type="mesh" mesh="wedge" density="700"/>
      <site name="corner" pos="0.1 0.05 -0.1"/>
      <body name="leaf" pos="0 0.4 0"><joint name="rail" type="slide" axis="1 0 0" range="-0.3 0.4"/>
        <geom type="mesh" mesh="shell" mass="0.8"/></body>
    </body>
    <body name="bob" pos="0.3 0 0.4"><freejoint/><geom size="0.1"/><site name="top" pos="0 0 0.6"/></body>
    <body name="twin" pos="2 0 0.4"><freejoint/><geom size="0.1"/></body>
  </worldbody>
  <contact><exclude body1="bob" body2="twin"/></contact>
  <equality>
    <connect name="string" site1="nail" site2="top"/>
    <connect name="cut" site1="nail" site2="corner" active="false"/>
  </equality>
</mujoco>)";

TEST_F(NewerMjcf, MeshesHeightsAndEqualitiesOfSites) {
    const auto file = writeText(freshFolder("newer") / "newer.xml", kNewer);
    const Scenario s = imported("mjcf", file);
    expectAsLibrarySays(s, mujoco3Says(file));
    ASSERT_EQ(s.bodies.size(), 5u);
    ASSERT_EQ(s.joints.size(), 3u);
    const Joint& string = s.joints[2];
    EXPECT_EQ(string.name, "string");
    EXPECT_EQ(string.type, JointType::Ball);
    expectNear(s.bodies[static_cast<std::size_t>(string.bodyB)].pose * string.anchorB, {0.3, 0, 1},
               kTolerance, "the nail");
    EXPECT_EQ(s.joints[0].axes[0].mode, AxisMode::Limited);
    EXPECT_FALSE(mayCollide(s, findBody(s, "bob"), findBody(s, "twin")));
    EXPECT_TRUE(mayCollide(s, findBody(s, "door"), findBody(s, "twin")));
    // Rows of `elevation` go down the page, and are scaled by its largest value.
    const Shape& hill = s.bodies[0].shapes[0];
    const auto points = surfaceVertices(std::get<HeightField>(hill.geometry));
    ASSERT_EQ(points.size(), 6u);
    double highest = -1e9;
    Vec3 top;
    for (const Vec3& p : points)
        if (const Vec3 q = hill.pose * p; q.z > highest) {
            highest = q.z;
            top = q;
        }
    expectNear(top, {0, -1, -1.5}, kTolerance, "the highest point");
    EXPECT_DOUBLE_EQ(std::get<HeightField>(hill.geometry).thickness, 0.1);
}

/// An unused mesh with a word of MuJoCo 3 makes the file newer than libmujoco, and changes nothing else.
std::string madeNewer(std::string text) {
    const std::string mesh =
        R"(<asset><mesh name="unused" inertia="legacy" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>)";
    return text.insert(text.find('>') + 1, mesh);
}

constexpr const char* kOfBoth = R"(<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <option gravity="0.1 0 -9"><flag filterparent="disable"/></option>
  <default><geom friction="0.7"/><default class="thin"><joint damping="0.2" stiffness="2"/></default></default>
  <worldbody>
    <geom type="plane" size="0 0 1" pos="0 0 -3" friction="0.8 0.01 0.002"/>
    <site name="nail" pos="0 0 2"/>
    <body name="base" pos="0.1 0.2 0.3" quat="0.9 0.1 0.2 0.3">
      <inertial pos="0.01 0.02 0.03" mass="2" quat="0.8 0.1 -0.3 0.2" diaginertia="0.04 0.03 0.02"/>
      <joint name="hip" class="thin" axis="0 1 1" pos="0 0.1 0" range="-1 2" ref="0.25" springref="0.5"/>
      <geom type="capsule" size="0.1 0.2" friction="0.4" condim="4"/>
      <body name="arm" pos="0 0 -0.5" euler="0.3 0.2 0.1">
        <joint name="rail" type="slide" axis="1 0.5 0" range="-0.3 0.4" frictionloss="0.7"/>
        <geom type="box" size="0.1 0.05 0.2" mass="1.5" condim="6" friction="0.3 0.02 0.004" contype="2"/>
      </body>
    </body>
    <body name="weight" pos="0 1 1"><freejoint/><geom name="w" type="ellipsoid" size="0.1 0.07 0.05" mass="0.3"/>
      <site name="hook"/></body>
    <body name="other" pos="3 1 1"><freejoint/><geom size="0.1"/></body>
  </worldbody>
  <contact><exclude body1="weight" body2="arm"/></contact>
  <equality><weld name="glue" body1="weight" body2="other" active="true"/></equality>
  <tendon><spatial name="rope" limited="true" range="0 1.5" stiffness="5" springlength="1"><site site="nail"/>
    <site site="hook"/></spatial></tendon>
  <keyframe><key name="later" qpos="0.4 0.1  0 1 1 1 0 0 0  3 1 1 1 0 0 0" qvel="1 2  0 0 1 0 0 2  0 0 0 0 0 0"/></keyframe>
</mujoco>)";

TEST_F(NewerMjcf, BothLibrariesMakeTheSameScenario) {
    const auto folder = freshFolder("both");
    const auto older = writeText(folder / "older.xml", kOfBoth);
    const auto newer = writeText(folder / "newer.xml", madeNewer(kOfBoth));
    for (const char* options : {"", "--keyframe later"}) {
        SCOPED_TRACE(options);
        const Scenario a = imported("mjcf", older, options), b = imported("mjcf", newer, options);
        EXPECT_EQ(a.joints.size(), 4u);
        expectSameMeaning(a, b, kTolerance);
        expectNear(a.gravity, b.gravity, 0.0, "gravity");
    }
    const auto text =
        rigor("import mjcf --json --out " + (folder / "o.json").string() + " " + newer.string()).out;
    std::ifstream scenario(folder / "o.json");
    const std::string written{std::istreambuf_iterator<char>(scenario), {}};
    EXPECT_THAT(written, HasSubstr("MuJoCo 3.14")) << text;
}

TEST_F(NewerMjcf, WhatAScenarioLacksIsRefusedByName) {
    const auto refusalOf = [](const char* name, const std::string& joint, const std::string& more = "") {
        return refusal("mjcf", writeText(freshFolder(name) / "m.xml",
                                         "<mujoco><worldbody><site name='a'/><body name='b' pos='0 0 1'>" +
                                             joint + "<geom size='.1'/><site name='s'/></body></worldbody>" +
                                             more + "</mujoco>"));
    };
    EXPECT_THAT(refusalOf("poly", "<joint stiffness='0 0 4'/>"), HasSubstr("whose force is not linear"));
    EXPECT_THAT(refusalOf("damper", "<joint damping='1 2'/>"), HasSubstr("whose force is not linear"));
    EXPECT_THAT(
        refusalOf("band", "<freejoint/>",
                  "<tendon><spatial stiffness='1' springlength='0.2 0.4'><site site='a'/><site site='s'/>"
                  "</spatial></tendon>"),
        HasSubstr("dead band"));
    EXPECT_THAT(refusalOf("pulled", "<freejoint/>", "<equality><connect site1='a' site2='s'/></equality>"),
                HasSubstr("not where it holds them"));
    EXPECT_THAT(refusalOf("cloth", "<flexcomp name='c' type='grid' count='3 3 1' spacing='.1 .1 .1'/>"),
                HasSubstr("--without deformables"));
    EXPECT_THAT(refusalOf("future", "<joint colour='red'/>"), HasSubstr("newer than libmujoco"));
    // The message of the older library is shown where neither compiles.
    EXPECT_THAT(refusalOf("twice", "<joint type='wheel'/>"), HasSubstr("libmujoco 2.2.2 says"));
}

TEST_F(NewerMjcf, WithoutNodeTheRefusalSaysSo) {
    const auto file = writeText(freshFolder("nonode") / "newer.xml", kNewer);
    const std::string before = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const std::string said = refusal("mjcf", file);
    setenv("PATH", before.c_str(), 1);
    EXPECT_THAT(said, HasSubstr("there is no node"));
}

/// The word that leaves an element out is named wherever the element stands, in a frame with a pose too.
TEST(NewerMjcfAlone, NamesTheWordOfAnElementInAFrame) {
    const auto refusalOf = [](const std::string& name, const std::string& element) {
        return refusal("mjcf", writeText(freshFolder(name) / (name + ".xml"),
                                         "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body>\n"
                                         "<frame pos='0 0 1'>" +
                                             element + "</frame></worldbody></mujoco>"));
    };
    EXPECT_THAT(refusalOf("part", "<attach model='m' body='b' prefix='p'/>"), HasSubstr("--without attach"));
    EXPECT_THAT(refusalOf("sheet", "<flexcomp name='c' type='grid' count='3 3 1' spacing='.1 .1 .1'/>"),
                HasSubstr("--without deformables"));
}

/// Message of a reader that is alone in a folder, with the given manifest beside it.
std::string saidByAReaderIn(const fs::path& folder, const std::string& manifest) {
    const auto file = writeText(folder / "newer.xml", kNewer);
    fs::create_directories(folder / "readers");
    fs::copy_file(fs::path(RIGOR_BINARY_DIR) / "bin/readers/rigor-read-mjcf", folder / "readers/read");
    if (!manifest.empty()) {
        fs::create_directories(folder / "adapters");
        writeText(folder / "adapters/rigor_adapter_mujoco3.json", manifest);
    }
    ReadOptions options;
    options.file = file;
    const std::string command = (folder / "readers/read").string() + " '" + toJson(options).dump() + "' " +
                                (folder / "answer.json").string();
    if (std::system(command.c_str()) != 0) return "the reader failed";
    std::ifstream in(folder / "answer.json");
    const auto report = Report::fromJson(nlohmann::json::parse(in).at("report"));
    EXPECT_TRUE(report.isRefused());
    return report.text();
}

TEST(NewerMjcfAlone, SaysWhereToGetTheNewerLibrary) {
    const std::string said = saidByAReaderIn(freshFolder("alone"), "");
    EXPECT_THAT(said, HasSubstr("newer.xml:5"));
    EXPECT_THAT(said, HasSubstr("MuJoCo 3 of npm does: ./rigor --with guests"));
}

/// The packages' manifest names another way, because they have no launcher.
TEST(NewerMjcfAlone, SaysHowAnInstalledGuestGetsItsLibrary) {
    const std::string said = saidByAReaderIn(
        freshFolder("packaged"), R"({"folder": "guest", "needs": ["library"], "install": "npm ci, there"})");
    EXPECT_THAT(said, HasSubstr("MuJoCo 3 of npm does: npm ci, there"));
}

}  // namespace
}  // namespace rigor::models::testing
