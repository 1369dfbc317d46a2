// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Error messages for bad files: a good file with one defect each, and the whole first message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/schema_check.hpp"

namespace rigor::scenario {
namespace {

const std::string kGood = R"({
  "rigor": 1,
  "name": "base",
  "title": "A base to break",
  "dimension": 3,
  "gravity": [0, -9.81, 0],
  "duration": 1,
  "dt": [0.01],
  "materials": { "wood": { "friction": 0.5, "restitution": 0 } },
  "bodies": [
    { "name": "floor", "type": "static", "position": [0, -0.5, 0],
      "shapes": [ { "box": { "half_extents": [5, 0.5, 5] } } ] },
    { "name": "block", "mass": 2, "position": [0, 0.5, 0], "orientation": [1, 0, 0, 0],
      "shapes": [ { "sphere": { "radius": 0.25 }, "material": "wood" } ] }
  ],
  "joints": [
    { "name": "pivot", "type": "hinge", "a": "world", "b": "block",
      "anchor": [0, 1, 0], "axis": [0, 0, 1] }
  ],
  "forces": [ { "drag": { "body": "block", "coefficient": 0.5 } } ],
  "reference": { "physical_pendulum": { "body": "block" } },
  "accept": { "rigor": { "position_final": 0.01 } }
}
)";

struct BrokenFile {
    const char* name;
    const char* from;
    const char* to;
    const char* message;
};

// clang-format off
const BrokenFile kBrokenFiles[] = {
    {"NotJson", R"("duration": 1,)", R"("duration": 1,,)",
     R"(bad.json:7: (document): found line 7, column 17: syntax error while parsing object key - unexpected ','; expected string literal, expected JSON (RFC 8259) [json.syntax])"},
    {"Truncated", R"(  "accept": { "rigor": { "position_final": 0.01 } }
}
)",
     R"()",
     R"(bad.json:22: (document): found line 22, column 1: syntax error while parsing object key - unexpected end of input; expected string literal, expected JSON (RFC 8259) [json.syntax])"},
    {"NumberTooLarge", R"("duration": 1,)", R"("duration": 1e999,)",
     R"(bad.json:7: (document): found number overflow parsing '1e999', expected numbers in double range [json.number])"},
    {"NotANumber", R"("duration": 1,)", R"("duration": NaN,)",
     R"(bad.json:7: (document): found line 7, column 15: syntax error while parsing value - invalid literal; last read: '"duration": N', expected JSON (RFC 8259) [json.syntax])"},
    {"DuplicateKey", R"("mass": 2,)", R"("mass": 2, "mass": 3,)",
     R"(bad.json:13: /bodies/1/mass: found the key 'mass' a second time, expected each key once [json.duplicate_key])"},
    {"UnknownKey", R"("mass": 2,)", R"("masss": 2,)",
     R"(bad.json:13: /bodies/1/masss: found the key 'masss', expected one of name, type, position, orientation, axis_angle_deg, angle, angle_deg, velocity, angular_velocity, mass, inertia, center_of_mass, shapes, material, collides, damping, gravity_scale, layers, collides_with, group [schema.unknown_key])"},
    {"MissingKey", R"(  "duration": 1,
)",
     R"()",
     R"(bad.json:1: (document): found no key 'duration', expected the key 'duration' [schema.missing_key])"},
    {"WrongType", R"("duration": 1,)", R"("duration": "1 s",)",
     R"(bad.json:7: /duration: found string "1 s", expected number from 1e-06 to 3600 [schema.type])"},
    {"NegativeDuration", R"("duration": 1,)", R"("duration": -1,)",
     R"(bad.json:7: /duration: found number -1, expected number from 1e-06 to 3600 [value.range])"},
    {"StepLongerThanRun", R"("dt": [0.01])", R"("dt": [2.0])",
     R"(bad.json:8: /dt/0: found number 2.0, expected number from 1e-07 to 1 [value.range])"},
    {"ZeroStep", R"("dt": [0.01])", R"("dt": [0])",
     R"(bad.json:8: /dt/0: found number 0, expected number from 1e-07 to 1 [value.range])"},
    {"NoStep", R"("dt": [0.01])", R"("dt": [])",
     R"(bad.json:8: /dt: found array of 0, expected at least one time step [value.range])"},
    {"FutureVersion", R"("rigor": 1)", R"("rigor": 2)",
     R"(bad.json:2: /rigor: found number 2, expected 1, the version of this format [schema.version])"},
    {"FourDimensions", R"("dimension": 3)", R"("dimension": 4)",
     R"(bad.json:5: /dimension: found number 4, expected integer from 2 to 3 [value.range])"},
    {"PlanarVector", R"("gravity": [0, -9.81, 0])", R"("gravity": [0, -9.81])",
     R"(bad.json:6: /gravity: found array of 2, expected array of 3 numbers [schema.type])"},
    {"NegativeRadius", R"("radius": 0.25)", R"("radius": -0.25)",
     R"(bad.json:14: /bodies/1/shapes/0/sphere/radius: found number -0.25, expected number > 0 [value.range])"},
    {"VanishingBox", R"("half_extents": [5, 0.5, 5])", R"("half_extents": [5, 1e-320, 5])",
     R"(bad.json:12: /bodies/0/shapes/0/box/half_extents/1: found number 1e-320, expected number from 1e-12 to 1e+15 [value.range])"},
    {"FlatBox", R"("half_extents": [5, 0.5, 5])", R"("half_extents": [5, 0, 5])",
     R"(bad.json:12: /bodies/0/shapes/0/box/half_extents/1: found number 0, expected number > 0 [value.range])"},
    {"ZeroMass", R"("mass": 2)", R"("mass": 0)",
     R"(bad.json:13: /bodies/1/mass: found number 0, expected number > 0 [value.range])"},
    {"ShortQuaternion", R"([1, 0, 0, 0])", R"([0.5, 0, 0, 0])",
     R"(bad.json:13: /bodies/1/orientation: found norm 0.500000, expected unit quaternion [w, x, y, z] [orientation.unit])"},
    {"UnknownMaterial", R"("material": "wood")", R"("material": "steel")",
     R"(bad.json:14: /bodies/1/shapes/0/material: found string "steel", expected a material of the file: wood [material.unknown])"},
    {"UnknownShape", R"("sphere": { "radius": 0.25 })", R"("ball": { "radius": 0.25 })",
     R"(bad.json:14: /bodies/1/shapes/0/ball: found the key 'ball', expected one of ellipsoid, sphere, circle, box, capsule, cylinder, cone, hull, polygon, half_space, half_plane, segment, chain, triangle_mesh, height_field, material, position, orientation, axis_angle_deg, angle, angle_deg, surface_velocity, layers, collides_with, group [schema.unknown_key])"},
    {"PlanarShape", R"("sphere")", R"("circle")",
     R"(bad.json:14: /bodies/1/shapes/0/circle: found the shape 'circle', expected one of sphere, box, capsule, cylinder, cone, ellipsoid, hull, half_space, triangle_mesh, height_field [shape.dimension])"},
    {"HalfSpaceMoves", R"("sphere": { "radius": 0.25 })", R"("half_space": { "normal": [0, 1, 0] })",
     R"(bad.json:14: /bodies/1/shapes/0: found a half_space on a moving body, expected a solid shape, or "type": "static" [shape.static])"},
    {"FlatHull", R"("sphere": { "radius": 0.25 })",
     R"("hull": { "vertices": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]] })",
     R"(bad.json:14: /bodies/1/shapes/0/hull/vertices: found the points have no volume, expected points that span a solid [shape.degenerate])"},
    {"SameName", R"("name": "block")", R"("name": "floor")",
     R"(bad.json:13: /bodies/1: found the name 'floor' a second time, expected each name once [body.duplicate])"},
    {"BodyCalledWorld", R"("name": "block")", R"("name": "world")",
     R"(bad.json:13: /bodies/1/name: found string "world", expected a name other than 'world', which joints use for the fixed frame [body.name])"},
    {"UnknownJointBody", R"("b": "block")", R"("b": "blok")",
     R"(bad.json:17: /joints/0/b: found string "blok", expected the name of a body of the file [body.unknown])"},
    {"UnknownJointType", R"("type": "hinge")", R"("type": "weld")",
     R"(bad.json:17: /joints/0/type: found string "weld", expected one of ball, hinge, slider, fixed, distance, cone_twist, six_dof, wheel [joint.type])"},
    {"HingeWithoutAxis", R"(, "axis": [0, 0, 1])", R"()",
     R"(bad.json:17: /joints/0: found no key 'axis', expected the world direction of the joint's axis [schema.missing_key])"},
    {"ZeroAxis", R"("axis": [0, 0, 1])", R"("axis": [0, 0, 0])",
     R"(bad.json:18: /joints/0/axis: found array of 3, expected vector that is not zero [value.direction])"},
    {"AnchorsApart", R"("anchor": [0, 1, 0])", R"("anchor_a": [0, 1, 0], "anchor_b": [0, 1, 0])",
     R"(bad.json:17: /joints/0: found anchors 0.500000 m apart, expected anchors that coincide at the start [joint.anchor])"},
    {"ForceOnStatic", R"("body": "block", "coefficient")", R"("body": "floor", "coefficient")",
     R"(bad.json:20: /forces/0/drag/body: found string "floor", expected a dynamic body [body.not_dynamic])"},
    {"TwoForcesInOne", R"("drag": {)", R"("constant": { "body": "block" }, "drag": {)",
     R"(bad.json:20: /forces/0: found object with 2 keys, expected one of constant, spring, drag [force.count])"},
    {"InertiaTriangle", R"("mass": 2,)", R"("mass": 2, "inertia": [1, 1, 3],)",
     R"(bad.json:13: /bodies/1/inertia: found array of 3, expected symmetric positive definite tensor whose largest principal moment is at most the sum of the others [body.inertia])"},
    {"InertiaNotPositive", R"("mass": 2,)", R"("mass": 2, "inertia": [1, 1, 0],)",
     R"(bad.json:13: /bodies/1/inertia: found array of 3, expected symmetric positive definite tensor whose largest principal moment is at most the sum of the others [body.inertia])"},
    {"StaticWithVelocity", R"("type": "static",)", R"("type": "static", "velocity": [1, 0, 0],)",
     R"(bad.json:11: /bodies/0: found a velocity on a static body, expected no velocity, or "type": "kinematic" [body.static])"},
    {"BadEngineKey", R"("rigor": { "position)", R"("rigor@fast": { "position)",
     R"(bad.json:22: /accept/rigor@fast: found the key 'rigor@fast', expected engine, engine@default, engine@matched or * [accept.engine])"},
    {"NegativeBound", R"("position_final": 0.01)", R"("position_final": -0.01)",
     R"(bad.json:22: /accept/rigor/position_final: found number -0.01, expected number from 0 to 1e+12 [value.range])"},
    {"LowerBoundAboveUpper", R"("position_final": 0.01)", R"("position_final": { "min": 2, "max": 1 })",
     R"(bad.json:22: /accept/rigor/position_final: found object with 2 keys, expected min not above max [accept.bound])"},
    {"TwoReferences", R"("reference": {)", R"("reference": { "at_rest": {},)",
     R"(bad.json:21: /reference: found object with 2 keys, expected an object with one key, the name of the reference, or "none" [reference.form])"},
    {"BadName", R"("name": "base")", R"("name": "base scene")",
     R"(bad.json:3: /name: found string "base scene", expected name of 1 to 64 letters, digits, '_', '-', '.' [value.name])"},
    {"HugeGenerator", R"("joints": [)",
     R"("generators": [ { "grid": { "name": "g", "counts": [1000, 1000, 1000], "spacing": [1, 1, 1], "body": {} } } ], "joints": [)",
     R"(bad.json:16: /generators/0/grid/counts: found array of 3, expected at most 200000 bodies [generator.size])"},
    {"UnknownGenerator", R"("joints": [)", R"("generators": [ { "tower": {} } ], "joints": [)",
     R"(bad.json:16: /generators/0: found object with 1 keys, expected an object with one key among grid, pyramid, pile, chain, container, group, hull_pile, net, rain, repeat, tumbler [generator.unknown])"},
};
// clang-format on

std::vector<Problem> problemsOf(const std::string& text) {
    try {
        (void)loadScenarioText(text, "bad.json");
    } catch (const LoadError& error) {
        return error.problems();
    }
    return {};
}

TEST(GoodFile, Loads) {
    const Scenario s = loadScenarioText(kGood, "good.json").scenario;
    EXPECT_EQ(s.bodies.size(), 2u);
    EXPECT_EQ(s.joints.size(), 1u);
    EXPECT_EQ(s.observed, std::vector<int>{1});
    EXPECT_EQ(s.reference->name, "physical_pendulum");
    ASSERT_EQ(s.accept.size(), 1u);
    EXPECT_EQ(s.accept[0].metric, "position_final");
}

class BadFile : public testing::TestWithParam<BrokenFile> {};

TEST_P(BadFile, SaysWhatWhereAndWhy) {
    std::string text = kGood;
    const auto place = text.find(GetParam().from);
    ASSERT_NE(place, std::string::npos);
    text.replace(place, std::string(GetParam().from).size(), GetParam().to);
    const auto problems = problemsOf(text);
    ASSERT_FALSE(problems.empty()) << "the file loaded";
    EXPECT_EQ(problems.front().text(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Table, BadFile, testing::ValuesIn(kBrokenFiles),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(BadFiles, EveryMistakeOfAFileIsNamed) {
    std::string text = kGood;
    const auto breakFile = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    breakFile("\"duration\": 1", "\"duration\": -1");
    breakFile("\"friction\": 0.5", "\"friction\": -0.5");
    breakFile("\"gravity\": [0, -9.81, 0]", "\"gravity\": 9.81");
    std::vector<std::string> pointers;
    for (const Problem& p : problemsOf(text)) pointers.push_back(p.pointer);
    EXPECT_THAT(pointers, testing::UnorderedElementsAre("/duration", "/gravity", "/materials/wood/friction"));
}

TEST(BadFiles, DeepNestingIsRefusedQuickly) {
    for (const char* bracket : {"[", "{\"a\":"}) {
        std::string text;
        for (int i = 0; i < 100000; ++i) text += bracket;
        const auto problems = problemsOf(text);
        ASSERT_EQ(problems.size(), 1u);
        EXPECT_EQ(problems[0].id, "json.depth");
    }
}

TEST(BadFiles, OddDocuments) {
    for (const char* text : {"", " ", "null", "3", "[]", "{}", "\"text\"", "{\"rigor\": 1}", "\xff\xfe",
                             "\xef\xbb\xbf", "{\"a\": \"\xc3\x28\"}", "[1, 2", "{\"a\" 1}"})
        EXPECT_FALSE(problemsOf(text).empty()) << text;
    EXPECT_FALSE(problemsOf(std::string("{\"rigor\": 1\0}", 13)).empty());
}

TEST(BadFiles, AGeneratorOfABillionBodiesIsRefusedAtOnce) {
    std::string text = kGood;
    const std::string from = "\"joints\"";
    text.replace(text.find(from), from.size(),
                 R"("generators": [{"pile": {"name": "p", "count": 1000000000, "seed": 1, "columns": 10,
                     "spacing": [1, 1, 1], "bodies": [{}]}}], "joints")");
    const auto start = std::chrono::steady_clock::now();
    const auto problems = problemsOf(text);
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].pointer, "/generators/0/pile/count");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(BadFiles, MissingFile) {
    try {
        (void)loadScenario("/nowhere/at/all.json");
        FAIL() << "loaded";
    } catch (const LoadError& error) {
        EXPECT_EQ(error.problems()[0].id, "file.unreadable");
    }
}

/// The published schema alone refuses what it can express; it is no decoration beside the reader.
TEST(Schema, RefusesByItself) {
    EXPECT_NO_THROW(checkScenarioSchema(parseDocument(kGood, "good.json"), "good.json"));
    for (const char* name :
         {"UnknownKey", "MissingKey", "WrongType", "NegativeDuration", "ZeroStep", "NoStep", "FutureVersion",
          "FourDimensions", "NegativeRadius", "ZeroMass", "UnknownShape", "UnknownJointType",
          "TwoForcesInOne", "NegativeBound", "TwoReferences", "BadName", "UnknownGenerator"}) {
        const auto* row = std::find_if(std::begin(kBrokenFiles), std::end(kBrokenFiles),
                                       [&](const BrokenFile& s) { return std::string(s.name) == name; });
        ASSERT_NE(row, std::end(kBrokenFiles)) << name;
        std::string text = kGood;
        text.replace(text.find(row->from), std::string(row->from).size(), row->to);
        EXPECT_THROW(checkScenarioSchema(parseDocument(text, "bad.json"), "bad.json"), LoadError) << name;
    }
}

}  // namespace
}  // namespace rigor::scenario
