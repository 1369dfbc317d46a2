// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meshes and 2D segments against closed forms and against all their triangles one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

using adapter::CollisionAnswer;
using adapter::Geometry;
using scenario::Box;
using scenario::Capsule;
using scenario::Pose;
using scenario::Sphere;
using scenario::TriangleMesh;
using scenario::Vec3;
using Triangle = std::array<Vec3, 3>;

CollisionAnswer fclQuery(const Geometry& a, const Pose& poseA, const Geometry& b, const Pose& poseB,
                         int dimension = 3, const char* algorithm = "") {
    adapter::CollisionQuery query;
    query.a = {&a, poseA};
    query.b = {&b, poseB};
    query.dimension = dimension;
    query.maxContacts = 100;
    query.algorithm = algorithm;
    return engine().collision()->collide(query);
}

/// A sheet over x and z with bumps up to `bumps` [m].
TriangleMesh sheet(int cells, double bumps, std::mt19937& random) {
    std::uniform_real_distribution<double> height(0.0, std::max(bumps, 1e-300));
    TriangleMesh mesh;
    for (int k = 0; k <= cells; ++k)
        for (int i = 0; i <= cells; ++i)
            mesh.vertices.push_back({i - 0.5 * cells, bumps > 0.0 ? height(random) : 0.0, k - 0.5 * cells});
    for (int k = 0; k < cells; ++k)
        for (int i = 0; i < cells; ++i) {
            const int at = k * (cells + 1) + i, over = at + cells + 1;
            mesh.triangles.push_back({at, over, at + 1});
            mesh.triangles.push_back({at + 1, over, over + 1});
        }
    return mesh;
}

double pointTriangle(const Vec3& x, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]) / norm(cross(t[1] - t[0], t[2] - t[0]));
    bool inside = true;
    double least = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const Vec3 edge = t[(i + 1) % 3] - t[i];
        inside = inside && dot(cross(edge, x - t[i]), n) >= 0.0;
        const double s = std::clamp(dot(edge, x - t[i]) / dot(edge, edge), 0.0, 1.0);
        least = std::min(least, norm(x - t[i] - s * edge));
    }
    return inside ? std::abs(dot(n, x - t[0])) : least;
}

/// The distance is convex along a line.
double segmentTriangle(const Vec3& p, const Vec3& q, const Triangle& t) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 90; ++i) {
        const double one = low + (high - low) / 3, two = high - (high - low) / 3;
        const bool left = pointTriangle(p + one * (q - p), t) < pointTriangle(p + two * (q - p), t);
        (left ? high : low) = left ? two : one;
    }
    return pointTriangle(p + low * (q - p), t);
}

std::vector<Vec3> boxCorners(const Vec3& h) {
    std::vector<Vec3> corners;
    for (const double x : {-h.x, h.x})
        for (const double y : {-h.y, h.y})
            for (const double z : {-h.z, h.z}) corners.push_back({x, y, z});
    return corners;
}

/// Largest gap of the shadows on the separating axes [m]: the depth, negative, of a box at the origin.
double boxTriangleShadows(const Vec3& h, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, n};
    for (int i = 0; i < 3; ++i) {
        const Vec3 edge = t[(i + 1) % 3] - t[i];
        for (int k = 0; k < 4; ++k) axes.push_back(cross(edge, axes[k]));
    }
    double most = -INFINITY;
    for (const Vec3& axis : axes) {
        if (norm(axis) < 1e-9) continue;
        const Vec3 u = axis / norm(axis);
        const double reach = std::abs(u.x) * h.x + std::abs(u.y) * h.y + std::abs(u.z) * h.z;
        const auto [low, high] = std::minmax({dot(u, t[0]), dot(u, t[1]), dot(u, t[2])});
        most = std::max({most, low - reach, -high - reach});
    }
    return most;
}

double boxTriangle(const Vec3& h, const Triangle& t) {
    const double shadows = boxTriangleShadows(h, t);
    if (shadows < 0.0) return shadows;
    double least = INFINITY;
    const std::vector<Vec3> corners = boxCorners(h);
    for (std::size_t i = 0; i < 8; ++i)
        for (const std::size_t bit : {1u, 2u, 4u})
            if ((i & bit) == 0) least = std::min(least, segmentTriangle(corners[i], corners[i | bit], t));
    for (const Vec3& v : t) {
        const Vec3 out{std::max(std::abs(v.x) - h.x, 0.0), std::max(std::abs(v.y) - h.y, 0.0),
                       std::max(std::abs(v.z) - h.z, 0.0)};
        least = std::min(least, norm(out));
    }
    return least;
}

/// Signed distance of a shape from one triangle in the shape's frame.
double fromTriangle(const Geometry& shape, const Triangle& t) {
    if (const auto* s = std::get_if<Sphere>(&shape)) return pointTriangle({}, t) - s->radius;
    if (const auto* c = std::get_if<Capsule>(&shape)) {
        const double axis = segmentTriangle({0, -c->halfLength, 0}, {0, c->halfLength, 0}, t);
        return (axis > 1e-7 ? axis : boxTriangleShadows({0, c->halfLength, 0}, t)) - c->radius;
    }
    if (const auto* b = std::get_if<Box>(&shape)) return boxTriangle(b->halfExtents, t);
    return boxTriangle({0.3, 0.2, 0.4}, t);
}

Triangle triangleIn(const TriangleMesh& mesh, std::size_t i, const Pose& frame) {
    Triangle t;
    for (int k = 0; k < 3; ++k) t[k] = frame * mesh.vertices[mesh.triangles[i][k]];
    return t;
}

/// The least distance, or the depth, negative, of the triangle that the shape is deepest in.
double bruteForce(const TriangleMesh& mesh, const Pose& meshInShape, const Geometry& shape) {
    double least = INFINITY;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        least = std::min(least, fromTriangle(shape, triangleIn(mesh, i, meshInShape)));
    return least;
}

Pose anyPose(std::mt19937& random, double reach) {
    std::uniform_real_distribution<double> at(-reach, reach), part(-1, 1);
    const Vec3 position{at(random), at(random), at(random)};
    return {position, scenario::normalized({part(random), part(random), part(random), part(random) + 1.5})};
}

scenario::ConvexHull boxHull() {
    return {boxCorners({0.3, 0.2, 0.4})};
}

void expectBruteForce(const Geometry& shape, int queries, double tolerance) {
    std::mt19937 random(11);
    int overlaps = 0, apart = 0;
    for (int n = 0; n < queries; ++n) {
        const TriangleMesh mesh = sheet(4, 0.8, random);
        const Pose meshPose = anyPose(random, 0.5), pose = anyPose(random, 0.9);
        const double exact = bruteForce(mesh, inverse(pose) * meshPose, shape);
        if (std::abs(exact) < 1e-6) continue;
        (exact < 0 ? overlaps : apart)++;
        for (const bool swapped : {false, true}) {
            const auto answer =
                swapped ? fclQuery(shape, pose, mesh, meshPose) : fclQuery(mesh, meshPose, shape, pose);
            ASSERT_EQ(answer.overlap, exact < 0) << n << ", exact " << exact;
            ASSERT_TRUE(answer.signedDistance.has_value()) << n;
            EXPECT_NEAR(*answer.signedDistance, exact, tolerance) << n << (swapped ? " swapped" : "");
            if (exact >= 0) continue;
            ASSERT_FALSE(answer.contacts.empty());
            const auto& c = answer.contacts.front();
            EXPECT_NEAR(c.depth, -exact, tolerance) << n;
            EXPECT_NEAR(norm(c.normal), 1.0, 1e-9);
            double off = INFINITY;
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
                off = std::min(off,
                               pointTriangle(swapped ? c.pointB : c.pointA, triangleIn(mesh, i, meshPose)));
            EXPECT_LT(off, 1e-6) << n;
            EXPECT_NEAR(norm(c.pointA - c.pointB - c.depth * c.normal), 0.0, 1e-5);
        }
    }
    EXPECT_GT(overlaps, queries / 5);
    EXPECT_GT(apart, queries / 20);
}

TEST(FclSurfaces, SpheresAgreeWithAllTriangles) {
    expectBruteForce(Sphere{0.4}, 400, 1e-9);
}
TEST(FclSurfaces, CapsulesAgreeWithAllTriangles) {
    expectBruteForce(Capsule{0.3, 0.4}, 400, 1e-6);
}
TEST(FclSurfaces, BoxesAgreeWithAllTriangles) {
    expectBruteForce(Box{{0.3, 0.2, 0.4}}, 400, 1e-6);
}
TEST(FclSurfaces, HullsAgreeWithAllTriangles) {
    expectBruteForce(boxHull(), 400, 1e-6);
}

/// Each shape 1 mm deep in a flat sheet from above and from below, and 1 mm off it.
TEST(FclSurfaces, ASheetIsTouchedFromBothSides) {
    std::mt19937 random(1);
    const Geometry flat = sheet(4, 0.0, random);
    const std::vector<std::pair<Geometry, double>> shapes{{Sphere{0.4}, 0.4},
                                                          {Box{{0.3, 0.2, 0.4}}, 0.2},
                                                          {Capsule{0.3, 0.4}, 0.7},
                                                          {boxHull(), 0.2},
                                                          {scenario::Cylinder{0.3, 0.4}, 0.4},
                                                          {scenario::Cone{0.3, 0.4}, 0.4},
                                                          {scenario::Ellipsoid{{0.3, 0.5, 0.4}}, 0.5}};
    for (const auto& [shape, reach] : shapes)
        for (const double side : {1.0, -1.0})
            for (const double gap : {-1e-3, 1e-3}) {
                SCOPED_TRACE(std::string(scenario::geometryName(shape, 3)) +
                             (side > 0 ? " above" : " below"));
                const Vec3 at{0.3, side * (reach + gap), 0.35};
                const auto answer = fclQuery(flat, {}, shape, {at, {}});
                ASSERT_EQ(answer.overlap, gap < 0);
                ASSERT_TRUE(answer.signedDistance.has_value());
                EXPECT_NEAR(*answer.signedDistance, gap, 1e-4);
                if (gap > 0) continue;
                EXPECT_NEAR(answer.contacts.front().normal.y, side, 1e-2);
            }
}

/// More triangles under one shape than contacts that other pairs have.
TEST(FclSurfaces, EveryTriangleInTouchIsSeen) {
    std::mt19937 random(1);
    const TriangleMesh flat = sheet(20, 0.0, random);
    const auto answer = fclQuery(flat, {}, Box{{9.8, 0.2, 9.8}}, {{0, 0.199, 0}, {}});
    EXPECT_EQ(answer.contacts.size(), 100u);
    const auto deep = fclQuery(flat, {}, Sphere{7.0}, {{0.1, 6.5, 0.2}, {}});
    EXPECT_NEAR(deep.contacts.front().depth, 0.5, 1e-9);
}

/// fcl::collide alone has depths of spheres with the other sign (README.md).
TEST(FclSurfaces, TheLibrarysOwnDepthOfASphereIsNegative) {
    std::mt19937 random(1);
    const Geometry flat = sheet(2, 0.0, random);
    const auto answer = fclQuery(flat, {}, Sphere{0.4}, {{0.3, 0.3, 0.35}, {}}, 3, "libccd_collide");
    ASSERT_TRUE(answer.overlap);
    EXPECT_NEAR(answer.contacts.back().depth, -0.1, 1e-9);
}

TEST(FclSurfaces, SegmentsAndChainsAreTouchedFromBothSides) {
    scenario::ConvexHull square;
    square.vertices = {{-0.3, -0.2, 0}, {0.3, -0.2, 0}, {0.3, 0.2, 0}, {-0.3, 0.2, 0}};
    const std::vector<std::pair<Geometry, double>> shapes{
        {Sphere{0.4}, 0.4}, {Box{{0.3, 0.2, 0}}, 0.2}, {Capsule{0.1, 0.4}, 0.5}, {square, 0.2}};
    const scenario::Chain chain{{{-2, 0, 0}, {-0.7, 0, 0}, {2, 0, 0}}, false};
    const std::vector<Geometry> surfaces{scenario::Segment{{-1, 0, 0}, {1, 0, 0}}, chain};
    for (const Geometry& surface : surfaces)
        for (const auto& [shape, reach] : shapes)
            for (const double side : {1.0, -1.0})
                for (const double x : {-0.2, 0.0, 0.123, 0.3})
                    for (const double gap : {-0.09, -1e-3, 1e-3, 0.7}) {
                        SCOPED_TRACE(std::string(scenario::geometryName(shape, 2)) + " at " +
                                     std::to_string(x) + ", gap " + std::to_string(gap));
                        const Pose turn{{0.4, -1, 0}, scenario::fromAxisAngle({0, 0, 1}, 0.7)};
                        const Vec3 at{x, side * (reach + gap), 0};
                        const auto answer = fclQuery(shape, turn * Pose{at, {}}, surface, turn, 2);
                        ASSERT_EQ(answer.overlap, gap < 0);
                        EXPECT_NEAR(*answer.signedDistance, gap, 1e-6);
                        if (gap > 0) continue;
                        const auto& c = answer.contacts.front();
                        EXPECT_NEAR(norm(c.normal - rotate(turn.orientation, Vec3{0, -side, 0})), 0.0, 1e-6);
                        EXPECT_NEAR(c.depth, -gap, 1e-6);
                        EXPECT_EQ(c.pointA.z, 0.0);
                    }
}

/// The end of a segment in the middle of a box: the way out is along the segment.
TEST(FclSurfaces, TheEndOfASegmentLeavesAlongIt) {
    const auto answer =
        fclQuery(scenario::Segment{{-1, 0, 0}, {1, 0, 0}}, {}, Box{{0.3, 0.5, 0}}, {{1.2, 0.1, 0}, {}}, 2);
    ASSERT_TRUE(answer.overlap);
    EXPECT_NEAR(answer.contacts.front().normal.x, 1.0, 1e-6);
    EXPECT_NEAR(answer.contacts.front().depth, 0.1, 1e-6);
    EXPECT_NEAR(norm(answer.contacts.front().pointA - Vec3{1, 0, 0}), 0.0, 1e-6);
}

TEST(FclSurfaces, ASegmentGivesOneContact) {
    const scenario::Segment segment{{-1, 0, 0}, {1, 0, 0}};
    for (const double x : {-0.3, 0.0, 0.3})
        EXPECT_EQ(fclQuery(segment, {}, Sphere{0.4}, {{x, 0.3, 0}, {}}, 2).contacts.size(), 1u);
    const auto crossed = fclQuery(segment, {}, Capsule{0.2, 0.8}, {{0.1, 0.1, 0}, {}}, 2);
    ASSERT_EQ(crossed.contacts.size(), 1u);
    EXPECT_NEAR(crossed.contacts.front().depth, 0.9, 1e-6);
    EXPECT_NEAR(crossed.contacts.front().normal.y, 1.0, 1e-6);
    EXPECT_NEAR(crossed.contacts.front().pointB.y, -0.9, 1e-6);
}

TEST(FclSurfaces, WhatFclDoesNotHaveIsRefused) {
    std::mt19937 random(1);
    const scenario::HeightField field{2, 2, 1.0, 1.0, {0, 0, 0, 0}, 1.0};
    const Geometry flat = sheet(2, 0.0, random);
    EXPECT_THROW(fclQuery(field, {}, Sphere{1}, {}), adapter::Unsupported);
    EXPECT_THROW(fclQuery(flat, {}, flat, {}), adapter::Unsupported);
    EXPECT_THROW(fclQuery(scenario::HalfSpace{{0, 1, 0}, 0.0}, {}, flat, {}), adapter::Unsupported);
    EXPECT_TRUE(engine().capabilities().libraryLacks.contains("height_field"));
}

}  // namespace
}  // namespace rigor::test
