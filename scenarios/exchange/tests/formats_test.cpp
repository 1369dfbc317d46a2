// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// URDF and SDF are read as their libraries understand them; exported scenarios come back the same.
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <sdf/sdf.hh>

#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace {

using ::testing::HasSubstr;
using namespace scenario;

Pose convert(const ignition::math::Pose3d& p) {
    return {{p.Pos().X(), p.Pos().Y(), p.Pos().Z()}, {p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()}};
}

/// Mass, centre and inertia in the world of a body against those of a frame.
void expectMass(const Body& b, const Pose& frame, double mass, const Vec3& centre, const Mat3& inertia) {
    EXPECT_NEAR(b.massProperties.mass, mass, kTolerance * mass) << b.name;
    expectNear(b.pose * b.massProperties.centerOfMass, frame * centre, kTolerance, b.name + ", centre");
    const Mat3 r = toMatrix(b.pose.orientation), q = toMatrix(frame.orientation);
    expectNear(r * b.massProperties.inertia * transpose(r), q * inertia * transpose(q), kTolerance,
               b.name + ", inertia");
}

TEST(Sdf, ModelsAreWhatTheLibrarySays) {
    const auto folder = modelsFolder();
    if (folder.empty()) GTEST_SKIP() << "RIGOR_DATA is not set";
    sdf::Console::Instance()->SetQuiet(true);
    for (const char* name :
         {"benchmark/dzhanibekov.sdf", "benchmark/boxes_right_angle.sdf", "drake/cart_pole.sdf",
          "drake/four_bar.sdf", "gz-physics/pendulum_joint_wrench.sdf", "gz-physics/contact.sdf"}) {
        SCOPED_TRACE(name);
        const Scenario s = imported("sdf", folder / name);
        sdf::Root root;
        ASSERT_TRUE(root.Load((folder / name).string()).empty());
        const sdf::World* world = root.WorldByIndex(0);
        int compared = 0;
        const auto compare = [&](const sdf::Model& m) {
            const Pose modelPose = convert(m.RawPose());
            for (uint64_t i = 0; i < m.LinkCount(); ++i) {
                const sdf::Link& l = *m.LinkByIndex(i);
                const int index = findBody(s, m.Name() + "." + l.Name());
                ASSERT_NE(index, kNone) << l.Name();
                const Body& b = s.bodies[static_cast<std::size_t>(index)];
                ignition::math::Pose3d pose;
                ASSERT_TRUE(l.SemanticPose().Resolve(pose, "__model__").empty());
                const Pose frame = modelPose * convert(pose);
                expectNear(b.pose.position, frame.position, kTolerance, b.name);
                if (b.type != BodyType::Dynamic) continue;
                const auto inertial = l.Inertial();
                const auto moments = inertial.Moi();
                Mat3 tensor;
                for (std::size_t r = 0; r < 3; ++r)
                    for (std::size_t c = 0; c < 3; ++c)
                        tensor(static_cast<int>(r), static_cast<int>(c)) = moments(r, c);
                expectMass(b, frame, inertial.MassMatrix().Mass(), convert(inertial.Pose()).position, tensor);
                ++compared;
            }
        };
        if (world)
            for (uint64_t i = 0; i < world->ModelCount(); ++i) compare(*world->ModelByIndex(i));
        else
            compare(*root.Model());
        EXPECT_GT(compared, 0);
    }
}

TEST(Urdf, ModelsAreWhatTheLibrarySays) {
    const auto folder = modelsFolder();
    if (folder.empty()) GTEST_SKIP() << "RIGOR_DATA is not set";
    for (const char* name :
         {"bullet3/TwoJointRobot_w_fixedJoints.urdf", "bullet3/cartpole.urdf", "bullet3/block.urdf",
          "dair_pll/contactnets_cube.urdf", "drake/uniform_solid_cylinder.urdf"}) {
        SCOPED_TRACE(name);
        const Scenario s = imported("urdf", folder / name);
        std::ifstream in(folder / name);
        const auto model = urdf::parseURDF({std::istreambuf_iterator<char>(in), {}});
        ASSERT_TRUE(model);
        int compared = 0;
        const std::function<void(const urdf::Link&, const Pose&)> compare = [&](const urdf::Link& l,
                                                                                const Pose& frame) {
            const int index = findBody(s, l.name);
            if (index != kNone && s.bodies[static_cast<std::size_t>(index)].type == BodyType::Dynamic) {
                const urdf::Inertial& i = *l.inertial;
                Mat3 tensor;
                const double v[9] = {i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz};
                for (int k = 0; k < 9; ++k) tensor(k / 3, k % 3) = v[k];
                expectMass(s.bodies[static_cast<std::size_t>(index)], frame, i.mass,
                           {i.origin.position.x, i.origin.position.y, i.origin.position.z}, tensor);
                ++compared;
            }
            for (const auto& child : l.child_links) {
                const urdf::Pose& p = child->parent_joint->parent_to_joint_origin_transform;
                compare(*child, frame * Pose{{p.position.x, p.position.y, p.position.z},
                                             {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z}});
            }
        };
        compare(*model->getRoot(), {});
        EXPECT_GT(compared, 0);
    }
}

/// Everything that MJCF can hold: shapes, joints, limits, springs, friction, filters, a loop, a rope, velocities.
constexpr const char* kRich =
    R"({"rigor": 1, "name": "rich", "title": "rich", "dimension": 3, "gravity": [0.1, -9.81, 0.2],
  "duration": 1, "dt": [0.002], "layers": ["ghost"],
  "materials": {"rough": {"friction": 0.9, "rolling_friction": 0.01, "torsional_friction": 0.02}, "smooth": {"friction": 0.2}},
  "pairs": [{"a": "rough", "b": "smooth", "friction": 0.5, "restitution": 0}],
  "bodies": [
   {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0], "offset": -3}, "material": "rough"}]},
   {"name": "base", "position": [0.1, 0.2, 0.3], "orientation": [0.5, 0.5, -0.5, 0.5], "mass": 2, "center_of_mass": [0.01, 0.02, 0.03],
    "inertia": [[0.05, 0.001, 0.002], [0.001, 0.06, -0.003], [0.002, -0.003, 0.07]],
    "shapes": [{"capsule": {"radius": 0.1, "half_length": 0.3}, "position": [0.1, 0, 0], "material": "smooth"}]},
   {"name": "arm", "position": [0.1, -0.4, 0.3], "mass": 1, "inertia": [0.01, 0.02, 0.015],
    "shapes": [{"box": {"half_extents": [0.1, 0.2, 0.3]}, "material": "rough"}]},
   {"name": "bob", "position": [0.1, -1.0, 0.3], "mass": 0.5, "inertia": [0.01, 0.01, 0.01],
    "shapes": [{"cylinder": {"radius": 0.1, "half_length": 0.2}, "material": "smooth", "layers": ["ghost"], "collides_with": ["default"]}]},
   {"name": "free", "position": [2, 1, 0], "velocity": [1, 2, 3], "angular_velocity": [0.1, 0.2, 0.3], "mass": 0.7,
    "inertia": [0.01, 0.02, 0.025], "center_of_mass": [0.05, 0, 0],
    "shapes": [{"ellipsoid": {"half_axes": [0.1, 0.2, 0.3]}, "material": "smooth", "layers": ["ghost"], "collides_with": []}]},
   {"name": "hung", "position": [3, 0, 0], "mass": 0.7, "inertia": [0.01, 0.02, 0.025], "shapes": [{"sphere": {"radius": 0.2}, "material": "rough"}]}],
  "joints": [
   {"name": "hip", "type": "hinge", "a": "world", "b": "base", "anchor": [0.1, 0.3, 0.3], "axis": [0, 0, 1], "limits": [-1, 2],
    "spring": {"stiffness": 2, "damping": 0.1, "target": 0.2}},
   {"name": "rail", "type": "slider", "a": "base", "b": "arm", "anchor": [0.1, -0.2, 0.3], "axis": [0, 1, 0], "limits": [null, 0.4],
    "motor": {"speed": 0, "max_force": 3}},
   {"name": "socket", "type": "ball", "a": "arm", "b": "bob", "anchor": [0.1, -0.8, 0.3]},
   {"name": "loop", "type": "ball", "a": "world", "b": "bob", "anchor": [0.1, -1.2, 0.3], "collide_connected": true},
   {"name": "rope", "type": "distance", "a": "world", "b": "hung", "anchor_a": [3, 1, 0], "anchor_b": [0, 0.1, 0], "limits": [null, 1.2], "collide_connected": true}]})";

TEST(Export, AScenarioComesBackFromMjcf) {
    const auto folder = freshFolder("rich");
    const auto file = writeText(folder / "rich.json", kRich);
    const Outcome out = rigor("export mjcf " + file.string() + " --out " + (folder / "rich.xml").string());
    ASSERT_EQ(out.code, 0) << out.err;
    char message[500] = "";
    mjModel* m = mj_loadXML((folder / "rich.xml").c_str(), nullptr, message, sizeof message);
    ASSERT_NE(m, nullptr) << message;
    EXPECT_EQ(m->nbody, 7);
    EXPECT_EQ(m->njnt, 5);
    EXPECT_EQ(m->neq, 1);
    EXPECT_EQ(m->ntendon, 1);
    mj_deleteModel(m);
    const Scenario before = loadScenario(file).scenario;
    const Scenario after = imported("mjcf", folder / "rich.xml", "--keyframe start");
    expectSameMeaning(before, after, kTolerance);
}

TEST(Export, WhatMjcfHasNotIsRefused) {
    const Outcome out = rigor("export mjcf newtons_cradle");
    EXPECT_EQ(out.code, 2);
    EXPECT_THAT(out.err, HasSubstr("restitution: MuJoCo has no coefficient of restitution"));
}

constexpr const char* kRobot =
    R"({"rigor": 1, "name": "robot", "title": "robot", "dimension": 3, "gravity": [0, 0, -9.81],
  "duration": 1, "dt": [0.002], "materials": {"m": {"friction": 1}}, "bodies": [
   {"name": "base", "type": "static", "position": [0.1, 0, 0], "shapes": [{"box": {"half_extents": [0.1, 0.2, 0.3]}}]},
   {"name": "upper", "position": [0.1, 0.2, 0.3], "orientation": [0.5, 0.5, -0.5, 0.5], "mass": 2, "center_of_mass": [0.01, 0.02, 0.03],
    "inertia": [[0.05, 0.001, 0.002], [0.001, 0.06, -0.003], [0.002, -0.003, 0.07]],
    "shapes": [{"cylinder": {"radius": 0.1, "half_length": 0.3}, "position": [0.1, 0, 0]}]},
   {"name": "lower", "position": [0.1, -0.4, 0.3], "mass": 1, "inertia": [0.01, 0.02, 0.015], "shapes": [{"sphere": {"radius": 0.1}}]},
   {"name": "free", "position": [2, 1, 0], "mass": 0.7, "inertia": [0.01, 0.02, 0.025], "shapes": [{"sphere": {"radius": 0.2}}]}],
  "joints": [
   {"name": "hip", "type": "hinge", "a": "world", "b": "upper", "anchor": [0.1, 0.3, 0.3], "axis": [0, 0, 1], "limits": [-1, 2]},
   {"name": "rail", "type": "slider", "a": "upper", "b": "lower", "anchor": [0.1, -0.2, 0.3], "axis": [0.6, 0.8, 0],
    "motor": {"speed": 0, "max_force": 3}}]})";

TEST(Export, ARobotComesBackFromUrdf) {
    const auto folder = freshFolder("robot");
    const auto file = writeText(folder / "robot.json", kRobot);
    const Outcome refused = rigor("export urdf " + file.string());
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("URDF has no friction"));
    const Outcome out =
        rigor("export urdf " + file.string() + " --without friction --out " + (folder / "r.urdf").string());
    ASSERT_EQ(out.code, 0) << out.err;
    const Scenario before = loadScenario(file).scenario;
    const Scenario after = imported("urdf", folder / "r.urdf", "--self-collision");
    expectSameMeaning(before, after, kTolerance);
}

}  // namespace
}  // namespace rigor::models::testing
