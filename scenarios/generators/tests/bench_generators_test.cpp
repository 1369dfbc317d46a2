// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The generators of large scenes: counts, places, masses, and that the same file gives the same bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenarios/generators/generator.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

Scenario made(int dimension, const std::string& generator, const std::string& more = "") {
    const std::string zero = dimension == 2 ? "[0, -9.81]" : "[0, -9.81, 0]";
    return loadScenarioText(R"({"rigor": 1, "name": "t", "title": "t", "dimension": )" +
                                std::to_string(dimension) + R"(, "gravity": )" + zero +
                                R"(, "duration": 1, "dt": [0.01], )" + more + R"(
            "materials": {"m": {"friction": 0.5}}, "generators": [)" +
                                generator + "]}",
                            "t.json")
        .scenario;
}
std::string problemOf(int dimension, const std::string& generator) {
    try {
        (void)made(dimension, generator);
    } catch (const LoadError& error) {
        return error.what();
    }
    return "";
}
const Body& body(const Scenario& s, const std::string& name) {
    const int index = findBody(s, name);
    if (index == kNone) throw std::runtime_error("no body " + name);
    return s.bodies[index];
}
std::string ballOf(double radius) {
    return R"({"shapes": [{"sphere": {"radius": )" + std::to_string(radius) + "}}]}";
}
const std::string kDynamic =
    R"(, {"grid": {"name": "g", "counts": [1, 1, 1], "spacing": [1, 1, 1], "body": )" + ballOf(0.1) + "}}";
const std::string kDynamic2d =
    R"(, {"grid": {"name": "g", "counts": [1, 1], "spacing": [1, 1], "body": {"shapes": [{"circle": {"radius": 0.1}}]}}})";

/// Extent of a body whose shapes are boxes along the axes.
struct Span {
    Vec3 low, high;
};
std::vector<Span> spans(const Scenario& s, const std::string& prefix) {
    std::vector<Span> list;
    for (const Body& b : s.bodies) {
        if (!b.name.starts_with(prefix)) continue;
        for (const Shape& shape : b.shapes) {
            const Vec3 h = std::get<Box>(shape.geometry).halfExtents,
                       c = b.pose.position + shape.pose.position;
            list.push_back({c - h, c + h});
        }
    }
    return list;
}
bool inside(const Span& box, const Vec3& p, int dimension) {
    return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y &&
           (dimension == 2 || (p.z > box.low.z && p.z < box.high.z));
}

/// Expects that every ray from `from` in the given directions hits a box within `reach`, and that `from` is
/// in none.
void expectEnclosed(const std::vector<Span>& walls, const Vec3& from, int dimension, bool top, double reach) {
    for (int k = 0; k < 400; ++k) {
        const double a = 0.0157079632679 * k, e = dimension == 2 ? 0.0 : 1.5 * std::sin(2.39996 * k);
        const Vec3 d{std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
        if (!top && d.y > 0.0) continue;
        bool met = false;
        for (double t = 0.0; t < reach && !met; t += 0.05)
            for (const Span& wall : walls) met = met || inside(wall, from + t * d, dimension);
        EXPECT_TRUE(met) << d.x << " " << d.y << " " << d.z;
    }
    for (const Span& wall : walls) EXPECT_FALSE(inside(wall, from, dimension));
}

TEST(Container, EnclosesItsInsideButForTheTop) {
    const Scenario s =
        made(3, R"({"container": {"name": "c", "inside": [4, 6, 8], "thickness": 0.4}})" + kDynamic);
    EXPECT_EQ(s.bodies.size(), 6u);
    const auto walls = spans(s, "c_");
    ASSERT_EQ(walls.size(), 5u);
    for (const char* name : {"c_floor", "c_left", "c_right", "c_back", "c_front"})
        EXPECT_EQ(body(s, name).type, BodyType::Static);
    for (const double x : {-1.99, 0.0, 1.99})
        for (const double y : {0.01, 3.0, 5.99})
            for (const double z : {-3.99, 0.0, 3.99})
                for (const Span& wall : walls)
                    EXPECT_FALSE(inside(wall, {x, y, z}, 3)) << x << " " << y << " " << z;
    expectEnclosed(walls, {0, 0.1, 0}, 3, false, 12);
    EXPECT_NEAR(body(s, "c_floor").pose.position.y, -0.2, 1e-15);
    EXPECT_NEAR(body(s, "c_left").pose.position.x, -2.2, 1e-15);
    EXPECT_EQ(made(2, R"({"container": {"name": "c", "inside": [4, 6]}})" + kDynamic2d).bodies.size(), 4u);
    EXPECT_THAT(problemOf(3, R"({"container": {"name": "c", "inside": [4, 0, 8]}})"),
                testing::HasSubstr("/generators/0/container/inside: found array of 3, expected numbers > 0"));
}

TEST(Tumbler, IsOneClosedKinematicBody) {
    for (const int dimension : {2, 3}) {
        const bool solid = dimension == 3;
        const Scenario s =
            made(dimension, std::string(R"({"tumbler": {"name": "drum", "inside": )") +
                                (solid ? "[4, 6, 8]" : "[4, 6]") +
                                R"(, "thickness": 0.5, "speed": -0.7, "origin": )" +
                                (solid ? "[1, 2, 3]" : "[1, 2]") + "}}" + (solid ? kDynamic : kDynamic2d));
        const Body& drum = body(s, "drum");
        EXPECT_EQ(drum.type, BodyType::Kinematic);
        EXPECT_EQ(drum.angularVelocity, (Vec3{0, 0, -0.7}));
        EXPECT_EQ(drum.velocity, (Vec3{}));
        const auto walls = spans(s, "drum");
        EXPECT_EQ(walls.size(), solid ? 6u : 4u);
        expectEnclosed(walls, {1, 2, solid ? 3.0 : 0.0}, dimension, true, 8);
    }
}

TEST(HullPile, AllPointsAreCornersAndTheKindsTakeTurns) {
    const std::string text =
        R"({"hull_pile": {"name": "h", "kinds": 5, "vertices": 16, "radius": 0.55, "roughness": 0.1,
        "count": 12, "seed": 3, "columns": 2, "spacing": [1.3, 1.2, 1.3]}})";
    const Scenario s = made(3, text), again = made(3, text);
    ASSERT_EQ(s.bodies.size(), 12u);
    const auto corners = [](const Scenario& scene, std::size_t i) {
        return std::get<ConvexHull>(scene.bodies[i].shapes[0].geometry).vertices;
    };
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(corners(s, i).size(), 16u) << "points on a sphere are all corners";
        for (const Vec3& p : corners(s, i)) EXPECT_NEAR(norm(p), 0.55, 1e-14);
        EXPECT_EQ(corners(s, i), corners(s, i % 5));
        EXPECT_EQ(corners(s, i), corners(again, i));
        EXPECT_EQ(corners(s, i) == corners(s, 0), i % 5 == 0);
        // Bounds: the sphere inside any such hull and the sphere around it.
        const MassProperties& m = s.bodies[i].massProperties;
        EXPECT_LT(m.mass, 1000 * 4.18879 * std::pow(0.55, 3));
        EXPECT_GT(m.mass, 500 * 4.18879 * std::pow(0.55, 3));
        EXPECT_LT(norm(m.centerOfMass), 0.1);
    }
    EXPECT_THAT(
        problemOf(2, R"({"hull_pile": {"name": "h", "kinds": 5, "vertices": 16, "radius": 0.55, "count": 2,
        "seed": 1, "columns": 2, "spacing": [1, 1]}})"),
        testing::HasSubstr("[generator.dimension]"));
}

TEST(Pile, VariedExtentsStayWithinTheirShare) {
    const Scenario s = made(
        2, R"({"pile": {"name": "b", "count": 400, "seed": 7, "columns": 20, "spacing": [1, 1], "vary": 0.2,
        "bodies": [{"shapes": [{"circle": {"radius": 0.5}}]}, {"shapes": [{"box": {"half_extents": [0.5, 0.25]}}]}]}})");
    double least = 1.0, most = 0.0;
    for (const Body& b : s.bodies) {
        if (const auto* ball = std::get_if<Sphere>(&b.shapes[0].geometry)) {
            least = std::min(least, ball->radius);
            most = std::max(most, ball->radius);
            EXPECT_NEAR(b.massProperties.mass, 1000 * 3.14159265358979 * ball->radius * ball->radius, 1e-9);
        } else {
            const Vec3 h = std::get<Box>(b.shapes[0].geometry).halfExtents;
            EXPECT_GE(h.x, 0.4);
            EXPECT_LE(h.x, 0.6);
            EXPECT_GE(h.y, 0.2);
            EXPECT_LE(h.y, 0.3);
            EXPECT_NE(h.x, 2 * h.y) << "each extent by a number of its own";
        }
    }
    EXPECT_GE(least, 0.4);
    EXPECT_LT(least, 0.41);
    EXPECT_LE(most, 0.6);
    EXPECT_GT(most, 0.59);
}

TEST(Net, JoinsNeighboursHalfWay) {
    const Scenario s =
        made(3, R"({"net": {"name": "n", "counts": [4, 3], "across": [0.5, 0, 0], "down": [0, -0.4, 0.3],
        "origin": [1, 10, 2], "joint": "ball", "body": )" +
                    ballOf(0.1) + "}}");
    ASSERT_EQ(s.bodies.size(), 12u);
    EXPECT_EQ(s.joints.size(), 4u + 3u * 3u + 4u * 2u) << "row 0 to the world, across, down";
    EXPECT_LT(norm(body(s, "n_3_2").pose.position - Vec3{2.5, 9.2, 2.6}), 1e-14);
    std::set<std::pair<int, int>> pairs;
    for (const Joint& joint : s.joints) {
        EXPECT_TRUE(pairs.insert({joint.bodyA, joint.bodyB}).second);
        if (joint.bodyA == kNone) {
            EXPECT_LT(norm(joint.anchorB), 1e-14);
            continue;
        }
        EXPECT_LT(norm(joint.anchorA + joint.anchorB), 1e-14) << "half-way";
        EXPECT_NEAR(norm(joint.anchorA), 0.25, 1e-14);
    }
    EXPECT_EQ(
        made(3, R"({"net": {"name": "n", "counts": [4, 3], "across": [0.5, 0, 0], "down": [0, -0.4, 0.3],
        "anchored": false, "joint": "ball", "body": )" +
                    ballOf(0.1) + "}}")
            .joints.size(),
        17u);
    EXPECT_THAT(problemOf(3, R"({"net": {"name": "n", "counts": [4], "across": [1, 0, 0], "down": [0, 1, 0],
        "joint": "ball", "body": {}}})"),
                testing::HasSubstr("found array of 1, expected array of 2 numbers"));
}

TEST(Rain, ArrivesEvenlyAndStartsApart) {
    const Scenario s =
        made(3, R"({"rain": {"name": "r", "count": 200, "seed": 11, "columns": 5, "spacing": 1.2,
        "origin": [1, 2, 3], "interval": 0.02, "speed": 3, "turn": true, "bodies": [)" +
                    ballOf(0.5) + "]}}");
    ASSERT_EQ(s.bodies.size(), 200u);
    std::set<std::pair<double, double>> places;
    for (std::size_t i = 0; i < 200; ++i) {
        const Body& b = s.bodies[i];
        EXPECT_EQ(b.velocity, (Vec3{0, -3, 0}));
        // Free fall from there: when does it pass the height of the origin?
        const double h = b.pose.position.y - 2.0;
        EXPECT_NEAR((-3 + std::sqrt(9 + 2 * 9.81 * h)) / 9.81, 0.02 * static_cast<double>(i + 1), 1e-12);
        EXPECT_LE(std::abs(b.pose.position.x - 1), 2.4 + 1e-12);
        EXPECT_LE(std::abs(b.pose.position.z - 3), 2.4 + 1e-12);
        if (i < 25) places.insert({b.pose.position.x, b.pose.position.z});
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GE(norm(b.pose.position - s.bodies[k].pose.position), 1.0) << i << " " << k;
    }
    EXPECT_EQ(places.size(), 25u) << "every place once in a round";
    EXPECT_THAT(problemOf(3, R"({"rain": {"name": "r", "count": 0, "seed": 11, "columns": 5, "spacing": 1.2,
        "interval": 0.02, "speed": 3, "bodies": []}})"),
                testing::HasSubstr("[generator.empty]"));
}

TEST(Repeat, CopiesBodiesAndJointsWithTheirNames) {
    const std::string chain = R"({"chain": {"name": "l", "links": 3, "link_length": 0.5, "origin": [0, 5, 0],
        "direction": [1, 0, 0], "joint": "ball", "body": )" +
                              ballOf(0.1) + "}}";
    const Scenario
        one = made(3, chain),
        s = made(
            3,
            R"({"repeat": {"name": "c", "counts": [{"size": 1}, 1, 2], "spacing": [4, 0, 7], "generator": )" +
                chain + "}}",
            "\"size\": 3,");
    ASSERT_EQ(s.bodies.size(), 18u);
    ASSERT_EQ(s.joints.size(), 18u);
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 3; ++i)
            for (std::size_t n = 0; n < 3; ++n) {
                const std::string prefix = "c_" + std::to_string(i) + "_0_" + std::to_string(k) + "_";
                const Body& b = body(s, prefix + one.bodies[n].name);
                EXPECT_LT(norm(b.pose.position - one.bodies[n].pose.position - Vec3{4.0 * i, 0, 7.0 * k}),
                          1e-14);
                const auto found = std::find_if(s.joints.begin(), s.joints.end(), [&](const Joint& joint) {
                    return joint.name == prefix + one.joints[n].name;
                });
                ASSERT_NE(found, s.joints.end());
                EXPECT_EQ(s.bodies[found->bodyB].name, b.name);
                if (n == 0) {
                    EXPECT_EQ(found->bodyA, kNone);
                    EXPECT_LT(norm(found->anchorA - one.joints[n].anchorA - Vec3{4.0 * i, 0, 7.0 * k}),
                              1e-14);
                } else {
                    EXPECT_EQ(found->anchorA, one.joints[n].anchorA);
                }
            }
    EXPECT_THAT(
        problemOf(3,
                  R"({"repeat": {"name": "c", "counts": [100, 100, 7], "spacing": [4, 0, 7], "generator": )" +
                      chain + "}}"),
        testing::HasSubstr("[generator.size]"));
    EXPECT_THAT(
        problemOf(
            3,
            R"({"repeat": {"name": "c", "counts": [1, 1, 1], "spacing": [4, 0, 7], "generator": {"cloud": {}}}})"),
        testing::HasSubstr("[generator.unknown]"));
}

/// Each copy moves as a rigid body at first: no distance in it changes, its mean position rests, copies differ.
TEST(Repeat, SpinsCopiesAsRigidBodies) {
    const std::string chain = R"({"chain": {"name": "l", "links": 4, "link_length": 0.5, "origin": [0, 5, 0],
        "direction": [1, 0, 0], "joint": "ball", "anchored": false, "body": )" +
                              ballOf(0.1) + "}}";
    const std::string repeat =
        R"({"repeat": {"name": "c", "counts": [3, 1, 1], "spacing": [4, 0, 0], "generator": )";
    const Scenario s = made(3, repeat + chain + R"(, "spin": 2, "seed": 7}})");
    ASSERT_EQ(s.bodies.size(), 12u);
    for (std::size_t copy = 0; copy < 3; ++copy) {
        const Body* own = &s.bodies[4 * copy];
        const Vec3 w = own->angularVelocity;
        Vec3 mean;
        for (std::size_t n = 0; n < 4; ++n) {
            EXPECT_EQ(own[n].angularVelocity, w);
            mean = mean + own[n].velocity;
            const Vec3 apart = own[n].pose.position - own->pose.position;
            EXPECT_LT(norm(own[n].velocity - own->velocity - cross(w, apart)), 1e-14);
        }
        EXPECT_LT(norm(mean), 1e-14);
        EXPECT_GT(norm(own->velocity), 1e-3);
        EXPECT_LE(std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)}), 2.0);
        for (std::size_t other = 0; other < copy; ++other)
            EXPECT_GT(norm(w - s.bodies[4 * other].angularVelocity), 1e-3);
    }
    EXPECT_THAT(problemOf(3, repeat + chain + R"(, "spin": 2}})"), testing::HasSubstr("seed"));
}

/// Velocities that bodies have stay, static bodies get none, and 2D has one component.
TEST(Repeat, AddsTheSpinToTheVelocitiesOfDynamicBodies) {
    const Scenario s =
        made(2, R"({"repeat": {"name": "c", "counts": [2, 1], "spacing": [9, 0], "spin": 2, "seed": 7,
        "generator": {"group": {"bodies": [
            {"name": "left", "position": [-1, 3], "velocity": [5, 0], "angular_velocity": 4, "shapes": [{"circle": {"radius": 0.1}}]},
            {"name": "right", "position": [1, 3], "shapes": [{"circle": {"radius": 0.1}}]},
            {"name": "post", "type": "static", "position": [0, 7], "shapes": [{"circle": {"radius": 0.1}}]}]}}}})");
    for (const std::string copy : {"c_0_0_", "c_1_0_"}) {
        const Body &left = body(s, copy + "left"), &right = body(s, copy + "right");
        const double w = right.angularVelocity.z;
        EXPECT_GT(std::abs(w), 1e-3);
        EXPECT_NEAR(left.angularVelocity.z, 4 + w, 1e-14);
        EXPECT_LT(norm(right.velocity - Vec3{0, w, 0}), 1e-14);
        EXPECT_LT(norm(left.velocity - Vec3{5, -w, 0}), 1e-14);
        EXPECT_EQ(body(s, copy + "post").angularVelocity, Vec3{});
    }
    for (const std::string bad :
         {R"("position": "here")", R"("angular_velocity": "fast")", R"("velocity": 3)"})
        EXPECT_THAT(
            problemOf(2,
                      R"({"repeat": {"name": "c", "counts": [1, 1], "spacing": [9, 0], "spin": 2, "seed": 7,
        "generator": {"group": {"bodies": [{"name": "one", )" +
                          bad + R"(, "shapes": [{"circle": {"radius": 0.1}}]}]}}}})"),
            testing::HasSubstr("schema.type"))
            << bad;
}

TEST(Group, IsWhatIsWrittenOutAndWhatGeneratorsMake) {
    const std::string group = R"({"group": {
        "bodies": [{"name": "post", "position": [0, 3, 0], "shapes": [{"sphere": {"radius": 0.1}}]}],
        "joints": [{"name": "hook", "type": "ball", "a": "post", "b": "l_0", "anchor": [0, 2, 0]}],
        "generators": [{"chain": {"name": "l", "links": 2, "link_length": 0.5, "origin": [0, 2, 0],
            "direction": [0, -1, 0], "joint": "ball", "anchored": false, "body": )" +
                              ballOf(0.1) + "}}]}}";
    const Scenario s =
        made(3, R"({"repeat": {"name": "c", "counts": [2, 1, 1], "spacing": [4, 0, 0], "generator": )" +
                    group + "}}");
    ASSERT_EQ(s.bodies.size(), 6u);
    ASSERT_EQ(s.joints.size(), 4u);
    EXPECT_EQ(s.bodies[0].name, "c_0_0_0_post");
    EXPECT_EQ(s.bodies[3].name, "c_1_0_0_post");
    EXPECT_EQ(body(s, "c_1_0_0_post").pose.position.x, 4);
    const auto hook = std::find_if(s.joints.begin(), s.joints.end(),
                                   [](const Joint& joint) { return joint.name == "c_1_0_0_hook"; });
    ASSERT_NE(hook, s.joints.end());
    EXPECT_EQ(s.bodies[hook->bodyA].name, "c_1_0_0_post");
    EXPECT_EQ(s.bodies[hook->bodyB].name, "c_1_0_0_l_0");
    EXPECT_THAT(problemOf(3, R"({"group": {"shapes": []}})"), testing::HasSubstr("shapes"));
}

}  // namespace
}  // namespace rigor::scenario
