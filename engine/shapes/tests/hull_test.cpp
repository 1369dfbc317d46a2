// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex hulls: topology, containment and robustness to coplanar, collinear and duplicate points.
#include "engine/shapes/hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace rigor::engine {
namespace {

template <class S>
using Points = std::vector<typename S::Vec>;

template <class S>
constexpr double tolerance() {
    return sizeof(typename S::Real) == 4 ? 4e-6 : 4e-11;
}

struct Random {
    std::mt19937 generator;
    double normal() { return std::normal_distribution<double>()(generator); }
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator); }
    template <class S>
    typename S::Vec inBall() {
        Eigen::Matrix<double, S::dim, 1> v;
        for (int i = 0; i < S::dim; ++i) v[i] = normal();
        v *= std::pow(uniform(0, 1), 1.0 / S::dim) / v.norm();
        return v.template cast<typename S::Real>();
    }
};

/// Every face is a supporting plane of all points, faces and edges close up (Euler), loops turn left, and
/// each edge runs along both of its faces.
template <class S>
void expectValid(const HullData<S>& h, const Points<S>& points, double size) {
    const double eps = tolerance<S>() * size;
    EXPECT_EQ(static_cast<int>(h.vertices.size()) - static_cast<int>(h.edges.size()) +
                  static_cast<int>(h.faces.size()),
              2);
    std::map<std::pair<int, int>, int> faceOf;
    for (std::size_t f = 0; f < h.faces.size(); ++f) {
        const auto& face = h.faces[f];
        EXPECT_NEAR(face.normal.norm(), 1.0, 1e-6);
        EXPECT_GE(face.count, 3);
        for (const auto& p : points) EXPECT_LE(face.normal.dot(p) - face.offset, eps);
        EXPECT_LT(face.normal.dot(h.center), face.offset);
        for (int i = 0; i < face.count; ++i) {
            const auto loop = [&](int k) { return h.loops[face.first + k % face.count]; };
            const auto vertex = [&](int k) { return h.vertices[loop(k)]; };
            EXPECT_NEAR(face.normal.dot(vertex(i)), face.offset, eps);
            const typename S::Vec turn = (vertex(i + 1) - vertex(i)).cross(vertex(i + 2) - vertex(i + 1));
            EXPECT_GT(turn.dot(face.normal), 0);
            EXPECT_TRUE(faceOf.emplace(std::pair(loop(i), loop(i + 1)), static_cast<int>(f)).second);
        }
    }
    EXPECT_EQ(faceOf.size(), 2 * h.edges.size());
    for (const HullEdge& e : h.edges) {
        EXPECT_EQ(faceOf.at({e.v0, e.v1}), e.left);
        EXPECT_EQ(faceOf.at({e.v1, e.v0}), e.right);
        const auto& l = h.faces[e.left];
        const auto& r = h.faces[e.right];
        const typename S::Vec along = h.vertices[e.v1] - h.vertices[e.v0];
        EXPECT_GT(l.normal.cross(r.normal).dot(along), 0);  // convex at the edge
    }
}

template <class S>
class Hull3d : public testing::Test {};
using Spaces3 = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Hull3d, Spaces3);

template <class S>
Points<S> cubeCorners(double h) {
    Points<S> points;
    for (unsigned i = 0; i < 8; ++i)
        points.push_back(typename S::Vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1) *
                         static_cast<typename S::Real>(h));
    return points;
}

template <class S>
std::vector<int> faceSizes(const HullData<S>& h) {
    std::vector<int> sizes;
    for (const auto& f : h.faces) sizes.push_back(f.count);
    std::sort(sizes.begin(), sizes.end());
    return sizes;
}

TYPED_TEST(Hull3d, CubeHasSixQuads) {
    const auto points = cubeCorners<TypeParam>(0.5);
    const auto hull = makeHull<TypeParam>(points);
    expectValid<TypeParam>(*hull.data, points, 1.0);
    EXPECT_EQ(hull.data->vertices.size(), 8u);
    EXPECT_EQ(hull.data->edges.size(), 12u);
    EXPECT_EQ(faceSizes(*hull.data), std::vector<int>(6, 4));
}

/// A grid over the whole cube: points inside, in faces and on edges all vanish, in any order and turned.
TYPED_TEST(Hull3d, GridOfACubeIsACube) {
    using V = typename TypeParam::Vec;
    using R = typename TypeParam::Real;
    Random random{std::mt19937(3)};
    for (int trial = 0; trial < 20; ++trial) {
        Points<TypeParam> points;
        const Eigen::Quaternion<double> q = trial == 0 ? Eigen::Quaterniond::Identity()
                                                       : Eigen::Quaterniond(random.normal(), random.normal(),
                                                                            random.normal(), random.normal())
                                                             .normalized();
        for (int x = -2; x <= 2; ++x)
            for (int y = -2; y <= 2; ++y)
                for (int z = -2; z <= 2; ++z)
                    points.push_back((q * Eigen::Vector3d(x, 0.5 * y, 0.2 * z)).template cast<R>());
        std::shuffle(points.begin(), points.end(), random.generator);
        points.push_back(V(points.front()));  // a duplicate
        const auto hull = makeHull<TypeParam>(points);
        expectValid<TypeParam>(*hull.data, points, 4.0);
        EXPECT_EQ(hull.data->vertices.size(), 8u);
        EXPECT_EQ(faceSizes(*hull.data), std::vector<int>(6, 4));
    }
}

TYPED_TEST(Hull3d, RandomPointsAreContained) {
    Random random{std::mt19937(5)};
    for (int count : {4, 5, 8, 20, 100, 500}) {
        Points<TypeParam> points;
        for (int i = 0; i < count; ++i) points.push_back(random.inBall<TypeParam>());
        const auto hull = makeHull<TypeParam>(points);
        expectValid<TypeParam>(*hull.data, points, 2.0);
        // Vertices are among the points given.
        for (const auto& v : hull.data->vertices)
            EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const auto& p) { return p == v; }));
    }
}

TYPED_TEST(Hull3d, PrismHasPolygonCaps) {
    using R = typename TypeParam::Real;
    Points<TypeParam> points;
    for (int i = 0; i < 24; ++i)
        for (int side : {-1, 1}) {
            const double angle = 2 * std::numbers::pi * i / 24;
            points.push_back({static_cast<R>(std::cos(angle)), static_cast<R>(0.05 * side),
                              static_cast<R>(std::sin(angle))});
        }
    const auto hull = makeHull<TypeParam>(points);
    expectValid<TypeParam>(*hull.data, points, 2.0);
    std::vector<int> expected(24, 4);
    expected.insert(expected.end(), 2, 24);
    EXPECT_EQ(faceSizes(*hull.data), expected);
}

/// The same hull a thousand times thinner, and far from the origin of its own frame.
TYPED_TEST(Hull3d, ThinPlateKeepsItsFaces) {
    using R = typename TypeParam::Real;
    Points<TypeParam> points = cubeCorners<TypeParam>(0.5);
    for (auto& p : points) p = typename TypeParam::Vec(p.x(), p.y() * R(1e-3), p.z());
    const auto hull = makeHull<TypeParam>(points);
    expectValid<TypeParam>(*hull.data, points, 1.0);
    EXPECT_EQ(faceSizes(*hull.data), std::vector<int>(6, 4));
}

TYPED_TEST(Hull3d, RefusesFlatPoints) {
    using V = typename TypeParam::Vec;
    const Points<TypeParam> flat{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(1, 1, 0), V(0.5, 0.2, 0)};
    const Points<TypeParam> line{V(0, 0, 0), V(1, 1, 1), V(2, 2, 2), V(3, 3, 3)};
    const Points<TypeParam> point(6, V(1, 2, 3));
    const Points<TypeParam> three{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)};
    Points<TypeParam> notFinite = cubeCorners<TypeParam>(1);
    notFinite[2].x() = std::numeric_limits<typename TypeParam::Real>::quiet_NaN();
    for (const auto& points : {flat, line, point, three, notFinite})
        EXPECT_THROW(makeHull<TypeParam>(points), std::invalid_argument);
}

template <class S>
class Hull2d : public testing::Test {};
using Spaces2 = testing::Types<Space2f, Space2d>;
TYPED_TEST_SUITE(Hull2d, Spaces2);

TYPED_TEST(Hull2d, GridOfASquareIsASquare) {
    using R = typename TypeParam::Real;
    Random random{std::mt19937(9)};
    for (int trial = 0; trial < 20; ++trial) {
        const double angle = trial == 0 ? 0.0 : random.uniform(-3, 3), c = std::cos(angle),
                     s = std::sin(angle);
        Points<TypeParam> points;
        for (int x = -3; x <= 3; ++x)
            for (int y = -3; y <= 3; ++y)
                points.push_back({static_cast<R>(c * x - s * y), static_cast<R>(s * x + c * y)});
        std::shuffle(points.begin(), points.end(), random.generator);
        EXPECT_EQ(makeHull<TypeParam>(points).data->vertices.size(), 4u);
    }
}

TYPED_TEST(Hull2d, RandomPointsAreContained) {
    Random random{std::mt19937(13)};
    for (int count : {3, 4, 10, 200}) {
        Points<TypeParam> points;
        for (int i = 0; i < count; ++i) points.push_back(random.inBall<TypeParam>());
        const auto hull = makeHull<TypeParam>(points);
        const auto& h = *hull.data;
        double turned = 0;
        for (std::size_t i = 0; i < h.vertices.size(); ++i) {
            const std::size_t next = (i + 1) % h.vertices.size();
            for (const auto& p : points)
                EXPECT_LE(h.normals[i].dot(p - h.vertices[i]), tolerance<TypeParam>() * 2);
            EXPECT_NEAR(h.normals[i].norm(), 1.0, 1e-6);
            EXPECT_NEAR(h.normals[i].dot(h.vertices[next] - h.vertices[i]), 0.0, tolerance<TypeParam>());
            const auto& n0 = h.normals[i];
            const auto& n1 = h.normals[next];
            turned += std::atan2(static_cast<double>(n0.x() * n1.y() - n0.y() * n1.x()),
                                 static_cast<double>(n0.dot(n1)));
        }
        EXPECT_NEAR(turned, 2 * std::numbers::pi, 1e-5);  // once round, counter-clockwise
    }
}

TYPED_TEST(Hull2d, RefusesPointsOnALine) {
    using V = typename TypeParam::Vec;
    for (const auto& points : {Points<TypeParam>{V(0, 0), V(1, 2), V(2, 4), V(0.5, 1)},
                               Points<TypeParam>{V(0, 0), V(1, 0)}, Points<TypeParam>(5, V(1, 1))})
        EXPECT_THROW(makeHull<TypeParam>(points), std::invalid_argument);
}

}  // namespace
}  // namespace rigor::engine
