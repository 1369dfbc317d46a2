// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files of collision queries: both formats, their conventions, and what is said of bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "scenarios/loader/collision_cases.hpp"

namespace rigor::scenario {
namespace {

std::filesystem::path written(const std::string& name, const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(file) << text;
    return file;
}

Problem problemOf(const std::string& name, const std::string& text) {
    try {
        (void)loadCollisionFile(written(name, text));
    } catch (const LoadError& error) {
        return error.problems().front();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
}

const std::string kLine =
    R"({"id": "x", "a": {"type": "sphere", "radius": 1}, "pose_a": {"p": [0,0,0], "q": [1,0,0,0]}, )"
    R"("b": {"type": "cone", "radius": 0.5, "half_height": 2}, "pose_b": {"p": [1,2,3], "q": [1,0,0,0]}, )"
    R"("expected": {"signed_distance": 0.25, "overlap": false, "normal": [0,0,2], "accuracy": 1e-12}, "tags": ["t"]})";

TEST(CollisionFiles, TheLibraryLoads) {
    ASSERT_FALSE(listCollisionFiles().empty());
    for (const auto& entry : listCollisionFiles()) {
        const CollisionFile file = loadCollisionFile(entry.file);
        EXPECT_EQ(file.name, entry.file.stem().string());
        EXPECT_GE(file.cases.size(), 10u);
        for (const CollisionCase& c : file.cases) {
            EXPECT_TRUE(c.expected.signedDistance) << c.name;
            EXPECT_GT(c.line, 1) << c.name;
            const CollisionCase again = readCollisionCase(c.text);
            EXPECT_EQ(again.dimension, c.dimension);
            EXPECT_EQ(again.b.pose, c.b.pose);
            EXPECT_EQ(again.a.geometry.index(), c.a.geometry.index());
        }
    }
}

/// Their axis is z, that of Rigor's format is y: the apex of a cone must come out where they have it.
TEST(CollisionFiles, AxesOfLinesAreTurned) {
    const CollisionFile file = loadCollisionFile(written("cone.jsonl", "\n" + kLine + "\n"));
    ASSERT_EQ(file.cases.size(), 1u);
    const CollisionCase& c = file.cases.front();
    EXPECT_EQ(c.name, "x");
    EXPECT_EQ(c.line, 2);
    const auto& cone = std::get<Cone>(c.b.geometry);
    const Vec3 apex = c.b.pose * Vec3{0, cone.halfLength, 0};
    EXPECT_NEAR(norm(apex - Vec3{1, 2, 5}), 0.0, 1e-15);
    EXPECT_EQ(c.expected.signedDistance, 0.25);
    EXPECT_EQ(c.expected.overlap, false);
    EXPECT_EQ(c.expected.normals, (std::vector<Vec3>{{0, 0, 1}}));
}

/// The format is recognised by the content of the file, not by its name.
TEST(CollisionFiles, FormatsAreDistinguished) {
    EXPECT_EQ(loadCollisionFile(written("lines.json", kLine + "\n" + kLine + "\n")).cases.size(), 2u);
    const std::string own =
        R"({"rigor_collision": 1, "name": "one_line", "cases": [{"name": "c", "a": {"sphere": {"radius": 1}},)"
        R"( "b": {"box": {"half_extents": [1,1,1]}, "position": [0,3,0]}}]})";
    const auto file = loadCollisionFile(written("own.jsonl", own + "\n"));
    EXPECT_EQ(file.name, "one_line");
    EXPECT_EQ(file.cases.front().b.pose.position, (Vec3{0, 3, 0}));
}

TEST(CollisionFiles, ShapesWithoutCounterpartStayAsCases) {
    std::string line = kLine;
    line.replace(line.find(R"({"type": "sphere", "radius": 1})"), 31,
                 R"({"type": "ellipsoid", "radii": [1,2,3]})");
    const auto ellipsoid = loadCollisionFile(written("ellipsoid.jsonl", line)).cases.front();
    EXPECT_EQ(ellipsoid.unsupported, "");
    EXPECT_EQ(std::get<Ellipsoid>(ellipsoid.a.geometry).halfAxes, (Vec3{1, 2, 3}));
    line = kLine;
    line.replace(line.find(R"({"type": "sphere", "radius": 1})"), 31,
                 R"({"type": "convex", "vertices": [[0,0,0],[1,0,0],[0,1,0]]})");
    EXPECT_NE(loadCollisionFile(written("flat.jsonl", line)).cases.front().unsupported.find("convex"),
              std::string::npos);
}

TEST(CollisionFiles, MessagesNameLineAndPlace) {
    std::string bad = kLine;
    bad.replace(bad.find("\"radius\": 0.5"), 13, "\"radius\": -0.5");
    const Problem radius = problemOf("radius.jsonl", kLine + "\n" + bad + "\n");
    EXPECT_EQ(radius.line, 2);
    EXPECT_EQ(radius.pointer, "/b/radius");
    EXPECT_NE(radius.found.find("-0.5"), std::string::npos);

    const Problem syntax = problemOf("syntax.jsonl", kLine + "\n{\"a\": \n");
    EXPECT_EQ(syntax.line, 2);
    EXPECT_EQ(syntax.id, "json.syntax");

    std::string quaternion = kLine;
    quaternion.replace(quaternion.rfind("[1,0,0,0]"), 9, "[1,1,0,0]");
    EXPECT_EQ(problemOf("quaternion.jsonl", quaternion).id, "orientation.unit");

    const std::string head = "{\"rigor_collision\": 1, \"name\": \"n\",\n\"cases\": [\n{\"name\": \"c\",\n";
    const Problem unknown =
        problemOf("unknown.json", head + "\"a\": {\"sphere\": {\"radius\": 1}},\n\"b\": {\"blob\": 1}}]}");
    EXPECT_EQ(unknown.line, 5);
    EXPECT_EQ(unknown.pointer, "/cases/0/b/blob");
    EXPECT_EQ(problemOf("no_b.json", head + "\"a\": {\"sphere\": {\"radius\": 1}}}]}").id,
              "schema.missing_key");
    EXPECT_EQ(problemOf("empty.jsonl", "").id, "collision.empty");
}

}  // namespace
}  // namespace rigor::scenario
