// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Triangle meshes and height fields: both sides, frames, and balls that roll over facets.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

using scenario::HeightField;
using scenario::TriangleMesh;

/// A level square of 4 m, 8 x 8 cells of two triangles, seen from above counter-clockwise (or not).
TriangleMesh floorMesh(bool facesUp) {
    TriangleMesh mesh;
    for (int i = 0; i <= 8; ++i)
        for (int k = 0; k <= 8; ++k) mesh.vertices.push_back({-2.03 + 0.5 * i, 0.0, -1.97 + 0.5 * k});
    const auto id = [](int i, int k) { return 9 * i + k; };
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 8; ++k) {
            const int a = id(i, k), b = id(i, k + 1), c = id(i + 1, k), d = id(i + 1, k + 1);
            mesh.triangles.push_back(facesUp ? std::array<int, 3>{a, b, c} : std::array<int, 3>{a, c, b});
            mesh.triangles.push_back(facesUp ? std::array<int, 3>{c, b, d} : std::array<int, 3>{c, d, b});
        }
    return mesh;
}

/// Trap: ODE's spheres, capsules and cylinders fall through triangles from behind; the format's are
/// two-sided.
TEST(OdeSurfaces, BothSidesOfAMeshBear) {
    const std::pair<Geometry, double> shapes[] = {
        {Sphere{0.2}, 0.2}, {Box{{0.2, 0.2, 0.2}}, 0.2}, {Cylinder{0.2, 0.15}, 0.15}};
    for (const bool facesUp : {true, false})
        for (const auto& [shape, half] : shapes) {
            Scenario s = scene(0.5);
            addStatic(s, floorMesh(facesUp));
            const int b = addBody(s, shape, {0.11, half + 0.05, 0.07}, 1.0, {0.02, 0.02, 0.02});
            const Vec3 end = Simulation(s, 1.0 / 240.0).seconds(2.0).state(b).position;
            EXPECT_NEAR(end.y, half, 1e-5) << facesUp << " shape " << shape.index();
            EXPECT_NEAR(std::hypot(end.x - 0.11, end.z - 0.07), 0.0, 1e-3) << "shape " << shape.index();
        }
}

/// Trap: convex geoms raise an error at meshes whose face angles were not computed, and from behind they get
/// normals that pull them through.
TEST(OdeSurfaces, AHullLiesOnEitherSideOfAMesh) {
    for (const bool facesUp : {true, false}) {
        Scenario s = scene(0.5);
        addStatic(s, floorMesh(facesUp));
        const int b =
            addBody(s, boxHull({0.3, 0.2, 0.3}), {0.11, 0.21, 0.07}, 1.0, boxMoments(1.0, {0.3, 0.2, 0.3}));
        EXPECT_NEAR(Simulation(s, 1.0 / 240.0).seconds(0.5).state(b).position.y, 0.2, 2e-2) << facesUp;
    }
}

/// The same in 2D: a polygon that falls on the top of a looped chain, whichever way it runs round.
TEST(OdeSurfaces, APolygonLiesOnALoopedChain) {
    for (const bool clockwise : {true, false}) {
        Scenario s = scene(0.5, 0.0, 2);
        scenario::Chain loop;
        loop.vertices = {{-5, 0, 0}, {-5, -1, 0}, {5, -1, 0}, {5, 0, 0}};
        if (clockwise) std::reverse(loop.vertices.begin(), loop.vertices.end());
        loop.loop = true;
        addStatic(s, loop);
        const int b =
            addBody(s, scenario::ConvexHull{{{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.1, 0.2, 0}, {-0.1, 0.2, 0}}},
                    {0.013, 0.5, 0}, 1.0, even(0.02));
        EXPECT_NEAR(Simulation(s, 1.0 / 240.0).seconds(1.5).state(b).position.y, 0.2, 2e-2) << clockwise;
    }
}

/// Rows along z, columns along x, heights along y of the shape's frame, turned and moved with its body.
TEST(OdeSurfaces, AHeightFieldStandsWhereItsFrameSays) {
    Scenario s = scene(0.5);
    HeightField field;
    field.columns = 5;
    field.rows = 4;
    field.spacingX = 1.0;
    field.spacingZ = 0.5;
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 5; ++i) field.heights.push_back(0.3 * i);  // rises along x alone
    addStatic(s, field, {10, 1, 0});
    // A quarter turn about y brings the field's x to the world's -z.
    s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 1, 0}, 1.5707963267948966);
    const auto heightUnder = [&](double x, double z) {
        Scenario one = s;
        one.gravity = {};
        const int b = addBody(one, Sphere{0.1}, {x, 3.0, z});
        one.bodies[b].velocity = {0, -1, 0};
        Simulation simulation(one, 1e-3);
        for (int i = 0; i < 3000; ++i)
            if (!simulation.steps(1).contacts().empty()) break;
        return simulation.state(b).position.y;
    };
    // The surface at the field's x is 1 + 0.3 (x + 2); the ball touches r / cos(slope) above it.
    const double above = 0.1 * std::sqrt(1.0 + 0.09);
    EXPECT_NEAR(heightUnder(10.0, -1.2), 1.0 + 0.3 * 3.2 + above, 3e-3);
    EXPECT_NEAR(heightUnder(10.3, 1.2), 1.0 + 0.3 * 0.8 + above, 3e-3);
    // The field neither wraps round nor goes on: it ends 0.5 m along z to either side.
    EXPECT_LT(heightUnder(11.0, 0.0), 0.5);
}

/// A closed 2D chain supports a box within and on it.
TEST(OdeSurfaces, AChainHoldsFromWithinAndWithout) {
    const scenario::Chain loop{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, true};
    for (const bool within : {true, false}) {
        Scenario s = scene(0.5, 0.0, 2);
        addStatic(s, loop);
        const int b = addBody(s, Box{{0.1, 0.1, 0}}, {0.1, within ? -0.88 : 1.12, 0}, 1.0, even(0.01));
        EXPECT_NEAR(Simulation(s, 1.0 / 240.0).seconds(1.0).state(b).position.y, within ? -0.9 : 1.1, 1e-4);
    }
}

/// A ball whose centre is beyond the end of a triangle touches the edge at 45 degrees, and gets the normal of
/// the face and the part of the depth along that: what the ledger says.
TEST(OdeSurfaces, AnEdgeHasTheNormalOfItsFace) {
    const Geometry open = scenario::Chain{{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, false}, disc = Sphere{0.5};
    adapter::CollisionQuery query;
    query.dimension = 2;
    query.a = {&open, {}};
    query.b = {&disc, {{1.3, 0.3, 0}, {}}};
    const auto answer = engine().collision()->collide(query);
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_NEAR(norm(answer.contacts[0].normal - Vec3{0, 1, 0}), 0.0, 1e-6);
    EXPECT_NEAR(answer.contacts[0].depth, (0.5 - 0.3 * std::sqrt(2.0)) * std::sqrt(0.5), 1e-6);
}

/// A ball rolling down into a polygonal trough and up again: points of the triangles ahead take its speed,
/// unless those of nearly one normal are one.
TEST(OdeSurfaces, ABallIsNotStoppedByTheFacetsAhead) {
    const auto reached = [](const std::string& options) {
        Scenario s = scene(0.9);
        TriangleMesh trough;
        for (int i = 0; i <= 200; ++i) {
            const double a = 3.14159265358979 * (1.0 + i / 200.0);
            for (const double z : {-0.5, 0.5}) trough.vertices.push_back({std::cos(a), std::sin(a), z});
        }
        for (int i = 0; i < 200; ++i) {
            trough.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
            trough.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
        }
        addStatic(s, trough);
        const double a = 0.25 * 3.14159265358979, R = 0.8995;
        const int b = addBody(s, Sphere{0.1}, {-R * std::sin(a), -R * std::cos(a), 0.03}, 1.0,
                              even(sphereMoment(1.0, 0.1)));
        Simulation simulation(s, 1.0 / 60.0, options);
        double furthest = -1.0;
        for (int i = 0; i < 150; ++i) furthest = std::max(furthest, simulation.steps(1).state(b).position.x);
        return furthest / (R * std::sin(a));
    };
    EXPECT_GT(reached("preset=matched"), 0.9);
    EXPECT_LT(reached("preset=matched,ball_merge_deg=0"), 0.6);
}

}  // namespace
}  // namespace rigor::test
