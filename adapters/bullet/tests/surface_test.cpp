// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Triangle meshes and height fields: where they stand, how cells are split, whose material a triangle has.
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

using scenario::HeightField;
using scenario::TriangleMesh;

/// A flat square sheet at height 0, cut into cells of two triangles.
TriangleMesh sheet(int cells, double half) {
    TriangleMesh mesh;
    for (int i = 0; i <= cells; ++i)
        for (int k = 0; k <= cells; ++k)
            mesh.vertices.push_back({half * (2.0 * i / cells - 1.0), 0.0, half * (2.0 * k / cells - 1.0)});
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
            const int v = i * (cells + 1) + k, w = v + cells + 1;
            mesh.triangles.push_back({v, v + 1, w});
            mesh.triangles.push_back({w, v + 1, w + 1});
        }
    return mesh;
}

double restingHeight(const Geometry& surface, double x, double z, const std::string& options) {
    Scenario s = scene(0.5);
    addStatic(s, surface);
    const int ball = addBody(s, Sphere{0.1}, {x, 2.0, z}, 1.0, even(sphereMoment(1.0, 0.1)));
    s.bodies[1].velocity = {0, -1, 0};
    Simulation run(s, 1.0 / 240, options);
    run.seconds(2);
    return run.state(ball).position.y;
}

/// Bullet's origin is the middle of the heights; the format's is height 0.
TEST(BulletSurfaces, AHeightFieldStandsAtItsHeights) {
    HeightField field{3, 3, 1.0, 1.0, {1, 1, 1, 1, 1, 1, 1, 1, 1}, 0.5};
    for (const char* preset : {"preset=matched", "preset=default"}) {
        EXPECT_NEAR(restingHeight(field, 0.3, 0.4, preset), 1.1, 2e-3) << preset;
        HeightField uneven = field;
        uneven.heights[0] = -3.0;  // a corner far from the ball moves the middle
        EXPECT_NEAR(restingHeight(uneven, 0.7, 0.8, preset), 1.1, 2e-3) << preset;
    }
}

/// Rows and columns: a step that rises along x alone, with unlike spacings.
TEST(BulletSurfaces, ColumnsRunAlongX) {
    const HeightField field{3, 2, 2.0, 5.0, {0, 0.5, 0.5, 0, 0.5, 0.5}, 1.0};
    EXPECT_NEAR(restingHeight(field, 1.0, 1.5, "preset=matched"), 0.6, 2e-3);
    EXPECT_LT(restingHeight(field, -1.0, 1.5, "preset=matched"), 0.4);
}

/// A cell whose corners on the diagonal from (1, 0) to (0, 1) are high is a ridge, not a valley.
TEST(BulletSurfaces, CellsAreSplitAsTheFormatSays) {
    const HeightField ridge{2, 2, 1.0, 1.0, {0, 1, 1, 0}, 1.0}, valley{2, 2, 1.0, 1.0, {1, 0, 0, 1}, 1.0};
    const auto depthAt = [&](const HeightField& field, double height) {
        const Geometry a = field, b = Sphere{0.1};
        adapter::CollisionQuery query;
        query.a = {&a, {}};
        query.b = {&b, {{0, height, 0}, {}}};
        const auto answer = engine().collision()->collide(query);
        return answer.contacts.empty() ? -1.0 : answer.contacts.front().depth;
    };
    EXPECT_NEAR(depthAt(ridge, 1.05), 0.05, tol(1e-6, 1e-5));
    EXPECT_LT(depthAt(valley, 1.05), 0.0);
    EXPECT_GT(depthAt(valley, 0.1), 0.0);
}

/// Nothing may decelerate the box without friction; inner edges do if they are left as they are.
TEST(BulletSurfaces, ABoxSlidesOverASheetOfTrianglesAsOverAFloor) {
    Scenario s = scene(0.0);
    addStatic(s, sheet(8, 8.0));
    const int box = addBody(s, Box{{0.3, 0.2, 0.3}}, {-4, 0.2, 0.1}, 1.0, boxMoments(1.0, {0.3, 0.2, 0.3}));
    s.bodies[1].velocity = {3, 0, 0.4};
    const auto after = [&](const char* options) {
        Simulation run(s, 1.0 / 240, options);
        return run.seconds(2.5).state(box);
    };
    const BodyState matched = after("preset=matched");
    EXPECT_NEAR(matched.velocity.x, 3.0, 0.02);
    EXPECT_NEAR(matched.position.y, 0.2, 5e-3);
    EXPECT_NEAR(norm(matched.angularVelocity), 0.0, 0.05);
    EXPECT_LT(after("preset=default").velocity.x, 2.8);
    EXPECT_NEAR(after("preset=default,internal_edges=on").velocity.x, 3.0, 0.05);
}

/// Bullet's index in a contact with a triangle is the triangle's: the fifth triangle of the second shape is
/// not the fifth shape.
TEST(BulletSurfaces, TrianglesHaveTheMaterialOfTheirShape) {
    Scenario s = scene(0.0);
    s.materials.push_back({"rough", 1.0, 0.0, 1000.0});
    s.pairs.push_back({0, 1, 0.7, 0.0, 0.0});
    Body floor;
    floor.name = "floor";
    floor.type = BodyType::Static;
    scenario::Pose left, right;
    left.position = {-20, 0, 0};
    right.position = {20, 0, 0};
    floor.shapes = {shapeOf(sheet(4, 10.0), 0, left), shapeOf(sheet(4, 10.0), 1, right)};
    s.bodies.push_back(floor);
    const int smooth = addBody(s, Box{{0.5, 0.5, 0.5}}, {-18, 0.5, 1}, 1.0, even(1.0 / 6));
    const int rough = addBody(s, Box{{0.5, 0.5, 0.5}}, {18, 0.5, 1}, 1.0, even(1.0 / 6));
    s.bodies[1].velocity = s.bodies[2].velocity = {0, 0, 1};
    Simulation run(s, 1.0 / 240);
    run.seconds(1);
    EXPECT_NEAR(run.state(smooth).velocity.z, 1.0, 0.01);
    EXPECT_NEAR(run.state(rough).velocity.z, 0.0, 0.01);
    for (const ContactPoint& contact : run.contacts())
        EXPECT_EQ(contact.shapeA, contact.bodyB == smooth ? 0 : 1);
}

TEST(BulletSurfaces, TheLedgerReportsThatAHeightFieldIsHollow) {
    Scenario s = scene();
    addStatic(s, HeightField{2, 2, 1.0, 1.0, {0, 0, 0, 0}, 1.0});
    Simulation run(s, 0.01);
    ASSERT_NE(run.ledgerLine("height_field"), nullptr);
    EXPECT_EQ(run.ledgerLine("internal_edges")->resolved, "on");
}

}  // namespace
}  // namespace rigor::test
