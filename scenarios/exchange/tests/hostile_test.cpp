// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files that are wrong, or that hold what a scenario has not: each is refused with the file, the line and the reason.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace {

using scenario::Scenario;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusedText(const std::string& format, const std::string& text, const std::string& options = "") {
    const std::string end = format == "sdf" ? "sdf" : format == "urdf" ? "urdf" : "xml";
    return refusal(format, writeText(freshFolder("hostile") / ("model." + end), text), options);
}
std::string mjcf(const std::string& body, const std::string& other = "") {
    return "<mujoco>" + other + "\n<worldbody>\n" + body + "\n</worldbody></mujoco>";
}
std::string urdf(const std::string& inner) {
    return "<robot name=\"r\">\n" + inner + "\n</robot>";
}
std::string sdf(const std::string& inner) {
    return "<sdf version=\"1.6\">\n<model name=\"m\">\n" + inner + "\n</model></sdf>";
}
constexpr const char* kLink = R"(<link name="a"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)";

TEST(BadModels, BrokenXml) {
    EXPECT_THAT(refusedText("mjcf", "<mujoco>\n<worldbody>\n<body>\n</worldbody></mujoco>"),
                HasSubstr("model.xml:3: file: not well-formed XML"));
    EXPECT_THAT(refusedText("urdf", "<robot"), HasSubstr("not well-formed XML"));
    EXPECT_THAT(refusedText("sdf", ""), HasSubstr("not well-formed XML"));
    EXPECT_THAT(refusedText("mjcf", std::string("<mujoco>\0</mujoco>", 18)), HasSubstr("zero byte"));
    EXPECT_THAT(refusedText("mjcf", "<!DOCTYPE x [<!ENTITY a \"b\">]>\n<mujoco/>"),
                HasSubstr("document type"));
    std::string deep;
    for (int i = 0; i < 5000; ++i) deep += "<body>";
    EXPECT_THAT(refusedText("mjcf", "<mujoco><worldbody>" + deep), HasSubstr("not well-formed XML"));
    EXPECT_THAT(refusedText("urdf", "<mujoco/>"), HasSubstr("found <mujoco>, expected <robot>"));
    EXPECT_THAT(refusal("mjcf", "/nowhere/model.xml"), HasSubstr("there is no such file"));
}

TEST(BadModels, NumbersThatAreNone) {
    EXPECT_THAT(refusedText("mjcf", mjcf("<body>\n<freejoint/><geom size=\"nan\"/></body>")),
                HasSubstr("model.xml:4: <geom> size: the value is not a number"));
    EXPECT_THAT(refusedText("mjcf", mjcf("<body><freejoint/><geom size=\"x\"/></body>")),
                HasSubstr("libmujoco"));
    EXPECT_THAT(refusedText("mjcf", mjcf("<body><freejoint/><geom size=\"-1\"/></body>")),
                HasSubstr("libmujoco"));
    EXPECT_THAT(
        refusedText("urdf", urdf("<link name=\"a\"><inertial>\n<mass value=\"NaN\"/></inertial></link>")),
        HasSubstr("model.urdf:3: <mass> value: the value is not a number"));
    EXPECT_THAT(refusedText("sdf", sdf("<link name=\"l\"><inertial>\n<mass>nan</mass></inertial></link>")),
                HasSubstr("model.sdf:4: <mass>: the value is not a number"));
    EXPECT_THAT(
        refusedText("urdf", urdf("<link name=\"a\"><inertial><mass value=\"1\"/>"
                                 "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"5\"/>"
                                 "</inertial></link>")),
        AllOf(HasSubstr("model.urdf:2: 'a'/inertia"), HasSubstr("positive definite")));
}

TEST(BadModels, FilesThatAreNotThere) {
    const char* mesh = "<asset>\n<mesh name=\"m\" file=\"%\"/></asset>";
    const auto with = [&](const std::string& file) {
        std::string text = mesh;
        return mjcf("<body><freejoint/><geom type=\"mesh\" mesh=\"m\"/></body>",
                    text.replace(text.find('%'), 1, file));
    };
    EXPECT_THAT(refusedText("mjcf", with("none.obj")),
                HasSubstr("model.xml:2: file: there is no file 'none.obj'"));
    writeText(freshFolder("elsewhere") / "there.obj", "v 0 0 0\n");
    EXPECT_THAT(refusedText("mjcf", with("../elsewhere/there.obj")), HasSubstr("lies outside the folder"));
    EXPECT_THAT(refusedText("mjcf", with("/etc/passwd")), HasSubstr("lies outside the folder"));
    EXPECT_THAT(refusedText("mjcf", "<mujoco>\n<include file=\"none.xml\"/></mujoco>"),
                HasSubstr("model.xml:2: file: there is no file 'none.xml'"));
    EXPECT_THAT(refusedText("mjcf", "<mujoco>\n<include file=\"model.xml\"/></mujoco>"),
                HasSubstr("more than 256 included files"));
    const std::string collision = "<collision><geometry><mesh filename=\"%\"/></geometry></collision></link>";
    const auto robot = [&](const std::string& file) {
        std::string text = urdf(kLink + collision);
        return text.replace(text.find('%'), 1, file);
    };
    EXPECT_THAT(refusedText("urdf", robot("package://p/none.stl")), HasSubstr("there is no file"));
    EXPECT_THAT(refusedText("urdf", robot("https://example.org/a.stl")), HasSubstr("from a network"));
    EXPECT_THAT(
        refusedText("sdf",
                    "<sdf version=\"1.6\"><world name=\"w\"><include>\n<uri>model://none</uri></include>"
                    "</world></sdf>"),
        AllOf(HasSubstr("model.sdf:2: <include>: there is no file 'model://none'"),
              HasSubstr("--without none")));
    const auto folder = freshFolder("garbage");
    writeText(folder / "a.stl", "solid of nothing");
    EXPECT_THAT(refusal("urdf", writeText(folder / "model.urdf", robot("a.stl"))), HasSubstr("mesh"));
}

TEST(BadModels, NamesAndReferences) {
    EXPECT_THAT(refusedText("urdf", urdf(std::string(kLink) + "</link>\n" + kLink + "</link>")),
                HasSubstr("a second <link> of the name 'a'"));
    EXPECT_THAT(
        refusedText("urdf", urdf(std::string(kLink) + "</link><joint name=\"j\" type=\"revolute\">"
                                                      "<parent link=\"a\"/><child link=\"none\"/></joint>")),
        HasSubstr("liburdfdom says"));
    EXPECT_THAT(refusedText("mjcf", mjcf("<body name=\"a\"><freejoint/><geom size=\"1\"/></body>\n"
                                         "<body name=\"a\"><freejoint/><geom size=\"1\"/></body>")),
                HasSubstr("repeated name"));
    EXPECT_THAT(
        refusedText("sdf", sdf("<link name=\"l\"/>\n<joint name=\"j\" type=\"fixed\"><parent>l</parent>"
                               "<child>none</child></joint>")),
        HasSubstr("libsdformat says"));
}

TEST(BadModels, WhatHasNoCounterpartIsRefusedByNameAndLine) {
    const std::string actuator = "<actuator>\n<motor joint=\"j\"/></actuator>";
    const std::string text = mjcf(
        "<body><joint name=\"j\" armature=\"0.1\"/><geom size=\"1\" solref=\"0.1 1\"/></body>", actuator);
    EXPECT_THAT(
        refusedText("mjcf", text),
        AllOf(HasSubstr(
                  "model.xml:2: <motor>: a scenario has no actuators; leave out with --without actuators"),
              HasSubstr("model.xml:4: <joint> armature"), HasSubstr("model.xml:4: <geom> solref")));
    EXPECT_THAT(refusedText("mjcf", text, "--without actuators"), HasSubstr("--without armature"));
    const auto file = writeText(freshFolder("left_out") / "m.xml", text);
    EXPECT_EQ(imported("mjcf", file, "--without actuators,armature,softness").joints.size(), 1u);
    EXPECT_THAT(refusedText("mjcf", mjcf("<body>\n<frobnicate/></body>")),
                HasSubstr("model.xml:4: <frobnicate>"));
    EXPECT_THAT(refusedText("sdf", sdf("<plugin name=\"p\" filename=\"libp.so\"/><link name=\"l\"/>")),
                HasSubstr("model.sdf:3: <plugin>"));
    EXPECT_THAT(
        refusedText("sdf", sdf("<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" type=\"screw\">"
                               "<parent>a</parent><child>b</child></joint>")),
        HasSubstr("model.sdf:4: <joint> type: a screw has no counterpart"));
    EXPECT_THAT(refusedText("mjcf", mjcf("<geom size=\"1\"/>")), HasSubstr("no body of it can move"));
}

TEST(BadModels, AConcaveMeshThatMoves) {
    const auto folder = freshFolder("concave");
    // A cube whose top face is drawn in to the middle.
    const auto mesh = writeText(folder / "dent.obj",
                                "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
                                "v 0.5 0.5 0.5\nf 1 2 3\nf 1 3 4\nf 1 6 2\nf 1 5 6\nf 2 7 3\nf 2 6 7\n"
                                "f 3 8 4\nf 3 7 8\nf 4 5 1\nf 4 8 5\nf 5 9 6\nf 6 9 7\nf 7 9 8\nf 8 9 5\n");
    EXPECT_THAT(refusal("mesh", mesh), AllOf(HasSubstr("not convex"), HasSubstr("--hull")));
    const auto hull = imported("mesh", mesh, "--hull --density 500");
    EXPECT_NEAR(hull.bodies[0].massProperties.mass, 500.0, 1e-9);
    const auto ground = imported("mesh", mesh, "--static");
    ASSERT_EQ(ground.bodies.size(), 2u);
    EXPECT_EQ(std::get<scenario::TriangleMesh>(ground.bodies[0].shapes[0].geometry).triangles.size(), 14u);
}

/// Points of a sphere, by turns of the golden angle, as the corners of a hull.
std::string roundMesh(int points) {
    std::string text;
    for (int i = 0; i < points; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / points, r = std::sqrt(1.0 - z * z),
                     turn = 2.399963229728653 * i;
        text += std::to_string(r * std::cos(turn)) + " " + std::to_string(r * std::sin(turn)) + " " +
                std::to_string(z) + " ";
    }
    return text;
}

TEST(BadModels, HullsOfManyCorners) {
    const std::string text = "<mujoco><asset><mesh name=\"m\" vertex=\"" + roundMesh(300) +
                             "\"/></asset>\n<worldbody><body><freejoint/>\n<geom type=\"mesh\" mesh=\"m\"/>"
                             "</body></worldbody></mujoco>";
    const auto file = writeText(freshFolder("corners") / "m.xml", text);
    EXPECT_THAT(refusal("mjcf", file),
                AllOf(HasSubstr("m.xml:3"), HasSubstr("has 300 corners"), HasSubstr("--hull-corners 64")));
    const Outcome outcome = rigor("import mjcf '" + file.string() + "' --hull-corners 64 --json --out '" +
                                  (file.parent_path() / "s.json").string() + "'");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Scenario s = scenario::loadScenario(file.parent_path() / "s.json").scenario;
    const auto& corners = std::get<scenario::ConvexHull>(s.bodies[0].shapes[0].geometry).vertices;
    ASSERT_EQ(corners.size(), 64u);
    // 64 points that are spread well over a unit sphere: caps between them are about 0.06 high.
    const std::string before = "stands out of theirs by at most ";
    const auto at = outcome.out.find(before);
    ASSERT_NE(at, std::string::npos) << outcome.out;
    const double stated = std::stod(outcome.out.substr(at + before.size()));
    EXPECT_GT(stated, 0.03);
    EXPECT_LT(stated, 0.1);
    // The stated distance, by another way: the support of the whole hull less that of the simpler one, over directions.
    double largest = 0.0;
    std::istringstream in(roundMesh(2000));
    std::vector<scenario::Vec3> all;
    std::istringstream points(roundMesh(300));
    for (scenario::Vec3 p; points >> p.x >> p.y >> p.z;) all.push_back(p);
    for (scenario::Vec3 d; in >> d.x >> d.y >> d.z;) {
        // MuJoCo moves the frame of a mesh to its centre and principal axes; corners of the sphere keep their mutual
        // distances, so that the supports are compared in the frame of the points that were taken.
        double whole = -1e300, fewer = -1e300;
        for (const auto& p : all) whole = std::max(whole, dot(p, d));
        for (const auto& c : corners) fewer = std::max(fewer, dot(s.bodies[0].shapes[0].pose * c, d));
        largest = std::max(largest, (whole - fewer) / norm(d));
    }
    EXPECT_NEAR(largest, stated, 0.1 * stated);
}

TEST(BadModels, AnUnknownFormatIsADataSet) {
    EXPECT_THAT(rigor("import stl x").err, HasSubstr("no data set 'stl' is known"));
}

}  // namespace
}  // namespace rigor::models::testing
