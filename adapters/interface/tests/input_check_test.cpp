// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/input_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "adapters/interface/missing.hpp"
#include "adapters/interface/planar.hpp"

namespace rigor::adapter {
namespace {

using namespace scenario;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A ball over a floor, joined to it by a rod, with one force of each kind: everything legal.
Scenario goodScenario() {
    Scenario s;
    s.name = "good";
    s.materials.push_back({"stuff", 0.5, 0.5, 1000.0});
    Body floor;
    floor.name = "floor";
    floor.type = BodyType::Static;
    floor.shapes.push_back({HalfSpace{{0, 1, 0}, 0.0}, {}, 0});
    Body ball;
    ball.name = "ball";
    ball.pose.position = {0, 1, 0};
    ball.shapes.push_back({Sphere{0.5}, {}, 0});
    ball.massProperties = {2.0, {}, Mat3::diagonal(0.2, 0.2, 0.2)};
    s.bodies = {floor, ball};
    Joint rod;
    rod.name = "rod";
    rod.type = JointType::Distance;
    rod.bodyA = 0;
    rod.bodyB = 1;
    rod.length = 1.0;
    s.joints.push_back(rod);
    s.forces = {ConstantForce{1, {1, 0, 0}, {}, 0.0, 1.0}, SpringForce{kNone, 1, {}, {}, 10.0, 1.0, 0.5},
                DragForce{1, 0.1}};
    s.events.push_back({0.5, 1, {0, 1, 0}, {}});
    return s;
}

struct Fault {
    const char* name;
    const char* mentions;  ///< text that the message must contain
    std::function<void(Scenario&)> plant;
};

const std::vector<Fault>& faults() {
    static const std::vector<Fault> table{
        {"nan position", "ball", [](Scenario& s) { s.bodies[1].pose.position.x = kNan; }},
        {"infinite velocity", "velocity", [](Scenario& s) { s.bodies[1].velocity.y = INFINITY; }},
        {"nan spin", "angular_velocity", [](Scenario& s) { s.bodies[1].angularVelocity.z = kNan; }},
        {"nan gravity", "gravity", [](Scenario& s) { s.gravity.x = kNan; }},
        {"zero mass", "mass", [](Scenario& s) { s.bodies[1].massProperties.mass = 0.0; }},
        {"negative mass", "mass", [](Scenario& s) { s.bodies[1].massProperties.mass = -1.0; }},
        {"zero inertia", "inertia", [](Scenario& s) { s.bodies[1].massProperties.inertia = {}; }},
        {"indefinite inertia", "inertia",
         [](Scenario& s) {
             s.bodies[1].massProperties.inertia(0, 1) = s.bodies[1].massProperties.inertia(1, 0) = 1.0;
         }},
        {"asymmetric inertia", "inertia",
         [](Scenario& s) { s.bodies[1].massProperties.inertia(0, 1) = 0.05; }},
        {"zero quaternion", "orientation",
         [](Scenario& s) {
             s.bodies[1].pose.orientation = {0, 0, 0, 0};
         }},
        {"long quaternion", "orientation",
         [](Scenario& s) {
             s.bodies[1].pose.orientation = {2, 0, 0, 0};
         }},
        {"zero radius", "radius", [](Scenario& s) { s.bodies[1].shapes[0].geometry = Sphere{0.0}; }},
        {"flat box", "half_extents",
         [](Scenario& s) {
             s.bodies[1].shapes[0].geometry = Box{{1, 1, 0}};
         }},
        {"negative capsule", "half_length",
         [](Scenario& s) {
             s.bodies[1].shapes[0].geometry = Capsule{0.1, -1.0};
         }},
        {"empty hull", "vertices", [](Scenario& s) { s.bodies[1].shapes[0].geometry = ConvexHull{}; }},
        {"flat hull", "volume",
         [](Scenario& s) {
             s.bodies[1].shapes[0].geometry = ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
         }},
        {"half-space that moves", "half-spaces",
         [](Scenario& s) { s.bodies[1].shapes[0].geometry = HalfSpace{}; }},
        {"long normal", "normal",
         [](Scenario& s) {
             s.bodies[0].shapes[0].geometry = HalfSpace{{0, 2, 0}, 0.0};
         }},
        {"material out of range", "material", [](Scenario& s) { s.bodies[1].shapes[0].material = 3; }},
        {"negative friction", "friction", [](Scenario& s) { s.materials[0].friction = -0.1; }},
        {"static below kinetic friction", "static_friction",
         [](Scenario& s) {
             s.materials[0].friction = 0.5;
             s.materials[0].staticFriction = 0.4;
         }},
        {"negative rolling friction", "rolling_friction",
         [](Scenario& s) { s.materials[0].rollingFriction = -0.1; }},
        {"nan torsional friction", "torsional_friction",
         [](Scenario& s) { s.materials[0].torsionalFriction = kNan; }},
        {"torsional friction in 2D", "torsional_friction",
         [](Scenario& s) {
             s.dimension = 2;
             s.materials[0].torsionalFriction = 0.1;
         }},
        {"infinite belt", "surface_velocity",
         [](Scenario& s) { s.bodies[0].shapes[0].surfaceVelocity.linear.x = INFINITY; }},
        {"restitution above one", "restitution", [](Scenario& s) { s.materials[0].restitution = 1.1; }},
        {"joint to a body that is not there", "joint", [](Scenario& s) { s.joints[0].bodyB = 7; }},
        {"joint to itself", "itself", [](Scenario& s) { s.joints[0].bodyA = 1; }},
        {"rod without length", "length", [](Scenario& s) { s.joints[0].length = 0.0; }},
        {"axis without length", "axis",
         [](Scenario& s) {
             s.joints[0].axisA = {0, 0, 0};
         }},
        {"force on a body that is not there", "force",
         [](Scenario& s) { std::get<ConstantForce>(s.forces[0]).body = -1; }},
        {"negative stiffness", "spring",
         [](Scenario& s) { std::get<SpringForce>(s.forces[1]).stiffness = -1.0; }},
        {"nan drag", "drag", [](Scenario& s) { std::get<DragForce>(s.forces[2]).coefficient = kNan; }},
        {"nan impulse", "event", [](Scenario& s) { s.events[0].impulse.x = kNan; }},
        {"damping that adds energy", "kept", [](Scenario& s) { s.bodies[1].linearVelocityKept = 1.5; }}};
    return table;
}

TEST(InputCheck, GoodInputPasses) {
    EXPECT_NO_THROW(checkScenarioInput(goodScenario(), 0.01));
}

TEST(InputCheck, EveryFaultIsRefusedByName) {
    for (const Fault& fault : faults()) {
        Scenario s = goodScenario();
        fault.plant(s);
        try {
            checkScenarioInput(s, 0.01);
            ADD_FAILURE() << fault.name << " was accepted";
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find(fault.mentions), std::string::npos)
                << fault.name << ": " << error.what();
        }
    }
}

TEST(InputCheck, TimeStepsOutOfRangeAreRefused) {
    for (const double dt : {0.0, -0.01, 2.0, 1e-9, kNan, static_cast<double>(INFINITY)})
        EXPECT_THROW(checkScenarioInput(goodScenario(), dt), BadInput) << dt;
}

TEST(InputCheck, StaticBodiesNeedNoMass) {
    Scenario s = goodScenario();
    s.bodies[0].massProperties = {};
    EXPECT_NO_THROW(checkScenarioInput(s, 0.01));
}

TEST(Supported, TheFirstThingMissingIsNamed) {
    Capabilities c;
    c.dynamics = true;
    c.dimensions = {3};
    c.shapes = {"half_space", "sphere"};
    c.joints = {"distance"};
    const Scenario good = goodScenario();
    EXPECT_NO_THROW(checkSupported(good, c, "toy"));
    const auto refuses = [&](const char* what, auto&& change) {
        Scenario s = good;
        change(s);
        try {
            checkSupported(s, c, "toy");
            ADD_FAILURE() << what;
        } catch (const Unsupported& error) {
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    refuses("static friction",
            [](Scenario& s) { s.materials[0].staticFriction = s.materials[0].friction + 1; });
    refuses("rolling friction", [](Scenario& s) { s.materials[0].rollingFriction = 0.1; });
    refuses("torsional friction", [](Scenario& s) { s.materials[0].torsionalFriction = 0.1; });
    refuses("velocity of a surface", [](Scenario& s) {
        s.bodies[0].shapes[0].surfaceVelocity.linear = {1, 0, 0};
    });
    refuses("capsule", [](Scenario& s) { s.bodies[1].shapes[0].geometry = Capsule{0.1, 0.2}; });
    refuses("hinge", [](Scenario& s) { s.joints[0].type = JointType::Hinge; });
    refuses("2D", [](Scenario& s) { s.dimension = 2; });
    refuses("kinematic", [](Scenario& s) { s.bodies[1].type = BodyType::Kinematic; });
    refuses("damping", [](Scenario& s) { s.bodies[1].linearVelocityKept = 0.5; });
    refuses("gravity", [](Scenario& s) { s.bodies[1].gravityScale = 0.5; });
    refuses("centre of mass", [](Scenario& s) { s.bodies[1].massProperties.centerOfMass = {0.1, 0, 0}; });
}

/// Without shapes an engine runs what can touch nothing for good.
TEST(Supported, AnEngineWithoutShapesRunsWhatCanTouchNothing) {
    Capabilities c;
    c.dynamics = true;
    c.dimensions = {3};
    c.joints = {"distance", "distance.break"};
    Scenario s = goodScenario();
    s.joints[0].collideConnected = false;
    s.joints[0].bodyA = 0;
    s.joints[0].bodyB = 1;
    s.bodies.resize(2);
    EXPECT_NO_THROW(checkSupported(s, c, "toy"));
    s.joints[0].breakForce = 10.0;
    EXPECT_THROW(checkSupported(s, c, "toy"), Unsupported) << "the joint keeps them apart until it breaks";
    s.joints.clear();
    try {
        checkSupported(s, c, "toy");
        ADD_FAILURE() << "two bodies that touch";
    } catch (const Unsupported& refused) {
        EXPECT_TRUE(refused.lacking().starts_with("rigid contact of shape '")) << refused.what();
    }
    s.bodies[0].collides = false;
    s.materials[0].rollingFriction = 0.1;
    EXPECT_NO_THROW(checkSupported(s, c, "toy")) << "coefficients of surfaces that touch nothing";
}

TEST(Supported, ARefusalSaysWhoLacksIt) {
    Capabilities c;
    c.dynamics = true;
    c.dimensions = {3};
    c.shapes = {"half_space", "sphere"};
    const auto refusedFor = [&](const Scenario& s) {
        try {
            checkSupported(s, c, "toy");
        } catch (const Unsupported& error) {
            return error;
        }
        return Unsupported("nothing was refused");
    };
    const Unsupported adapters = refusedFor(goodScenario());
    EXPECT_EQ(adapters.refusal(), Refusal::NotInAdapter);
    EXPECT_STREQ(adapters.what(), "toy: not in the adapter yet: joint 'distance' for joint 'rod'");
    EXPECT_EQ(adapters.lacking(), "joint 'distance'");
    EXPECT_EQ(adapters.documentation(), "");

    c.libraryLacks = {{"distance", "toy.h, joints"}, {"2D", "manual, chapter 1"}};
    const Unsupported librarys = refusedFor(goodScenario());
    EXPECT_EQ(librarys.refusal(), Refusal::NotInLibrary);
    EXPECT_STREQ(
        librarys.what(),
        "toy: the library has no joint 'distance' for joint 'rod' (its documentation: toy.h, joints)");
    EXPECT_EQ(librarys.documentation(), "toy.h, joints");

    // A joint that is there, with something that is documented not to be, and with something that is not.
    c.joints = {"distance"};
    c.libraryLacks = {{"distance.break", "toy.h, strength"}};
    Scenario s = goodScenario();
    s.joints[0].breakForce = 5.0;
    EXPECT_EQ(refusedFor(s).refusal(), Refusal::NotInLibrary);
    s.joints[0].breakForce = 1e300;
    s.joints[0].axes[0].stiffness = 3.0;
    EXPECT_EQ(refusedFor(s).refusal(), Refusal::NotInAdapter);
    EXPECT_THROW((void)notInLibrary("toy", "shape", ""), std::logic_error) << "without a document";
}

TEST(Missing, IsWhatTheFormatHasAndNoEngineClaims) {
    Capabilities c;
    c.dynamics = true;
    c.dimensions = {2};
    c.shapes = {"circle", "box", "capsule", "polygon", "half_plane"};
    c.joints = {"ball", "ball.break", "hinge", "slider", "slider.limit", "fixed", "wheel"};
    c.libraryLacks = {{"six_dof", "a"}, {"segment", "b"}, {"distance", "c"}, {"wheel.motor", "d"}};
    EXPECT_EQ(notInAdapterYet(c),
              (std::vector<std::string>{"chain", "hinge.limit", "hinge.motor", "hinge.spring", "hinge.break",
                                        "slider.motor", "slider.spring", "slider.break", "fixed.break",
                                        "wheel.limit", "wheel.spring", "wheel.break"}));
    c.dynamics = false;
    c.collision = true;
    EXPECT_EQ(notInAdapterYet(c), std::vector<std::string>{"chain"});
    c.planar = true;
    c.dimensions = {3};
    EXPECT_EQ(notInAdapterYet(c),
              (std::vector<std::string>{"chain", "sphere", "hull", "half_space", "cylinder", "cone",
                                        "triangle_mesh", "height_field", "ellipsoid"}));
    c.collision = false;
    EXPECT_TRUE(notInAdapterYet(c).empty());
}

TEST(Planar, ShapesBecomeSolidsAroundThePlane) {
    Scenario s;
    s.dimension = 2;
    s.materials.push_back({"stuff", 0.5, 0.0, 1.0});
    Body body;
    body.name = "body";
    body.shapes = {{Box{{0.3, 0.2, 0.0}}, {}, 0},
                   {ConvexHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {}, 0},
                   {Sphere{0.5}, {}, 0}};
    body.massProperties = massPropertiesFromShapes(body.shapes, s.materials, 2);
    s.bodies = {body};
    const Scenario lifted = planarLift(s);
    EXPECT_EQ(lifted.dimension, 3);
    const auto& box = std::get<Box>(lifted.bodies[0].shapes[0].geometry);
    EXPECT_EQ(box.halfExtents, (Vec3{0.3, 0.2, kPlanarHalfDepth}));
    EXPECT_EQ(std::get<ConvexHull>(lifted.bodies[0].shapes[1].geometry).vertices.size(), 6u);
    EXPECT_EQ(std::get<Sphere>(lifted.bodies[0].shapes[2].geometry).radius, 0.5);
    // A disc keeps the inertia of a disc, although it is a sphere now.
    EXPECT_EQ(lifted.bodies[0].massProperties.mass, body.massProperties.mass);
    EXPECT_EQ(lifted.bodies[0].massProperties.inertia(2, 2), body.massProperties.inertia(2, 2));
    EXPECT_NO_THROW(checkScenarioInput(lifted, 0.01));
    EXPECT_THROW((void)planarGeometry(HeightField{}), std::invalid_argument);
}

TEST(Planar, ChainsBecomeStripsOfTriangles) {
    const Chain open{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, false}, loop{open.vertices, true};
    EXPECT_EQ(std::get<TriangleMesh>(planarGeometry(Segment{{0, 0, 0}, {1, 0, 0}})).triangles.size(), 2u);
    EXPECT_EQ(std::get<TriangleMesh>(planarGeometry(open)).triangles.size(), 4u);
    const auto closed = std::get<TriangleMesh>(planarGeometry(loop));
    ASSERT_EQ(closed.triangles.size(), 6u);
    // Every triangle stands over one segment of the chain: its points are two vertices of it, at both depths.
    for (const auto& triangle : closed.triangles) {
        std::set<std::pair<double, double>> columns;
        std::set<double> depths;
        for (const int i : triangle) {
            const Vec3& v = closed.vertices[i];
            columns.insert({v.x, v.y});
            depths.insert(v.z);
        }
        EXPECT_EQ(columns.size(), 2u);
        EXPECT_EQ(depths, (std::set<double>{-kPlanarHalfDepth, kPlanarHalfDepth}));
    }
}

TEST(Planar, TheAngleOfASixDofIsItsSwingAboutZ) {
    Scenario s;
    s.dimension = 2;
    Joint joint;
    joint.type = JointType::SixDof;
    joint.axisA = {0.6, 0.8, 0};
    joint.axes[0].motorSpeed = 1.0;
    joint.axes[2].motorSpeed = 3.0;
    s.joints = {joint};
    const Joint lifted = planarLift(s).joints[0];
    EXPECT_EQ(lifted.axes[0].motorSpeed, 1.0);
    EXPECT_EQ(lifted.axes[2].motorSpeed, 0.0);
    EXPECT_EQ(lifted.axes[5].motorSpeed, 3.0);
    EXPECT_EQ(cross(lifted.axisA, lifted.normalA), (Vec3{0, 0, 1}));
}

}  // namespace
}  // namespace rigor::adapter
