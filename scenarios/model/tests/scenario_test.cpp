// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rigor::scenario {
namespace {

Scenario threeBodies() {
    Scenario s;
    s.materials = {{"wood", 0.4, 0.3, 700}, {"steel", 0.9, 0.8, 7800}};
    for (const char* name : {"a", "b", "c"}) {
        Body body;
        body.name = name;
        s.bodies.push_back(body);
    }
    return s;
}

TEST(PairCoefficients, RuleThenTable) {
    Scenario s = threeBodies();
    const auto rule = pairCoefficients(s, 0, 1);
    EXPECT_DOUBLE_EQ(rule.friction, std::sqrt(0.4 * 0.9));
    EXPECT_DOUBLE_EQ(rule.restitution, 0.3);
    s.pairs = {{1, 0, 0.25, 0.05}};
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 0}}) {  // unordered
        EXPECT_DOUBLE_EQ(pairCoefficients(s, a, b).friction, 0.25);
        EXPECT_DOUBLE_EQ(pairCoefficients(s, a, b).restitution, 0.05);
    }
    EXPECT_DOUBLE_EQ(pairCoefficients(s, 1, 1).friction, 0.9);
    EXPECT_EQ(pairCoefficients(s, 0, 1).staticFriction, 0) << "the same as friction";
    s.pairs.clear();
    s.materials[1].staticFriction = 1.6;
    EXPECT_DOUBLE_EQ(pairCoefficients(s, 0, 1).staticFriction, std::sqrt(0.4 * 1.6));
    EXPECT_EQ(pairCoefficients(s, 0, 0).staticFriction, 0);
    s.materials[0].rollingFriction = 0.01;
    s.materials[0].torsionalFriction = 0.02;
    EXPECT_EQ(pairCoefficients(s, 0, 1).rollingFriction, 0) << "both surfaces have a share in it";
    s.materials[1].rollingFriction = s.materials[1].torsionalFriction = 0.04;
    EXPECT_DOUBLE_EQ(pairCoefficients(s, 0, 1).rollingFriction, 0.02);
    EXPECT_DOUBLE_EQ(pairCoefficients(s, 0, 1).torsionalFriction, std::sqrt(8e-4));
    s.pairs = {{1, 0, 0.25, 0.05}};
    EXPECT_EQ(pairCoefficients(s, 0, 1).rollingFriction, 0) << "the table says none";
}

TEST(SurfaceVelocity, IsAFieldOfTheBodyFrame) {
    Shape belt;
    belt.surfaceVelocity = {{1, 0, 0}, {0, 0, 2}};
    const Pose body{{3, 0, 0}, fromAxisAngle({0, 0, 1}, std::acos(0.0))};
    // The local point (0, -1, 0) moves with (1, 0, 0) + (0, 0, 2) x (0, -1, 0) = (3, 0, 0), which points along y.
    const Vec3 v = surfaceVelocityAt(belt, body, {4, 0, 0});
    EXPECT_LT(norm(v - Vec3{0, 3, 0}), 1e-15);
    EXPECT_TRUE(belt.surfaceVelocity.moves());
    EXPECT_FALSE(Shape{}.surfaceVelocity.moves());
}

TEST(FindBody, ByName) {
    const Scenario s = threeBodies();
    EXPECT_EQ(findBody(s, "c"), 2);
    EXPECT_EQ(findBody(s, "d"), kNone);
}

TEST(MayCollide, DynamicBodiesThatNoJointKeepsApart) {
    Scenario s = threeBodies();
    s.bodies[1].type = BodyType::Static;
    s.bodies[2].type = BodyType::Kinematic;
    EXPECT_TRUE(mayCollide(s, 0, 1));
    EXPECT_TRUE(mayCollide(s, 2, 0));
    EXPECT_FALSE(mayCollide(s, 1, 2)) << "neither is dynamic";
    EXPECT_FALSE(mayCollide(s, 0, 0));
    s.joints.push_back({});
    s.joints[0].bodyA = 1;
    s.joints[0].bodyB = 0;
    EXPECT_FALSE(mayCollide(s, 0, 1));
    s.joints[0].collideConnected = true;
    EXPECT_TRUE(mayCollide(s, 0, 1));
    s.bodies[0].collides = false;
    EXPECT_FALSE(mayCollide(s, 0, 1));
}

TEST(Names, OfShapesByDimension) {
    EXPECT_STREQ(geometryName(Sphere{}, 3), "sphere");
    EXPECT_STREQ(geometryName(Sphere{}, 2), "circle");
    EXPECT_STREQ(geometryName(ConvexHull{}, 2), "polygon");
    EXPECT_STREQ(geometryName(HalfSpace{}, 2), "half_plane");
    EXPECT_STREQ(jointName(JointType::Slider), "slider");
}

}  // namespace
}  // namespace rigor::scenario
