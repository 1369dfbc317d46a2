// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Declarations of an adapter about itself and its world, and its refusals.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/presets.hpp"

namespace rigor::conformance {
namespace {

using scenario::Box;
using scenario::Capsule;
using scenario::Cone;
using scenario::ConvexHull;
using scenario::Cylinder;
using scenario::HalfSpace;
using scenario::Segment;
using scenario::Sphere;

TEST(Describe, FacesAndCapabilitiesAgree) {
    const auto info = engine().info();
    const auto capabilities = engine().capabilities();
    EXPECT_EQ(info.name, engineSpec().engine);
    EXPECT_FALSE(info.version.empty());
    EXPECT_FALSE(info.title.empty());
    EXPECT_TRUE(info.precision == "f32" || info.precision == "f64") << info.precision;
    EXPECT_EQ(capabilities.dynamics, engine().dynamics() != nullptr);
    EXPECT_EQ(capabilities.collision, engine().collision() != nullptr);
    EXPECT_EQ(capabilities.broadPhase, engine().broadPhase() != nullptr);
    EXPECT_EQ(capabilities.contactSolvers, engine().contactSolvers() != nullptr);
    EXPECT_FALSE(queryDimensions().empty());
}

TEST(Describe, EveryOptionTakesItsOwnDefaults) {
    const auto own = adapter::ownPresets(engine());
    std::set<std::string> keys;
    for (const auto& option : engine().options()) {
        SCOPED_TRACE(option.key);
        EXPECT_TRUE(keys.insert(option.key).second) << "listed twice";
        EXPECT_NE(option.key, "preset");
        EXPECT_FALSE(option.help.empty());
        for (const auto& preset : adapter::presetNames(own)) {
            const auto& value = adapter::presetValue(option, preset, own);
            auto spec = engineSpec();
            spec.options[option.key] = value;
            EXPECT_EQ(adapter::resolveSettings(spec, engine()).at(option.key), value);
        }
    }
}

TEST(Describe, FurtherPresetsHaveNamesAndKeysOfTheirOwn) {
    std::set<std::string> names{"default", "matched"}, keys;
    for (const auto& option : engine().options()) keys.insert(option.key);
    for (const auto& preset : adapter::ownPresets(engine())) {
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name << " is there twice";
        EXPECT_FALSE(preset.values.empty()) << preset.name;
        for (const auto& [key, value] : preset.values)
            EXPECT_TRUE(keys.contains(key)) << preset.name << ": " << key << " is no option";
    }
}

class Build : public DynamicsTest {
  protected:
    /// Boxes that fall on each other and on the ground.
    Scenario pile(double shift) const {
        Scenario s = scene(0.4, 0.3);
        s.gravity = {0, -9.81, 0};
        addStatic(s, block({5, 1, 5}), {0, -1, 0});
        s.bodies[0].collides = hasShape("box");
        for (int i = 0; i < 5; ++i)
            addBody(s, block({0.3, 0.2, 0.25}), flat({0.15 * (i % 2) + shift, 0.3 + 0.5 * i, 0.05 * i}),
                    1.0 + i, boxMoments(1.0 + i, {0.3, 0.2, 0.25}));
        return s;
    }
    static std::vector<BodyState> statesOf(const adapter::World& world, const Scenario& s) {
        std::vector<BodyState> states(s.bodies.size());
        world.readStates(states);
        return states;
    }
    static void expectSameBits(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
        ASSERT_EQ(a.size(), b.size());
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(BodyState)), 0);
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Build, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Build);

/// Libraries that add shapes one by one reckon the inertia anew with each of them.
TEST_P(Build, InertiaIsTheGivenOneWithManyShapes) {
    if (!hasShape(is2d() ? "circle" : "sphere")) GTEST_SKIP() << "no balls";
    Scenario s = scene();
    const int b = addBody(s, ball(0.02), {0.1, 0, 0}, 1.5, {0.05, 0.08, 0.05});
    Body& body = s.bodies[b];
    for (int k = 1; k < 12; ++k) {
        const double angle = 0.2 + k * 0.5236;
        const Vec3 around =
            is2d() ? Vec3{std::cos(angle), std::sin(angle), 0} : Vec3{std::cos(angle), 0.2, std::sin(angle)};
        body.shapes.push_back({ball(0.02), {0.1 * around, {}}, 0});
    }
    const auto read = build(s, 0.01)->readBack().bodies[b];
    for (int r = is2d() ? 2 : 0; r < 3; ++r)
        for (int c = is2d() ? 2 : 0; c < 3; ++c)
            EXPECT_NEAR(read.inertia(r, c), body.massProperties.inertia(r, c), tol(1e-13, 1e-7))
                << r << "," << c;
}

TEST_P(Build, ReadBackIsTheScenario) {
    Scenario s = scene(0.3, 0.2);
    s.gravity = {0.5, -9.81, 0.0};
    s.materials.push_back({"other", 0.6, 0.8, 500.0});
    s.pairs.push_back({0, 1, 0.45, 0.15});
    const bool touching = hasShape("box") && hasShape(is2d() ? "circle" : "sphere");
    addStatic(s, block({5, 1, 5}), {0, -1, 0});
    s.bodies[0].collides = touching;
    addBody(s, block({0.3, 0.2, 0.4}), flat({1, 2, 3}), 2.0, {0.2, 0.3, 0.4});
    addBody(s, ball(0.4), flat({-1, 2, 1}), 3.0, {0.5, 0.5, 0.5});
    s.bodies[2].shapes[0].material = 1;
    Body& turned = s.bodies[1];
    turned.pose.orientation =
        is2d() ? fromAxisAngle({0, 0, 1}, -0.8) : fromAxisAngle(Vec3{1, -2, 2} / 3.0, 0.8);
    turned.velocity = flat({0.1, -0.2, 0.3});
    turned.angularVelocity = is2d() ? Vec3{0, 0, 0.7} : Vec3{0.4, -0.5, 0.6};
    if (!is2d()) {
        const Mat3 axes = toMatrix(fromAxisAngle({0, 0.6, 0.8}, 0.5));
        turned.massProperties.inertia = axes * turned.massProperties.inertia * transpose(axes);
    }
    if (engine().capabilities().centerOfMassOffset)
        turned.massProperties.centerOfMass = flat({0.05, -0.1, 0.02});
    if (engine().capabilities().gravityScale) s.bodies[2].gravityScale = 0.5;
    const auto back = build(s, 0.01)->readBack();
    ASSERT_EQ(back.bodies.size(), s.bodies.size());
    const double eps = tol(1e-12, 1e-5);
    EXPECT_EQ(back.bodies[0].mass, 0.0);
    for (std::size_t i = 1; i < s.bodies.size(); ++i) {
        SCOPED_TRACE(s.bodies[i].name);
        const Body& body = s.bodies[i];
        const auto& read = back.bodies[i];
        EXPECT_NEAR(read.mass, body.massProperties.mass, eps * body.massProperties.mass);
        EXPECT_LE(norm(read.centerOfMass - body.massProperties.centerOfMass), eps);
        for (int r = is2d() ? 2 : 0; r < 3; ++r)
            for (int c = is2d() ? 2 : 0; c < 3; ++c)
                EXPECT_NEAR(read.inertia(r, c), body.massProperties.inertia(r, c), eps) << r << "," << c;
        EXPECT_LE(norm(read.state.position - body.pose.position), 4 * eps);
        EXPECT_LE(angleBetween(read.state.orientation, body.pose.orientation), tol(1e-7, 1e-3));
        EXPECT_LE(norm(read.state.velocity - body.velocity), eps);
        EXPECT_LE(norm(read.state.angularVelocity - body.angularVelocity), eps);
        EXPECT_LE(norm(read.gravity - body.gravityScale * s.gravity), 10 * eps);
    }
    std::set<std::pair<int, int>> listedPairs;
    for (const auto& pair : back.pairs) {
        const auto expected = scenario::pairCoefficients(s, pair.materialA, pair.materialB);
        EXPECT_NEAR(pair.friction, expected.friction, 1e-6);
        EXPECT_NEAR(pair.restitution, expected.restitution, 1e-6);
        listedPairs.insert(std::minmax(pair.materialA, pair.materialB));
    }
    if (!touching) return;
    EXPECT_TRUE(listedPairs.contains({0, 0}) && listedPairs.contains({0, 1}))
        << "pairs that can meet are read back";
}

TEST_P(Build, TheLedgerExplainsWhatDiffers) {
    Scenario s = scene();
    addBody(s, ball(0.5), {});
    const auto lines = build(s, 0.01)->ledger();
    EXPECT_FALSE(lines.empty());
    std::set<std::string> topics;
    for (const auto& line : lines) {
        SCOPED_TRACE(line.topic);
        EXPECT_TRUE(topics.insert(line.topic).second) << "listed twice";
        EXPECT_FALSE(line.topic.empty() || line.resolved.empty());
        EXPECT_EQ(line.reason.empty(), line.realisation == adapter::Realisation::Exact);
    }
}

TEST_P(Build, StepsRepeatBitForBitAndWorldsDoNotMeet) {
    const Scenario s = pile(0.0), other = pile(0.11);
    auto alone = build(s, 1.0 / 120.0);
    run(*alone, 150);
    auto interleaved = build(s, 1.0 / 120.0), neighbour = build(other, 1.0 / 120.0);
    for (int i = 0; i < 150; ++i) {
        interleaved->step();
        neighbour->step();
    }
    expectSameBits(statesOf(*alone, s), statesOf(*interleaved, s));
}

/// An engine that has served other cases gives the bits of one that has not: a guest is a fresh process here, so a run
/// may keep one for many cases (`keep_alive` of its manifest).
TEST_P(Build, AnEngineThatServedOthersGivesTheBitsOfAFreshOne) {
    const Scenario s = pile(0.0);
    run(*build(pile(0.11), 1.0 / 60.0), 100);
    Scenario refused = pile(0.05);
    refused.bodies[1].shapes[0].material = 99;
    EXPECT_ANY_THROW(build(refused, 0.01));
    if (hasJoint("ball")) {
        Scenario hanging = pile(3.0);
        Joint joint;
        joint.type = JointType::Ball;
        joint.bodyB = 1;
        joint.anchorA = hanging.bodies[1].pose.position;
        hanging.joints.push_back(joint);
        run(*build(hanging, 1.0 / 240.0), 50);
    }
    auto used = build(s, 1.0 / 120.0);
    const adapter::LoadedEngine unused = adapter::loadEngine(engineSpec());
    auto fresh = buildIn(*unused, s, 1.0 / 120.0);
    for (int i = 0; i < 10; ++i) {
        run(*used, 15);
        run(*fresh, 15);
        expectSameBits(statesOf(*used, s), statesOf(*fresh, s));
    }
}

/// A refusal is the library's where Capabilities has a document for it, and only there.
void expectKindDeclared(const adapter::Unsupported& refused, const std::string& name) {
    const auto lacks = engine().capabilities().libraryLacks;
    const auto declared = lacks.find(name);
    EXPECT_EQ(refused.refusal() == adapter::Refusal::NotInLibrary, declared != lacks.end()) << refused.what();
    if (declared != lacks.end()) {
        EXPECT_EQ(refused.documentation(), declared->second);
    }
}

/// An engine has a shape where it builds it, or refuses it for a setting of this spec that it names: "with KEY=VALUE".
void expectShapeBuilds(const std::function<void()>& build) {
    try {
        build();
    } catch (const adapter::Unsupported& refused) {
        EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInLibrary) << refused.what();
        const auto options = engine().options();
        EXPECT_TRUE(std::any_of(options.begin(), options.end(), [&](const adapter::Option& option) {
            return refused.lacking().find(" with " + option.key + "=") != std::string::npos;
        })) << refused.what();
    }
}

TEST_P(Build, WhatTheEngineLacksIsRefusedByName) {
    using scenario::Chain, scenario::HeightField;
    const scenario::TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}}};
    const std::pair<const char*, Geometry> shapes[] = {
        {is2d() ? "circle" : "sphere", Sphere{0.5}},
        {"box", block({0.5, 0.5, 0.5})},
        {"capsule", Capsule{0.2, 0.3}},
        {"cylinder", Cylinder{0.2, 0.3}},
        {"cone", Cone{0.2, 0.3}},
        {is2d() ? "half_plane" : "half_space", HalfSpace{}},
        {"segment", Segment{{-1, 0, 0}, {1, 0, 0}}},
        {"chain", Chain{{{-1, 0, 0}, {0, 0, 0}, {1, 1, 0}}, false}},
        {"ellipsoid", scenario::Ellipsoid{{0.2, 0.3, 0.4}}},
        {"triangle_mesh", mesh},
        {"height_field", HeightField{2, 2, 1, 1, {0, 0, 0, 1}, 1}}};
    for (const auto& [name, geometry] : shapes) {
        const std::string kind = name;
        const bool only3d = kind == "cylinder" || kind == "cone" || kind == "ellipsoid" ||
                            kind == "triangle_mesh" || kind == "height_field";
        if (is2d() ? only3d : kind == "segment" || kind == "chain") continue;
        SCOPED_TRACE(name);
        Scenario s = scene();
        addStatic(s, geometry);
        addBody(s, ball(0.1), {0, 3, 0});
        s.bodies.back().collides = true;
        if (hasShape(name)) {
            expectShapeBuilds([&] { build(s, 0.01)->step(); });
            continue;
        }
        try {
            build(s, 0.01);
            ADD_FAILURE() << "built without the shape";
        } catch (const adapter::Unsupported& refused) {
            EXPECT_NE(std::string(refused.what()).find(name), std::string::npos) << refused.what();
            expectKindDeclared(refused, name);
        }
    }
    for (const auto type :
         {JointType::Ball, JointType::Hinge, JointType::Slider, JointType::Fixed, JointType::Distance}) {
        if (hasJoint(jointName(type))) continue;
        SCOPED_TRACE(jointName(type));
        Scenario s = scene();
        addBody(s, ball(0.1), {});
        Joint joint;
        joint.type = type;
        joint.bodyB = 0;
        joint.length = 1.0;
        s.joints.push_back(joint);
        try {
            build(s, 0.01);
            ADD_FAILURE() << "built without the joint";
        } catch (const adapter::Unsupported& refused) {
            EXPECT_NE(std::string(refused.what()).find(jointName(type)), std::string::npos) << refused.what();
            expectKindDeclared(refused, jointName(type));
        }
    }
    const auto dimensions = queryDimensions();
    for (const int dimension : {2, 3}) {
        if (std::count(dimensions.begin(), dimensions.end(), dimension) != 0) continue;
        Scenario s = scene();
        s.dimension = dimension;
        addBody(s, ball(0.1), {});
        s.bodies[0].massProperties.inertia = Mat3::diagonal(0.1, 0.1, 0.1);
        try {
            build(s, 0.01);
            ADD_FAILURE() << "built without the dimension";
        } catch (const adapter::Unsupported& refused) {
            expectKindDeclared(
                refused, engine().capabilities().dynamics ? std::to_string(dimension) + "D" : "dynamics");
        }
    }
}

TEST_P(Build, NothingIsBothThereAndDocumentedToBeLacking) {
    const adapter::Capabilities c = engine().capabilities();
    for (const auto& [name, documentation] : c.libraryLacks) {
        EXPECT_FALSE(documentation.empty()) << name;
        EXPECT_FALSE(hasShape(name.c_str()) || hasJoint(name.c_str())) << name;
    }
}

TEST_P(Build, InputThatMustNotReachALibraryIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = INFINITY;
    using Spoil = std::function<void(Scenario&)>;
    const std::pair<const char*, Spoil> defects[] = {
        {"position NaN", [&](Scenario& s) { s.bodies[0].pose.position.y = nan; }},
        {"velocity infinite", [&](Scenario& s) { s.bodies[0].velocity.x = inf; }},
        {"angular velocity NaN", [&](Scenario& s) { s.bodies[0].angularVelocity.z = nan; }},
        {"orientation zero",
         [&](Scenario& s) {
             s.bodies[0].pose.orientation = {0, 0, 0, 0};
         }},
        {"orientation not unit",
         [&](Scenario& s) {
             s.bodies[0].pose.orientation = {2, 0, 0, 0};
         }},
        {"mass zero", [&](Scenario& s) { s.bodies[0].massProperties.mass = 0.0; }},
        {"mass negative", [&](Scenario& s) { s.bodies[0].massProperties.mass = -1.0; }},
        {"mass NaN", [&](Scenario& s) { s.bodies[0].massProperties.mass = nan; }},
        {"inertia zero", [&](Scenario& s) { s.bodies[0].massProperties.inertia = {}; }},
        {"inertia negative",
         [&](Scenario& s) { s.bodies[0].massProperties.inertia = Mat3::diagonal(1, 1, -1); }},
        {"gravity NaN", [&](Scenario& s) { s.gravity.y = nan; }},
        {"radius zero", [&](Scenario& s) { s.bodies[0].shapes[0].geometry = Sphere{0.0}; }},
        {"radius negative", [&](Scenario& s) { s.bodies[0].shapes[0].geometry = Sphere{-1.0}; }},
        {"box flat",
         [&](Scenario& s) {
             s.bodies[0].shapes[0].geometry = Box{{0.5, 0.0, 0.5}};
         }},
        {"capsule NaN",
         [&](Scenario& s) {
             s.bodies[0].shapes[0].geometry = Capsule{0.1, nan};
         }},
        {"hull empty", [&](Scenario& s) { s.bodies[0].shapes[0].geometry = ConvexHull{}; }},
        {"hull on a line",
         [&](Scenario& s) {
             s.bodies[0].shapes[0].geometry = ConvexHull{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}};
         }},
        {"material unknown", [&](Scenario& s) { s.bodies[0].shapes[0].material = 7; }},
        {"damping zero", [&](Scenario& s) { s.bodies[0].linearVelocityKept = 0.0; }},
        {"joint to no body",
         [&](Scenario& s) {
             Joint joint;
             joint.type = JointType::Hinge;
             joint.bodyB = 9;
             s.joints.push_back(joint);
         }},
    };
    for (const auto& [what, inject] : defects) {
        SCOPED_TRACE(what);
        Scenario s = scene();
        addBody(s, ball(0.5), {});
        inject(s);
        EXPECT_THROW(build(s, 0.01), adapter::BadInput);
    }
    Scenario s = scene();
    addBody(s, ball(0.5), {});
    for (const double dt : {0.0, -0.01, nan, inf}) {
        SCOPED_TRACE(dt);
        EXPECT_THROW(build(s, dt), adapter::BadInput);
    }
}

}  // namespace
}  // namespace rigor::conformance
