// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mass properties against sums over a fine grid of points, which know nothing of the closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "scenarios/model/hull.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool insideHull(const HullMesh& mesh, Vec3 p) {
    for (const auto& face : mesh.faces) {
        const auto at = [&](std::size_t i) { return mesh.vertices[face[i]]; };
        if (dot(cross(at(1) - at(0), at(2) - at(0)), p - at(0)) > 0.0) return false;
    }
    return true;
}

bool insidePolygon(const std::vector<Vec3>& loop, Vec3 p) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 a = loop[i], b = loop[(i + 1) % loop.size()];
        if (cross(b - a, p - a).z < 0.0) return false;
    }
    return true;
}

/// True if the point, in the shape's frame, is inside. Written from the definitions in scenario.hpp.
struct Inside {
    Vec3 p;
    int dimension;
    bool operator()(const Sphere& s) const { return norm(p) <= s.radius; }
    bool operator()(const Box& b) const {
        return std::abs(p.x) <= b.halfExtents.x && std::abs(p.y) <= b.halfExtents.y &&
               (dimension == 2 || std::abs(p.z) <= b.halfExtents.z);
    }
    bool operator()(const Capsule& c) const {
        const double y = std::abs(p.y) <= c.halfLength ? 0.0 : std::abs(p.y) - c.halfLength;
        return p.x * p.x + y * y + p.z * p.z <= c.radius * c.radius;
    }
    bool operator()(const Cylinder& c) const {
        return std::abs(p.y) <= c.halfLength && std::hypot(p.x, p.z) <= c.radius;
    }
    bool operator()(const Cone& c) const {
        const double share = (c.halfLength - p.y) / (2.0 * c.halfLength);
        return share >= 0.0 && share <= 1.0 && std::hypot(p.x, p.z) <= c.radius * share;
    }
    bool operator()(const ConvexHull&) const { return false; }  // prepared once: see insideTest
    bool operator()(const HalfSpace&) const { return false; }
    template <class Surface>
    bool operator()(const Surface&) const {
        return false;
    }
};

std::function<bool(Vec3)> insideTest(const Shape& shape, int dimension) {
    if (const auto* hull = std::get_if<ConvexHull>(&shape.geometry)) {
        if (dimension == 2)
            return [loop = convexHull2d(hull->vertices)](Vec3 p) { return insidePolygon(loop, p); };
        return [mesh = convexHull3d(hull->vertices)](Vec3 p) { return insideHull(mesh, p); };
    }
    return [&shape, dimension](Vec3 p) { return std::visit(Inside{p, dimension}, shape.geometry); };
}

/// Sums over the midpoints of a grid of n cells along each axis of [-1, 1]. Overlaps count twice, as the
/// shapes of a body do.
MassProperties byGrid(const std::vector<Shape>& shapes, const std::vector<Material>& materials, int dimension,
                      int n) {
    const double cell = 2.0 / n, content = dimension == 3 ? cell * cell * cell : cell * cell;
    MassProperties sum;
    Mat3 second;
    const auto add = [&](Vec3 p, double m) {
        sum.mass += m;
        sum.centerOfMass += m * p;
        const double v[3] = {p.x, p.y, p.z};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) second(i, j) += m * v[i] * v[j];
    };
    std::vector<std::function<bool(Vec3)>> inside;
    for (const Shape& shape : shapes) inside.push_back(insideTest(shape, dimension));
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < (dimension == 3 ? n : 1); ++k) {
                const Vec3 p{-1.0 + (i + 0.5) * cell, -1.0 + (j + 0.5) * cell,
                             dimension == 3 ? -1.0 + (k + 0.5) * cell : 0.0};
                for (std::size_t s = 0; s < shapes.size(); ++s)
                    if (inside[s](inverse(shapes[s].pose) * p))
                        add(p, content * materials[shapes[s].material].density);
            }
    sum.centerOfMass = sum.centerOfMass / sum.mass;
    const double c[3] = {sum.centerOfMass.x, sum.centerOfMass.y, sum.centerOfMass.z};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) second(i, j) -= sum.mass * c[i] * c[j];
    const double trace = second(0, 0) + second(1, 1) + second(2, 2);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum.inertia(i, j) = (i == j ? trace : 0.0) - second(i, j);
    return sum;
}

const std::vector<Material> kMaterials{{"light", 0, 0, 700.0}, {"dense", 0, 0, 2500.0}};

void expectAsOnGrid(const std::vector<Shape>& shapes, int dimension, int n, double tolerance) {
    const MassProperties exact = massPropertiesFromShapes(shapes, kMaterials, dimension);
    const MassProperties grid = byGrid(shapes, kMaterials, dimension, n);
    EXPECT_NEAR(exact.mass, grid.mass, tolerance * grid.mass);
    EXPECT_LT(norm(exact.centerOfMass - grid.centerOfMass), tolerance);
    const double scale = grid.inertia(2, 2);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (dimension == 3 || (i == 2 && j == 2)) {
                EXPECT_NEAR(exact.inertia(i, j), grid.inertia(i, j), 2.0 * tolerance * scale)
                    << i << "," << j;
            }
}

const Quat kTurn = normalized(Quat{0.8, 0.3, -0.4, 0.2});
const std::vector<Vec3> kOddHull{{-0.5, -0.3, -0.4}, {0.6, -0.35, -0.3}, {0.1, -0.4, 0.6},
                                 {0.0, 0.7, 0.1},    {0.0, 0.0, 0.0},    {-0.4, 0.3, 0.2}};

class Solid : public testing::TestWithParam<std::pair<const char*, Geometry>> {};

TEST_P(Solid, AgreesWithTheGridWhereverItLies) {
    // 120 cells an axis: measured at most 1.5e-3 of the mass, for the curved shapes.
    expectAsOnGrid({{GetParam().second, {{0.05, -0.1, 0.08}, kTurn}, 0}}, 3, 120, 4e-3);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Solid,
                         testing::Values(std::pair{"sphere", Geometry{Sphere{0.6}}},
                                         std::pair{"box", Geometry{Box{{0.5, 0.3, 0.2}}}},
                                         std::pair{"capsule", Geometry{Capsule{0.25, 0.4}}},
                                         std::pair{"cylinder", Geometry{Cylinder{0.4, 0.3}}},
                                         std::pair{"cone", Geometry{Cone{0.4, 0.5}}},
                                         std::pair{"hull", Geometry{ConvexHull{kOddHull}}}),
                         [](const auto& each) { return std::string(each.param.first); });

class Planar : public testing::TestWithParam<std::pair<const char*, Geometry>> {};

TEST_P(Planar, AgreesWithTheGridWhereverItLies) {
    const Pose pose{{0.05, -0.1, 0.0}, fromAxisAngle({0, 0, 1}, 0.7)};
    expectAsOnGrid({{GetParam().second, pose, 0}}, 2, 1200, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Planar,
    testing::Values(
        std::pair{"circle", Geometry{Sphere{0.6}}}, std::pair{"box", Geometry{Box{{0.5, 0.3, 0.0}}}},
        std::pair{"capsule", Geometry{Capsule{0.25, 0.4}}},
        std::pair{"polygon",
                  Geometry{ConvexHull{{{-0.5, -0.4, 0}, {0.7, -0.3, 0}, {0.2, 0.6, 0}, {-0.3, 0.5, 0}}}}}),
    [](const auto& each) { return std::string(each.param.first); });

TEST(MassProperties, CompoundOfTwoDensities) {
    expectAsOnGrid({{Box{{0.3, 0.1, 0.2}}, {{-0.3, 0.2, 0.1}, kTurn}, 0},
                    {Sphere{0.3}, {{0.5, -0.2, 0.0}, {}}, 1},
                    {Capsule{0.1, 0.3}, {{0.0, 0.4, -0.3}, conjugate(kTurn)}, 1}},
                   3, 120, 4e-3);
}

TEST(MassProperties, HullOfABoxIsTheBoxToRounding) {
    std::vector<Vec3> corners{{0.0, 0.0, 0.0}};  // an interior point must not count
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.3, 0.3})
            for (const double z : {-0.2, 0.2}) corners.push_back({x, y, z});
    const auto hull =
        massPropertiesFromShapes({{ConvexHull{corners}, {{0.1, 0.2, 0.3}, kTurn}, 0}}, kMaterials, 3);
    const auto box =
        massPropertiesFromShapes({{Box{{0.5, 0.3, 0.2}}, {{0.1, 0.2, 0.3}, kTurn}, 0}}, kMaterials, 3);
    EXPECT_NEAR(hull.mass, box.mass, 1e-12 * box.mass);
    EXPECT_LT(norm(hull.centerOfMass - box.centerOfMass), 1e-14);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(hull.inertia(i, j), box.inertia(i, j), 1e-12 * box.inertia(0, 0));
}

// Closed forms of reference problem 45, written here once more: a typing error in either shows.
TEST(MassProperties, CapsuleAndConeClosedForms) {
    const double r = 0.25, L = 0.5;
    const auto capsule = massPropertiesFromShapes({{Capsule{r, L / 2}, {}, 0}}, {{"m", 0, 0, 1.0}}, 3);
    const double mc = kPi * r * r * L, ms = 4.0 / 3.0 * kPi * r * r * r;
    EXPECT_NEAR(capsule.mass, mc + ms, 1e-15);
    EXPECT_NEAR(capsule.inertia(1, 1), mc * r * r / 2 + 2 * ms * r * r / 5, 1e-15);
    EXPECT_NEAR(capsule.inertia(0, 0),
                mc * (L * L / 12 + r * r / 4) + ms * (2 * r * r / 5 + L * L / 4 + 3 * L * r / 8), 1e-15);
    const auto cone = massPropertiesFromShapes({{Cone{0.3, 0.4}, {}, 0}}, {{"m", 0, 0, 1.0}}, 3);
    EXPECT_NEAR(cone.centerOfMass.y, -0.4 + 0.2, 1e-15);  // a quarter of the height above the base
    EXPECT_NEAR(cone.inertia(1, 1), 0.3 * cone.mass * 0.09, 1e-15);
}

TEST(MassProperties, ScaledToMassKeepsTheShape) {
    const auto unit = massPropertiesFromShapes({{Box{{0.5, 0.3, 0.2}}, {{0.2, 0, 0}, {}}, 0}}, kMaterials, 3);
    const auto scaled = scaledToMass(unit, 3.0);
    EXPECT_DOUBLE_EQ(scaled.mass, 3.0);
    EXPECT_EQ(scaled.centerOfMass, unit.centerOfMass);
    EXPECT_NEAR(scaled.inertia(2, 2), 3.0 * (0.25 + 0.09) / 3.0, 1e-14);
}

TEST(MassProperties, ShapesWithoutContentAreRefused) {
    EXPECT_THROW(massPropertiesFromShapes({{HalfSpace{}, {}, 0}}, kMaterials, 3), std::invalid_argument);
    EXPECT_THROW(massPropertiesFromShapes({{HeightField{}, {}, 0}}, kMaterials, 3), std::invalid_argument);
    EXPECT_THROW(massPropertiesFromShapes({{Segment{{0, 0, 0}, {1, 0, 0}}, {}, 0}}, kMaterials, 2),
                 std::invalid_argument);
    EXPECT_THROW(massPropertiesFromShapes({}, kMaterials, 3), std::invalid_argument);
}

}  // namespace
}  // namespace rigor::scenario
