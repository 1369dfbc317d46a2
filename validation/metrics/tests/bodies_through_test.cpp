// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// bodies_through on ways that are drawn by hand: through a surface, in and out again, around its border,
// through an inner edge, through a surface that moves.
#include <gtest/gtest.h>

#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

/// A floor of 2 m x 2 m around the origin at y = 0.
std::vector<Geometry> floors(int dimension) {
    if (dimension == 2) return {Chain{{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, false}};
    TriangleMesh mesh;
    HeightField field{3, 3, 1.0, 1.0, std::vector<double>(9, 0.0), 1.0};
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) mesh.vertices.push_back({i - 1.0, 0.0, k - 1.0});
    for (const int a : {0, 1, 3, 4}) {
        mesh.triangles.push_back({a, a + 3, a + 1});
        mesh.triangles.push_back({a + 4, a + 3, a + 1});  // the windings do not matter
    }
    return {mesh, field};
}

/// The metric of two balls, of which the first goes along `way` and the second stays above the floor.
MetricValue through(const Geometry& floor, int dimension, const std::vector<Vec3>& way,
                    Vec3 floorMoves = {}) {
    Scenario s = emptyScene(dimension, {0, -10, 0}, 1);
    addBody(s, "floor", BodyType::Kinematic, floor, {});
    addBall(s, "goes", 0.1, 1, 0.4, way[0]);
    addBall(s, "stays", 0.1, 1, 0.4, {0.3, 0.1, 0});
    Trajectory run;
    run.bodyCount = 3;
    for (std::size_t k = 0; k < way.size(); ++k) {
        run.times.push_back(0.1 * k);
        BodyState ground, goes, stays;
        ground.position = k * floorMoves;
        goes.position = way[k];
        stays.position = Vec3{0.3, 0.1, 0} + k * floorMoves;
        run.states.insert(run.states.end(), {ground, goes, stays});
    }
    const auto rows = findMetric("bodies_through")->evaluate({s, run, nullptr, adapter::Scheme::Unknown});
    EXPECT_EQ(rows.size(), 1u);
    return rows.empty() ? MetricValue{} : rows[0];
}

TEST(BodiesThrough, CountsThoseThatEndOnTheOtherSide) {
    for (const int dimension : {2, 3})
        for (const Geometry& floor : floors(dimension)) {
            SCOPED_TRACE(scenario::geometryName(floor, dimension));
            const MetricValue down = through(floor, dimension, {{0.4, 1, 0}, {0.4, 0.2, 0}, {0.4, -0.3, 0}});
            EXPECT_EQ(down.value, 1);
            EXPECT_DOUBLE_EQ(down.at, 0.2);
            EXPECT_EQ(through(floor, dimension, {{0.4, 1, 0}, {0.4, -0.1, 0}, {0.4, 0.1, 0}}).value, 0)
                << "back";
            EXPECT_EQ(through(floor, dimension, {{0.4, 1, 0}, {1.6, 0.2, 0}, {1.5, -3, 0}, {0, -3, 0}}).value,
                      0)
                << "around the border";
            EXPECT_EQ(through(floor, dimension, {{0, -1, 0}, {0, 1, 0}}).value, 1)
                << "up, through a vertex of all pieces";
            EXPECT_EQ(through(floor, dimension, {{0.5, 0.2, 0}, {0.5, -0.2, 0}}, {0, -1, 0}).value, 0)
                << "the floor moves away";
        }
}

TEST(BodiesThrough, AnInnerEdgeCountsOnce) {
    for (const Geometry& floor : floors(3))
        for (const double x : {-0.5, 0.0, 0.25})
            for (const double z : {-0.5, 0.0, 0.75})
                EXPECT_EQ(through(floor, 3, {{x, 0.5, z}, {x, -0.5, z}}).value, 1) << x << " " << z;
}

TEST(BodiesThrough, NeedsASurface) {
    Scenario s = emptyScene(3, {0, -10, 0}, 1);
    addFloor(s);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 1, 0});
    Trajectory run;
    run.bodyCount = 2;
    run.times = {0, 0.1};
    run.states.resize(4);
    EXPECT_TRUE(findMetric("bodies_through")->evaluate({s, run, nullptr, adapter::Scheme::Unknown}).empty());
}

}  // namespace
}  // namespace rigor::validation::testing
