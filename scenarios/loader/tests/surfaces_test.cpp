// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chains, meshes and height fields from files: what they become, and what is said of bad ones.
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::scenario {
namespace {

std::string surfaceFile(int dimension, const std::string& shape,
                        const std::string& type = "\"type\": \"static\"") {
    return R"({ "rigor": 1, "name": "s", "title": "t", "dimension": )" + std::to_string(dimension) +
           R"(, "gravity": )" + (dimension == 2 ? "[0, -9.81]" : "[0, -9.81, 0]") +
           R"(, "duration": 1, "dt": [0.01], "materials": { "m": { "friction": 0.5, "restitution": 0 } },
  "bodies": [ { "name": "ground", )" +
           type + R"(, "shapes": [ { )" + shape + R"( } ] },
    { "name": "ball", "mass": 1, "position": )" +
           (dimension == 2 ? "[0, 5]" : "[0, 5, 0]") + R"(, "shapes": [ { ")" +
           (dimension == 2 ? "circle" : "sphere") + R"(": { "radius": 0.1 } } ] } ] })";
}
Geometry loadSurface(int dimension, const std::string& shape) {
    return loadScenarioText(surfaceFile(dimension, shape), "s.json").scenario.bodies[0].shapes[0].geometry;
}
std::string refusalOf(int dimension, const std::string& shape,
                      const std::string& type = "\"type\": \"static\"") {
    try {
        (void)loadScenarioText(surfaceFile(dimension, shape, type), "s.json");
    } catch (const LoadError& error) {
        return error.what();
    }
    return "loaded";
}

TEST(Surfaces, AreRead) {
    const auto chain =
        std::get<Chain>(loadSurface(2, R"("chain": { "vertices": [[0, 0], [1, 0], [2, 1]], "loop": true })"));
    EXPECT_EQ(chain.vertices.size(), 3u);
    EXPECT_TRUE(chain.loop);
    const auto mesh = std::get<TriangleMesh>(loadSurface(
        3,
        R"("triangle_mesh": { "vertices": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], "triangles": [[0, 1, 2]] })"));
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0][2], 2);
    const auto field = std::get<HeightField>(loadSurface(
        3, R"("height_field": { "spacing": [0.5, 2], "heights": [[0, 1, 2], [3, 4, 5]], "thickness": 3 })"));
    EXPECT_EQ(field.columns, 3);
    EXPECT_EQ(field.rows, 2);
    EXPECT_EQ(field.thickness, 3);
    const auto vertices = surfaceVertices(field);
    ASSERT_EQ(vertices.size(), 6u);
    EXPECT_EQ(vertices[5].x, 0.5);
    EXPECT_EQ(vertices[5].y, 5);
    EXPECT_EQ(vertices[5].z, 1);
}

TEST(Surfaces, BadOnesAreRefusedWithTheReason) {
    struct BadSurface {
        int dimension;
        const char* shape;
        const char* reason;
    };
    const BadSurface all[] = {
        {2, R"("chain": { "vertices": [[0, 0]] })", "two vertices"},
        {2, R"("chain": { "vertices": [[0, 0], [1, 0]], "loop": true })", "three vertices"},
        {2, R"("chain": { "vertices": [[0, 0], [1, 0], [1, 0]] })", "1 and 2 are at one place"},
        {3, R"("triangle_mesh": { "vertices": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], "triangles": [] })",
         "triangle"},
        {3, R"("triangle_mesh": { "vertices": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], "triangles": [[0, 1, 3]] })",
         "2"},
        {3, R"("triangle_mesh": { "vertices": [[0, 0, 0], [0, 0, 1], [0, 0, 2]], "triangles": [[0, 1, 2]] })",
         "triangle 0 has no area"},
        {3, R"("triangle_mesh": { "vertices": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], "triangles": [[0, 1]] })",
         "three"},
        {3, R"("height_field": { "spacing": [1, 1], "heights": [[0, 1]] })", "two rows"},
        {3, R"("height_field": { "spacing": [1, 1], "heights": [[0, 1], [1]] })", "first row"},
        {3, R"("height_field": { "spacing": [0, 1], "heights": [[0, 1], [1, 2]] })", "spacing"},
    };
    for (const BadSurface& bad : all) {
        const std::string said = refusalOf(bad.dimension, bad.shape);
        EXPECT_NE(said.find(bad.reason), std::string::npos) << bad.shape << "\n" << said;
        EXPECT_NE(said.find("s.json"), std::string::npos) << said;
    }
    EXPECT_NE(refusalOf(3, R"("chain": { "vertices": [[0, 0, 0], [1, 0, 0]] })").find("shape.dimension"),
              std::string::npos);
    EXPECT_NE(refusalOf(3, R"("height_field": { "spacing": [1, 1], "heights": [[0, 1], [1, 2]] })",
                        "\"mass\": 1, \"inertia\": [1, 1, 1]")
                  .find("shape.static"),
              std::string::npos);
}

}  // namespace
}  // namespace rigor::scenario
