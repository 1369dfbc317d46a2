// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

namespace rigor::scenario {
namespace {

Vec3 corner(const HullMesh& mesh, int i) {
    return mesh.vertices[i];
}

/// Conditions for a mesh to be the convex hull of the points: every face lies in a plane with all points
/// behind it, loops turn outwards, every edge is shared by two faces in opposite directions, and Euler's
/// formula holds.
void expectIsHull(const HullMesh& mesh, const std::vector<Vec3>& points, double tolerance) {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& face : mesh.faces) {
        ASSERT_GE(face.size(), 3u);
        Vec3 n;  // Newell's normal: counter-clockwise seen from outside
        for (std::size_t i = 0; i < face.size(); ++i) {
            const int a = face[i], b = face[(i + 1) % face.size()];
            n += cross(corner(mesh, a), corner(mesh, b));
            ++edges[{a, b}];
        }
        n = n / norm(n);
        for (const int i : face) EXPECT_NEAR(dot(n, corner(mesh, i) - corner(mesh, face[0])), 0.0, tolerance);
        for (const Vec3& p : points) EXPECT_LE(dot(n, p - corner(mesh, face[0])), tolerance);
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "an edge without its other face";
    }
    EXPECT_EQ(static_cast<long>(mesh.vertices.size()) - static_cast<long>(edges.size() / 2) +
                  static_cast<long>(mesh.faces.size()),
              2);
}

TEST(Hull3d, CubeHasSixSquares) {
    std::vector<Vec3> points;
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0}) points.push_back({x, y, z});
    const HullMesh mesh = convexHull3d(points);  // midpoints of edges and faces are no corners
    EXPECT_EQ(mesh.vertices.size(), 8u);
    ASSERT_EQ(mesh.faces.size(), 6u);
    for (const auto& face : mesh.faces) EXPECT_EQ(face.size(), 4u);
    expectIsHull(mesh, points, 1e-12);
}

TEST(Hull3d, RandomPoints) {
    std::mt19937_64 random(11);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
    for (int round = 0; round < 30; ++round) {
        std::vector<Vec3> points;
        const double scale = round % 3 == 0 ? 1e-3 : (round % 3 == 1 ? 1.0 : 1e3);
        for (int i = 0; i < 4 + round; ++i) points.push_back(scale * Vec3{unit(), unit(), unit()});
        const HullMesh mesh = convexHull3d(points);
        expectIsHull(mesh, points, 1e-9 * scale);
        for (const Vec3& v : mesh.vertices)
            EXPECT_NE(std::find(points.begin(), points.end(), v), points.end()) << "corners are given points";
    }
}

TEST(Hull3d, PrismsOfManySides) {
    for (int n = 3; n <= 20; ++n) {
        std::vector<Vec3> points;
        for (int i = 0; i < n; ++i) {
            const double a = 2.0 * 3.14159265358979323846 * i / n;
            for (const double y : {-0.3, 0.3}) points.push_back({std::cos(a), y, std::sin(a)});
        }
        const HullMesh mesh = convexHull3d(points);
        EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(n + 2));
        expectIsHull(mesh, points, 1e-12);
    }
}

TEST(Hull3d, RefusesFlatPoints) {
    EXPECT_THROW(convexHull3d({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), std::invalid_argument);
    EXPECT_THROW(convexHull3d({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), std::invalid_argument);
    EXPECT_THROW(convexHull3d({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), std::invalid_argument);
    EXPECT_THROW(convexHull3d(std::vector<Vec3>(8, Vec3{1, 2, 3})), std::invalid_argument);
}

TEST(Hull2d, CornersInOrder) {
    const auto loop =
        convexHull2d({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0.5, 0}, {0, 0, 0}});
    ASSERT_EQ(loop.size(), 4u);
    double area = 0.0;
    for (std::size_t i = 0; i < 4; ++i) area += 0.5 * cross(loop[i], loop[(i + 1) % 4]).z;
    EXPECT_DOUBLE_EQ(area, 2.0);  // positive: counter-clockwise
}

TEST(Hull2d, RefusesPointsOnALine) {
    EXPECT_THROW(convexHull2d({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}), std::invalid_argument);
    EXPECT_THROW(convexHull2d({{0, 0, 0}, {1, 0, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace rigor::scenario
