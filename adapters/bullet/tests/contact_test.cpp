// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts as Bullet solves and reports them: each known trap has a test that fails without its workaround.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

constexpr double kG = 9.81;

/// Speed after over speed before the first impact of a ball dropped from 1 m.
double bounceRatio(double restitution, double dt, const std::string& options, double height = 1.0) {
    Scenario s = scene(0.0, restitution);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Sphere{0.5}, {0, 0.5 + height, 0}, 1.0, even(sphereMoment(1.0, 0.5)));
    Simulation run(s, dt, options);
    for (int i = 0; i < static_cast<int>(1.0 / dt); ++i) {
        const double before = run.state(1).velocity.y;
        run.steps(1);
        const double after = run.state(1).velocity.y;
        // The impact may take two steps where speculative contacts brake first.
        if (after > before + 0.5) {
            run.steps(1);
            const double next = run.state(1).velocity.y;
            return -std::max(after, next) / before;
        }
    }
    return -1.0;
}

TEST(BulletRestitution, RatioIsThePairsCoefficientInMatched) {
    for (const double e : {0.3, 0.7, 1.0})
        for (const double dt : {1.0 / 60, 1.0 / 240})
            EXPECT_NEAR(bounceRatio(e, dt, "preset=matched"), e, 1e-3) << e << " " << dt;
}

TEST(BulletRestitution, SpeculativeContactsOrBaumgarteWouldSpoilIt) {
    // If the last step before the impact leaves a gap, gap/dt is missing from the rebound. (Case of a plane:
    // the box in its place is the child of a compound, whose boxes have to overlap first.)
    double with = 1.0, without = 1.0;
    for (const double height : {1.0, 1.003, 1.006, 1.009, 1.012}) {
        const auto least = [&](const std::string& options) {
            return bounceRatio(1.0, 1.0 / 240, "preset=matched,half_space=plane" + options, height);
        };
        with = std::min(with, least(",speculative_contacts=on"));
        without = std::min(without, least(""));
    }
    EXPECT_LT(with, 0.5);
    EXPECT_NEAR(without, 1.0, 1e-3);
    EXPECT_GT(bounceRatio(1.0, 1.0 / 60, "preset=matched,split_impulse_threshold=-0.04"), 1.02);
}

TEST(BulletRestitution, NoVelocityThresholdInMatched) {
    for (const bool matched : {true, false}) {
        Scenario s = scene(0.0, 1.0);
        s.gravity = {};
        addBody(s, Sphere{0.5}, {0, 0, 0}, 1.0, even(0.1));
        addBody(s, Sphere{0.5}, {0.999, 0, 0}, 1.0, even(0.1));
        s.bodies[0].velocity = {0.1, 0, 0};
        Simulation run(s, 1.0 / 240, matched ? "preset=matched" : "preset=matched,restitution_threshold=0.2");
        run.steps(5);
        // Equal masses exchange their velocities; below the threshold they share it.
        EXPECT_NEAR(run.state(1).velocity.x, matched ? 0.1 : 0.05, 1e-4);
    }
}

TEST(BulletRestitution, NothingReboundsAtZero) {
    Scenario s = scene(0.0, 0.0);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 1.5, 0}, 1.0, even(1.0 / 6));
    Simulation run(s, 1.0 / 60);
    double fastest = -1e9;
    for (int i = 0; i < 120; ++i) fastest = std::max(fastest, run.steps(1).state(1).velocity.y);
    EXPECT_LT(fastest, 1e-3);
}

/// A tilted cube dropped without sideways velocity: with one friction row Bullet finds no sliding direction
/// and holds one fixed tangent, along which nothing happens.
double tiltedCubeTravel(const std::string& options) {
    Scenario s = scene(0.5, 0.0);
    s.gravity = {0, 0, -kG};
    addStatic(s, Box{{5, 5, 0.5}}, {0, 0, -0.5});
    addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 0, 1.2}, 1.0, even(1.0 / 6));
    s.bodies[1].pose.orientation = scenario::fromAxisAngle({0, 1, 0}, -0.3);
    Simulation run(s, 1.0 / 240, options);
    run.seconds(3);
    return run.state(1).position.x;
}

TEST(BulletFriction, TwoDirectionsHoldAnImpactWithoutSliding) {
    EXPECT_NEAR(std::abs(tiltedCubeTravel("preset=matched")), 0.21, 0.02);
    EXPECT_LT(std::abs(tiltedCubeTravel("preset=matched,friction_directions=1")), 0.1);
}

TEST(BulletFriction, SlidingStopsWhereTheSchemeSaysInEveryDirection) {
    const double mu = 0.5, dt = 1.0 / 240;
    double expected = 0.0;
    for (double v = 4.0 - mu * kG * dt; v > 0.0; v -= mu * kG * dt) expected += v * dt;
    for (const double angle : {0.0, 0.4, 0.785398}) {
        Scenario s = scene(mu, 0.0);
        addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
        const Vec3 half{0.5, 0.25, 0.5};
        addBody(s, Box{half}, {0, 0.25, 0}, 2.0, boxMoments(2.0, half));
        s.bodies[1].velocity = {4 * std::cos(angle), 0, 4 * std::sin(angle)};
        Simulation run(s, dt);
        run.seconds(1.5);
        const Vec3 p = run.state(1).position;
        EXPECT_NEAR(std::hypot(p.x, p.z), expected, 2e-3) << angle;
        EXPECT_NEAR(-std::sin(angle) * p.x + std::cos(angle) * p.z, 0.0, 1e-4) << angle;
    }
}

/// A box on an incline of tan 0.5: two materials just below and above.
TEST(BulletFriction, InclineSticksAndSlipsAtThePairsCoefficient) {
    const double angle = std::atan(0.5);
    for (const double mu : {0.51, 0.4}) {
        Scenario s = scene(9.0, 0.0);  // the combination rule would give something else
        s.materials.push_back({"other", 7.0, 0.0, 1000.0});
        s.pairs.push_back({0, 1, mu, 0.0});
        s.gravity = {kG * std::sin(angle), -kG * std::cos(angle), 0};
        addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
        const Vec3 half{0.5, 0.1, 0.5};
        addBody(s, Box{half}, {0, 0.1, 0}, 1.0, boxMoments(1.0, half));
        s.bodies[1].shapes[0].material = 1;
        Simulation run(s, 1.0 / 240);
        run.seconds(1);
        const double slip = kG * (std::sin(angle) - 0.4 * std::cos(angle));
        if (mu > 0.5)
            EXPECT_NEAR(run.state(1).position.x, 0.0, 2e-3);
        else
            EXPECT_NEAR(run.state(1).velocity.x, slip, 0.01 * slip);
    }
}

/// One body, two feet of different materials, dragged over the floor: each foot has its own coefficient.
Scenario twoFeet() {
    Scenario s = scene(0.0, 0.0);
    s.materials.push_back({"slippery", 0.0, 0.0, 1000.0});
    s.materials.push_back({"rough", 0.0, 0.0, 1000.0});
    s.pairs = {{0, 1, 0.0, 0.25}, {0, 2, 0.6, 0.0}, {1, 2, 0.3, 0.5}};
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Box{{0.1, 0.1, 0.1}}, {0, 0.0999, 0}, 1.0, {1, 1, 1});
    auto& shapes = s.bodies[1].shapes;
    shapes[0].pose.position = {-1, 0, 0};
    shapes[0].material = 1;
    shapes.push_back(shapeOf(Box{{0.1, 0.1, 0.1}}, 2, {{1, 0, 0}, {}}));
    s.bodies[1].velocity = {0, 0, 3};
    return s;
}

TEST(BulletFriction, ChildrenOfACompoundHaveTheirOwnMaterials) {
    Simulation run(twoFeet(), 1.0 / 240);
    run.steps(1);
    double normal[2] = {0, 0}, friction[2] = {0, 0};
    for (const auto& c : run.contacts()) {
        ASSERT_EQ(c.bodyA, 0);
        ASSERT_EQ(c.bodyB, 1);
        normal[c.shapeB] += c.normalImpulse;
        friction[c.shapeB] += c.frictionImpulse.z;
    }
    ASSERT_GT(normal[0], 0.0);
    ASSERT_GT(normal[1], 0.0);
    EXPECT_NEAR(friction[0], 0.0, 1e-9);
    EXPECT_NEAR(friction[1], -0.6 * normal[1], 1e-4 * normal[1]);
}

TEST(BulletReadBack, PairsAreWhatBulletWillUse) {
    Simulation run(twoFeet(), 1.0 / 240);
    // A second world with other pairs in the same process: Bullet's callback is shared by both.
    Scenario other = twoFeet();
    for (auto& pair : other.pairs) {
        pair.friction = 0.9;
        pair.restitution = 0.1;
    }
    Simulation second(other, 1.0 / 240);
    const auto pairs = run.world->readBack().pairs;
    ASSERT_EQ(pairs.size(), 2u);  // the feet never collide with each other
    EXPECT_EQ(pairs[0].materialB, 1);
    EXPECT_NEAR(pairs[0].friction, 0.0, 1e-7);
    EXPECT_NEAR(pairs[0].restitution, 0.25, 1e-7);
    EXPECT_EQ(pairs[1].materialB, 2);
    EXPECT_NEAR(pairs[1].friction, 0.6, 1e-7);
    for (const auto& pair : second.world->readBack().pairs) EXPECT_NEAR(pair.friction, 0.9, 1e-7);
}

struct Resting {
    const char* name;
    Geometry geometry;
    double height;
    double tolerance;  ///< tolerance in double precision [m]
};
void PrintTo(const Resting& r, std::ostream* out) {
    *out << r.name;
}

class BulletResting : public testing::TestWithParam<Resting> {};

TEST_P(BulletResting, StandsAtItsHeightInMatched) {
    for (const bool onBox : {false, true}) {
        Scenario s = scene(0.5, 0.0);
        if (onBox)
            addStatic(s, Box{{5, 0.5, 5}}, {0, -0.5, 0});
        else
            addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
        const double h = GetParam().height;
        addBody(s, GetParam().geometry, {0, h + 0.01, 0}, 1.0, even(1.0 / 6));
        const double dt = 1.0 / 240;
        Simulation run(s, dt);
        run.seconds(2);
        EXPECT_NEAR(run.state(1).position.y, h, tol(GetParam().tolerance, 2e-4)) << onBox;
        double sum = 0.0;
        for (const auto& c : run.contacts()) sum += c.normalImpulse;
        EXPECT_NEAR(sum, kG * dt, 5e-3 * kG * dt) << onBox;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BulletResting,
                         testing::Values(Resting{"sphere", Sphere{0.5}, 0.5, 1e-8},
                                         Resting{"box", Box{{0.5, 0.5, 0.5}}, 0.5, 1e-8},
                                         Resting{"hull", boxHull({0.5, 0.5, 0.5}), 0.5, 1e-8},
                                         Resting{"cylinder", Cylinder{0.5, 0.5}, 0.5, 1e-4},
                                         Resting{"cone", scenario::Cone{0.5, 0.5}, 0.5, 1e-5},
                                         Resting{"capsule", Capsule{0.2, 0.3}, 0.5, 1e-8}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Bullet grows hulls by their margin: on each other they stand 0.08 m too high.
TEST(BulletMargin, HullsRestOnHullsWithoutAGapInMatched) {
    for (const bool matched : {true, false}) {
        Scenario s = scene(0.5, 0.0);
        addStatic(s, boxHull({2, 0.5, 2}), {0, -0.5, 0});
        addBody(s, boxHull({0.5, 0.5, 0.5}), {0, 0.6, 0}, 1.0, even(1.0 / 6));
        Simulation run(s, 1.0 / 240, matched ? "preset=matched" : "");
        run.seconds(2);
        EXPECT_NEAR(run.state(1).position.y, matched ? 0.5 : 0.58, tol(1e-4, 1e-3));
        EXPECT_EQ(run.ledgerLine("hull_margin")->realisation,
                  matched ? adapter::Realisation::Exact : adapter::Realisation::Approximate);
    }
}

/// btStaticPlaneShape gives a cube one contact point in the first step: a flat drop starts to spin.
TEST(BulletHalfSpace, FlatDropStaysFlatInMatched) {
    for (const bool box : {true, false}) {
        Scenario s = scene(0.5, 0.0);
        addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
        addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 1.5, 0}, 1.0, even(1.0 / 6));
        Simulation run(s, 1.0 / 240, box ? "preset=matched" : "preset=matched,half_space=plane");
        double fastest = 0.0;
        for (int i = 0; i < 150; ++i)
            fastest = std::max(fastest, norm(run.steps(1).state(1).angularVelocity));
        if (box)
            EXPECT_LT(fastest, tol(1e-9, 1e-3));
        else
            EXPECT_GT(fastest, 1.0);
    }
}

TEST(BulletHalfSpace, TiltedHalfSpacesAreWhereTheScenarioPutsThem) {
    const Vec3 normal = Vec3{-0.6, 0.8, 0.0};
    for (const char* options : {"preset=matched", "preset=matched,half_space=plane"}) {
        Scenario s = scene(0.0, 0.0);
        s.gravity = -kG * normal;
        addStatic(s, HalfSpace{{0, 1, 0}, 0.3}, {1, 2, 3});
        s.bodies[0].pose.orientation = scenario::fromAxisAngle({0, 0, 1}, std::atan2(0.6, 0.8));
        const Vec3 onPlane = s.bodies[0].pose * Vec3{0.4, 0.3, -0.2};
        addBody(s, Sphere{0.25}, onPlane + 0.27 * normal, 1.0, even(0.025));
        Simulation run(s, 1.0 / 240, options);
        run.seconds(1);
        EXPECT_NEAR(norm(run.state(1).position - (onPlane + 0.25 * normal)), 0.0, tol(1e-4, 1e-3)) << options;
        ASSERT_EQ(run.contacts().size(), 1u);
        EXPECT_NEAR(norm(run.contacts()[0].normal - normal), 0.0, tol(1e-6, 1e-4));
    }
}

TEST(BulletContacts, PointFromAToBWhicheverBodyComesFirst) {
    for (const bool ballFirst : {true, false}) {
        Scenario s = scene(0.5, 0.0);
        s.gravity = {};
        const auto addBall = [&] { addBody(s, Sphere{0.5}, {0, 0.45, 0}, 1.0, even(0.1)); };
        if (ballFirst) addBall();
        addStatic(s, Box{{2, 0.5, 2}}, {0, -0.5, 0});
        if (!ballFirst) addBall();
        s.bodies[ballFirst ? 0 : 1].velocity = {1, -2, 0};
        Simulation run(s, 1.0 / 240);
        EXPECT_TRUE(run.contacts().empty());
        run.steps(1);
        const auto contacts = run.contacts();
        ASSERT_EQ(contacts.size(), 1u);
        const ContactPoint& c = contacts[0];
        const double up = ballFirst ? -1.0 : 1.0;  // A to B
        EXPECT_EQ(c.bodyA, 0);
        EXPECT_EQ(c.bodyB, 1);
        EXPECT_NEAR(norm(c.normal - Vec3{0, up, 0}), 0.0, tol(1e-9, 1e-5));
        EXPECT_NEAR(c.depth, 0.05, tol(1e-9, 1e-5));
        EXPECT_NEAR(dot(c.pointA - c.pointB, c.normal), c.depth, tol(1e-9, 1e-5));
        EXPECT_NEAR((ballFirst ? c.pointA : c.pointB).y, -0.05, tol(1e-9, 1e-5));
        // m v is taken off by the normal impulse, friction pushes against the sliding on B.
        EXPECT_NEAR(c.normalImpulse, 2.0, 1e-4);
        const double onBall = ballFirst ? -c.frictionImpulse.x : c.frictionImpulse.x;
        EXPECT_LT(onBall, -0.05);
        EXPECT_NEAR(run.state(ballFirst ? 0 : 1).velocity.x, 1.0 + onBall, 1e-5);
        EXPECT_NEAR(c.frictionImpulse.y, 0.0, 1e-9);
    }
}

TEST(BulletContacts, BeltDragsABoxToItsSpeed) {
    Scenario s = scene(0.5, 0.0);
    addStatic(s, Box{{50, 0.5, 5}}, {0, -0.5, 0});
    s.bodies[0].type = BodyType::Kinematic;
    s.bodies[0].velocity = {1, 0, 0};
    addBody(s, Box{{0.5, 0.25, 0.5}}, {0, 0.25, 0}, 1.0, boxMoments(1.0, {0.5, 0.25, 0.5}));
    const double dt = 1.0 / 240;
    Simulation run(s, dt);
    run.seconds(0.1);
    EXPECT_NEAR(run.state(1).velocity.x, 0.5 * kG * 0.1, 1e-3);  // still sliding: mu g t
    run.seconds(1);
    EXPECT_NEAR(run.state(1).velocity.x, 1.0, 1e-4);
}

TEST(BulletContacts, PlanarContactsAreReportedOnce) {
    Scenario s = scene(0.5, 0.0, 2);
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Box{{0.5, 0.5, 0}}, {0, 0.5, 0}, 1.0, even(1.0 / 6));
    const double dt = 1.0 / 240;
    Simulation run(s, dt);
    run.seconds(1);
    const auto contacts = run.contacts();
    ASSERT_EQ(contacts.size(), 2u);  // four on the prism
    double sum = 0.0;
    for (const auto& c : contacts) {
        sum += c.normalImpulse;
        EXPECT_EQ(c.pointA.z, 0.0);
        EXPECT_NEAR(std::abs(c.pointB.x), 0.5, 1e-4);
    }
    EXPECT_NEAR(sum, kG * dt, 1e-4 * kG * dt);
}

TEST(BulletContacts, BodiesThatDoNotCollidePassThrough) {
    Scenario s = scene();
    addStatic(s, HalfSpace{{0, 1, 0}, 0.0});
    addBody(s, Sphere{0.5}, {0, 0.6, 0});
    s.bodies[1].collides = false;
    Simulation run(s, 1.0 / 60);
    run.seconds(1);
    EXPECT_LT(run.state(1).position.y, -3.0);
    EXPECT_TRUE(run.contacts().empty());
}

}  // namespace
}  // namespace rigor::test
