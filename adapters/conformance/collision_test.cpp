// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision queries against closed forms, in both orders and rotated.
#include <algorithm>
#include <cmath>
#include <limits>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/surface_points.hpp"

namespace rigor::conformance {
namespace {

using scenario::Box;
using scenario::Capsule;
using scenario::ConvexHull;
using scenario::HalfSpace;
using scenario::Sphere;

/// Two shapes whose distance along +x is `gap` when B stands at x = `touching` + gap.
struct PosedShapes {
    std::string name;
    std::string shapeA, shapeB;
    Geometry a, b;
    Quat turnA, turnB;
    double touching = 0.0;
};

ConvexHull cubeHull(double h, int dimension) {
    ConvexHull hull;
    if (dimension == 2) {
        hull.vertices = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
        return hull;
    }
    for (const double x : {-h, h})
        for (const double y : {-h, h})
            for (const double z : {-h, h}) hull.vertices.push_back({x, y, z});
    return hull;
}

std::vector<PosedShapes> posedShapes(int dimension) {
    const bool flat = dimension == 2;
    const double depth = flat ? 0.0 : 0.6;
    const Quat alongX = fromAxisAngle({0, 0, 1}, -kPi / 2);
    const std::string ball = flat ? "circle" : "sphere", half = flat ? "half_plane" : "half_space",
                      hull = flat ? "polygon" : "hull";
    const Box box{{0.4, 0.5, depth}};
    const HalfSpace wall{{1, 0, 0}, 0.0};
    const Sphere small{0.3};
    const Capsule pill{0.2, 0.5};
    return {
        {"ball_ball", ball, ball, Sphere{0.5}, small, {}, {}, 0.8},
        {"box_ball", "box", ball, box, small, {}, {}, 0.7},
        {"capsule_ball_side", "capsule", ball, pill, small, {}, {}, 0.5},
        {"capsule_ball_end", "capsule", ball, pill, small, alongX, {}, 1.0},
        {"capsule_capsule_end_side", "capsule", "capsule", pill, pill, {}, alongX, 0.9},
        {"capsule_capsule_parallel", "capsule", "capsule", pill, pill, {}, {}, 0.4},
        {"box_capsule_side", "box", "capsule", box, pill, {}, {}, 0.6},
        {"box_capsule_end", "box", "capsule", box, pill, {}, alongX, 1.1},
        {"box_box", "box", "box", box, Box{{0.3, 0.35, flat ? 0.0 : 0.25}}, {}, {}, 0.7},
        {"half_space_ball", half, ball, wall, small, {}, {}, 0.3},
        {"half_space_box", half, "box", wall, box, {}, {}, 0.4},
        {"half_space_capsule_side", half, "capsule", wall, pill, {}, {}, 0.2},
        {"half_space_capsule_end", half, "capsule", wall, pill, {}, alongX, 0.7},
        {"half_space_hull", half, hull, wall, cubeHull(0.5, dimension), {}, {}, 0.5},
        {"hull_ball", hull, ball, cubeHull(0.5, dimension), small, {}, {}, 0.8},
        {"hull_hull", hull, hull, cubeHull(0.5, dimension), cubeHull(0.3, dimension), {}, {}, 0.8},
        {"box_hull", "box", hull, box, cubeHull(0.3, dimension), {}, {}, 0.7},
    };
}

class Collision : public testing::TestWithParam<int> {
  protected:
    int dimension() const { return GetParam(); }
    Arena arena() const { return {"", dimension(), engine().info().precision}; }
    double tol(double f64, double f32) const { return arena().f64() ? f64 : f32; }
    void within(const std::string& check, double error, double tolerance) const {
        expectWithin(check, error, tolerance, arena());
    }
    static bool has(const std::string& shape) {
        const auto shapes = engine().capabilities().shapes;
        return std::find(shapes.begin(), shapes.end(), shape) != shapes.end();
    }
    /// Poses of the whole scene: turns that leave nothing aligned with the axes.
    std::vector<Pose> stages() const {
        if (dimension() == 2) return {{}, {{0.3, -0.7, 0}, fromAxisAngle({0, 0, 1}, 2.1)}};
        return {{}, {{0.3, -0.7, 0.5}, fromAxisAngle(Vec3{1, 2, -2} / 3.0, 2.1)}};
    }
    void checkContacts(const PosedShapes& m, const adapter::CollisionAnswer& answer,
                       const adapter::CollisionQuery& query, const Vec3& normal, double gap) const {
        ASSERT_FALSE(answer.contacts.empty());
        double deepest = 0.0;
        for (const ContactPoint& c : answer.contacts) {
            within(m.name + "_normal", norm(c.normal - normal), 1e-2);
            EXPECT_LE(norm(c.pointA - c.pointB - c.depth * c.normal), 1e-5) << m.name << ": points and depth";
            deepest = std::max(deepest, c.depth);
            const auto surface = [&](const adapter::PosedShape& shape, const Vec3& p) {
                if (dimension() == 2 && std::holds_alternative<Box>(*shape.geometry)) return 0.0;
                return std::abs(
                    adapter::pointDistance(*shape.geometry, inverse(shape.pose) * p).value_or(0.0));
            };
            within(m.name + "_points", std::max(surface(query.a, c.pointA), surface(query.b, c.pointB)),
                   1e-4);
        }
        within(m.name + "_depth", std::abs(deepest + gap), tol(1e-6, 1e-5));
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Collision,
                         testing::ValuesIn(engine().collision() ? queryDimensions() : std::vector<int>{}),
                         dimensionName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Collision);

TEST_P(Collision, PairsAnswerWithTheClosedForm) {
    int answered = 0;
    for (const PosedShapes& m : posedShapes(dimension())) {
        if (!has(m.shapeA) || !has(m.shapeB)) continue;
        for (const double gap : {-0.05, 0.05})
            for (const Pose& stage : stages())
                for (const bool swapped : {false, true}) {
                    SCOPED_TRACE(m.name + (swapped ? " swapped" : "") + ", gap " + std::to_string(gap));
                    adapter::CollisionQuery query;
                    query.dimension = dimension();
                    query.a = {&m.a, stage * Pose{{}, m.turnA}};
                    query.b = {&m.b, stage * Pose{{m.touching + gap, 0, 0}, m.turnB}};
                    Vec3 normal = rotate(stage.orientation, {1, 0, 0});
                    if (swapped) {
                        std::swap(query.a, query.b);
                        normal = -normal;
                    }
                    adapter::CollisionAnswer answer;
                    try {
                        answer = engine().collision()->collide(query);
                    } catch (const adapter::Unsupported&) {
                        continue;
                    }
                    ++answered;
                    within(m.name + "_overlap", answer.overlap == (gap < 0) ? 0.0 : 1.0, 0.0);
                    if (gap < 0 && answer.overlap) checkContacts(m, answer, query, normal, gap);
                    if (engine().capabilities().signedDistance) {
                        within(m.name + "_distance_told", answer.signedDistance.has_value() ? 0.0 : 1.0, 0.0);
                        if (answer.signedDistance)
                            within(m.name + (gap < 0 ? "_depth_distance" : "_gap"),
                                   std::abs(*answer.signedDistance - gap), tol(1e-5, 1e-4));
                    }
                }
    }
    EXPECT_GT(answered, 0);
}

TEST_P(Collision, ContactsNeverExceedTheRequest) {
    const Geometry box = Box{{0.5, 0.5, dimension() == 2 ? 0.0 : 0.5}};
    if (!has("box")) GTEST_SKIP() << "no boxes";
    for (const int most : {1, 2, 8}) {
        adapter::CollisionQuery query;
        query.dimension = dimension();
        query.maxContacts = most;
        query.a = {&box, {}};
        query.b = {&box, {{0.95, 0.1, 0}, {}}};
        const auto answer = engine().collision()->collide(query);
        EXPECT_TRUE(answer.overlap);
        EXPECT_GE(answer.contacts.size(), 1u);
        EXPECT_LE(answer.contacts.size(), static_cast<std::size_t>(most));
        for (const ContactPoint& c : answer.contacts)
            within("box_box_depths", std::abs(c.depth - 0.05), tol(1e-6, 1e-5));
    }
}

TEST_P(Collision, TheOtherDimensionIsRefusedOrAnsweredRight) {
    adapter::CollisionQuery query;
    query.dimension = 5 - dimension();
    const bool flat = query.dimension == 2;
    const Geometry box = Box{{0.5, 0.5, flat ? 0.0 : 0.5}};
    query.a = {&box, {}};
    query.b = {&box, {{0.95, 0.1, flat ? 0.0 : 2.0}, {}}};
    try {
        const auto answer = engine().collision()->collide(query);
        EXPECT_EQ(answer.overlap, flat);
        for (const ContactPoint& c : answer.contacts) EXPECT_NEAR(std::abs(c.normal.x), 1.0, 1e-3);
    } catch (const adapter::Unsupported&) {
    }
}

TEST_P(Collision, CoincidingBallsDoNotInventADirectionThatIsNoUnitVector) {
    const Geometry ball = Sphere{0.5};
    adapter::CollisionQuery query;
    query.dimension = dimension();
    query.a = query.b = {&ball, {}};
    const auto answer = engine().collision()->collide(query);
    EXPECT_TRUE(answer.overlap);
    for (const ContactPoint& c : answer.contacts) EXPECT_NEAR(norm(c.normal), 1.0, 1e-6);
}

TEST_P(Collision, BadQueriesAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Geometry good = Sphere{0.5}, flatBall = Sphere{0.0}, noHull = ConvexHull{};
    const auto runQuery = [&](const Geometry& geometry, const Pose& pose) {
        adapter::CollisionQuery query;
        query.dimension = dimension();
        query.a = {&good, {}};
        query.b = {&geometry, pose};
        return engine().collision()->collide(query);
    };
    EXPECT_THROW(runQuery(good, {{nan, 0, 0}, {}}), adapter::BadInput);
    EXPECT_THROW(runQuery(good, {{}, {0, 0, 0, 0}}), adapter::BadInput);
    EXPECT_THROW(runQuery(flatBall, {}), adapter::BadInput);
    EXPECT_THROW(runQuery(noHull, {}), adapter::BadInput);
}

}  // namespace
}  // namespace rigor::conformance
