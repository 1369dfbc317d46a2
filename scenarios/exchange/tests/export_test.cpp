// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Export writes a six_dof joint as several joints, and height fields, hulls and meshes into files beside the model; they
// come back as they were.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <fstream>

#include "scenarios/exchange/tests/tool.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::models::testing {
namespace {

using ::testing::HasSubstr;
using namespace scenario;

/// A scenario of one body and one joint to the world, turned about an axis that is none of the frame's.
std::string withJoint(const std::string& joint, const std::string& motion = "") {
    return R"({"rigor": 1, "name": "one", "title": "one", "dimension": 3, "gravity": [0, 0, -9.81], "duration": 1,
      "dt": [0.001], "bodies": [{"name": "block", "position": [0.4, 0.1, 0.2], "orientation": [0.8, 0.36, 0.48, 0],
      "mass": 2, "center_of_mass": [0.02, 0.01, 0], "inertia": [0.02, 0.03, 0.04])" +
           motion + R"(}], "joints": [{"name": "link", "type": "six_dof", "a": "world", "b": "block",
      "anchor": [0.3, 0.2, 0.1], )" +
           joint + "}]}";
}

struct Exported {
    Outcome outcome;
    Scenario before, after;
};
Exported roundTrip(const std::string& text, const std::string& options = "") {
    const auto folder = freshFolder("export");
    const auto file = writeText(folder / "one.json", text), model = folder / "one.xml";
    Exported e{rigor("export mjcf " + file.string() + " --out " + model.string()), {}, {}};
    EXPECT_EQ(e.outcome.code, 0) << e.outcome.err;
    e.before = loadScenario(file).scenario;
    if (e.outcome.code == 0) e.after = imported("mjcf", model, options);
    return e;
}

TEST(ExportSixDof, TravelsAndATwistComeBack) {
    const auto e = roundTrip(withJoint(
        R"("axis": [0.6, 0.8, 0], "normal": [0, 0, 1], "axes": {"y": {"limits": [-0.1, 0.3]}, "z": "free",
           "twist": {"limits": [-0.5, null], "spring": {"stiffness": 3, "damping": 0.2, "target": 0.1}}})"));
    ASSERT_EQ(e.after.joints.size(), 1u);
    const Joint &a = e.before.joints[0], &b = e.after.joints[0];
    ASSERT_EQ(b.type, JointType::SixDof);
    EXPECT_EQ(b.name, "link");
    const Pose pose = e.before.bodies[0].pose;
    expectNear(pose * b.anchorB, pose * a.anchorB, kTolerance, "anchor");
    expectNear(b.axisB, a.axisB, kTolerance, "axis");
    expectNear(b.normalA, a.normalA, kTolerance, "normal");
    for (std::size_t k = 0; k < 6; ++k) {
        SCOPED_TRACE(k);
        const bool wasLocked = a.axes[k].mode == AxisMode::Usual || a.axes[k].mode == AxisMode::Locked;
        EXPECT_EQ(b.axes[k].mode == AxisMode::Locked, wasLocked);
        EXPECT_NEAR(std::max(b.axes[k].lower, -1e6), std::max(a.axes[k].lower, -1e6), kTolerance);
        EXPECT_NEAR(std::min(b.axes[k].upper, 1e6), std::min(a.axes[k].upper, 1e6), kTolerance);
        EXPECT_DOUBLE_EQ(b.axes[k].stiffness, a.axes[k].stiffness);
        EXPECT_DOUBLE_EQ(b.axes[k].damping, a.axes[k].damping);
        EXPECT_NEAR(b.axes[k].target, a.axes[k].target, kTolerance);
    }
}

TEST(ExportSixDof, VelocitiesAreThoseOfTheKeyframe) {
    // A twist of 0.5 rad/s about the axis through the anchor, and 0.25 m/s along the normal.
    const std::string axes =
        R"("axis": [0.6, 0.8, 0], "normal": [0, 0, 1], "axes": {"y": "free", "twist": "free"})";
    Scenario s = loadScenarioText(withJoint(axes), "one.json").scenario;
    const Body& b = s.bodies[0];
    const Vec3 spin{0.3, 0.4, 0.0}, anchor{0.3, 0.2, 0.1};
    const Vec3 v = cross(spin, b.pose * b.massProperties.centerOfMass - anchor) + Vec3{0.0, 0.0, 0.25};
    const auto text = [](double x) {
        char out[40];
        std::snprintf(out, sizeof out, "%.17g", x);
        return std::string(out);
    };
    const auto e = roundTrip(withJoint(axes, ", \"velocity\": [" + text(v.x) + ", " + text(v.y) + ", " +
                                                 text(v.z) + R"(], "angular_velocity": [0.3, 0.4, 0])"),
                             "--keyframe start");
    expectNear(e.after.bodies[0].velocity, v, kTolerance, "velocity");
    expectNear(e.after.bodies[0].angularVelocity, spin, kTolerance, "spin");
}

TEST(ExportSixDof, AUniversalJointAndABallComeBack) {
    const auto cardan = roundTrip(withJoint(
        R"("axis": [0.6, 0.8, 0], "normal": [0, 0, 1], "axes": {"twist": {"limits": [-1, 1]}, "swing_y": {"limits": [-0.2, 0.4]}})"));
    ASSERT_EQ(cardan.after.joints.size(), 1u);
    const Joint& j = cardan.after.joints[0];
    ASSERT_EQ(j.type, JointType::SixDof);
    expectNear(j.axisB, cardan.before.joints[0].axisB, kTolerance, "axis");
    expectNear(j.normalA, {0, 0, 1}, kTolerance, "normal");
    EXPECT_DOUBLE_EQ(j.axes[3].upper, 1.0);
    EXPECT_DOUBLE_EQ(j.axes[4].lower, -0.2);
    EXPECT_DOUBLE_EQ(j.axes[4].upper, 0.4);
    EXPECT_EQ(j.axes[5].mode, AxisMode::Locked);
    const auto ball = roundTrip(withJoint(
        R"("axis": [1, 0, 0], "normal": [0, 0, 1], "axes": {"twist": "free", "swing_y": "free", "swing_z": "free"})"));
    ASSERT_EQ(ball.after.joints.size(), 1u);
    EXPECT_EQ(ball.after.joints[0].type, JointType::Ball);
}

TEST(ExportSixDof, WhatHasNoCounterpartIsRefused) {
    const auto file = writeText(
        freshFolder("export") / "one.json",
        withJoint(
            R"("axis": [1, 0, 0], "normal": [0, 0, 1], "axes": {"swing_y": "free", "swing_z": "free"})"));
    const Outcome out = rigor("export mjcf " + file.string());
    EXPECT_EQ(out.code, 2);
    EXPECT_THAT(
        out.err,
        HasSubstr(
            "the joint 'link', a six_dof of these coordinates; leave out with --without six_dof_joints"));
}

constexpr const char* kHills =
    R"({"rigor": 1, "name": "hills", "title": "hills", "dimension": 3, "gravity": [0, -9.81, 0],
  "duration": 1, "dt": [0.002], "materials": {"m": {"friction": 1}}, "bodies": [
   {"name": "ground", "material": "m", "type": "static", "position": [1, 2, 3], "orientation": [0.8, 0, 0.6, 0], "shapes": [
     {"height_field": {"spacing": [0.5, 0.25], "thickness": 0.75,
      "heights": [[0.5, 0.1, 0.2], [0.3, 0.7, -0.25], [0.4, 0.6, 0.9], [0.15, 0.35, 0.05]]}, "position": [0.1, 0.2, 0.3]}]},
   {"name": "ball", "material": "m", "position": [0, 6, 0], "shapes": [{"sphere": {"radius": 0.1}}]}]})";

TEST(ExportSurfaces, AHeightFieldComesBackFromMjcf) {
    const auto folder = freshFolder("hills");
    const auto file = writeText(folder / "hills.json", kHills), model = folder / "out.xml";
    EXPECT_THAT(rigor("export mjcf " + file.string()).err, HasSubstr("--out FILE says where"));
    const Outcome out = rigor("export mjcf " + file.string() + " --out " + model.string());
    ASSERT_EQ(out.code, 0) << out.err;
    char message[500] = "";
    mjModel* m = mj_loadXML(model.c_str(), nullptr, message, sizeof message);
    ASSERT_NE(m, nullptr) << message;
    EXPECT_EQ(m->nhfield, 1);
    mj_deleteModel(m);
    const Scenario before = loadScenario(file).scenario, after = imported("mjcf", model);
    const auto points = [](const Scenario& s) {
        const Body& b = s.bodies[static_cast<std::size_t>(findBody(s, "ground"))];
        std::vector<Vec3> all = surfaceVertices(std::get<HeightField>(b.shapes[0].geometry));
        for (Vec3& p : all) p = b.pose * b.shapes[0].pose * p;
        return all;
    };
    const auto was = points(before), is = points(after);
    ASSERT_EQ(is.size(), was.size());
    for (std::size_t i = 0; i < was.size(); ++i)
        expectNear(is[i], was[i], 1e-7, "vertex " + std::to_string(i));
    EXPECT_NEAR(std::get<HeightField>(after.bodies[0].shapes[0].geometry).thickness, 0.75, kTolerance);
}

constexpr const char* kYard =
    R"({"rigor": 1, "name": "yard", "title": "yard", "dimension": 3, "gravity": [0, 0, -9.81],
  "duration": 1, "dt": [0.002], "materials": {"m": {"friction": 1}}, "bodies": [
   {"name": "ramp", "material": "m", "type": "static", "position": [0.5, 0, 0], "shapes": [{"triangle_mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0.25], [0, 1, 0.5]],
     "triangles": [[0, 1, 2], [0, 2, 3]]}}]},
   {"name": "wedge", "material": "m", "position": [0.1, 0.2, 2], "mass": 1, "inertia": [0.1, 0.1, 0.1], "shapes": [{"hull": {"vertices":
     [[0, 0, 0], [0.5, 0, 0], [0, 0.5, 0], [0.5, 0.5, 0], [0, 0, 0.25], [0, 0.5, 0.25]]}, "position": [0.125, 0, 0]}]},
   {"name": "puck", "material": "m", "position": [3, 0, 0.125], "mass": 1, "inertia": [0.1, 0.1, 0.1], "shapes": [{"sphere": {"radius": 0.125}}]}],
  "joints": [{"name": "table", "type": "six_dof", "a": "world", "b": "puck", "anchor": [3, 0, 0.125], "axis": [0, 0, 1],
    "normal": [1, 0, 0], "axes": {"y": "free", "z": "free", "twist": "free"}}]})";

TEST(ExportSurfaces, HullsMeshesAndAPlanarJointComeBackFromUrdf) {
    const auto folder = freshFolder("yard");
    const auto file = writeText(folder / "yard.json", kYard), model = folder / "yard.urdf";
    const Outcome out = rigor("export urdf " + file.string() + " --without friction --out " + model.string());
    ASSERT_EQ(out.code, 0) << out.err;
    const Scenario after = imported("urdf", model, "--self-collision");
    const Body &ramp = after.bodies[static_cast<std::size_t>(findBody(after, "ramp"))],
               &wedge = after.bodies[static_cast<std::size_t>(findBody(after, "wedge"))];
    const auto& mesh = std::get<TriangleMesh>(ramp.shapes.at(0).geometry);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    expectNear(ramp.pose * ramp.shapes[0].pose * mesh.vertices.at(2), {1.5, 1, 0.25}, kTolerance, "ramp");
    const auto& hull = std::get<ConvexHull>(wedge.shapes.at(0).geometry);
    EXPECT_EQ(hull.vertices.size(), 6u);
    double right = -1e300;
    for (const Vec3& v : hull.vertices) right = std::max(right, (wedge.pose * wedge.shapes[0].pose * v).x);
    EXPECT_NEAR(right, 0.1 + 0.125 + 0.5, kTolerance);
    ASSERT_EQ(after.joints.size(), 1u);
    EXPECT_EQ(after.joints[0].type, JointType::SixDof);
    expectNear(after.joints[0].axisB, {0, 0, 1}, kTolerance, "normal of the plane");
    EXPECT_EQ(after.joints[0].axes[0].mode, AxisMode::Locked);
    EXPECT_EQ(after.joints[0].axes[1].mode, AxisMode::Free);
    EXPECT_EQ(after.joints[0].axes[3].mode, AxisMode::Free);
    const Outcome mjcf = rigor("export mjcf " + file.string());
    EXPECT_EQ(mjcf.code, 2);
    EXPECT_THAT(mjcf.err, HasSubstr("MuJoCo collides a mesh as its convex hull"));
}

}  // namespace
}  // namespace rigor::models::testing
