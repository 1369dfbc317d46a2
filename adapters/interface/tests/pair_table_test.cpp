// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/pair_table.hpp"

#include <gtest/gtest.h>

#include <random>

#include "adapters/interface/reach.hpp"

namespace rigor::adapter {
namespace {

/// Bodies of every type, some without shapes or contacts, some joined; materials with and without a pair.
Scenario crowd(unsigned seed) {
    std::mt19937 random(seed);
    const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    Scenario s;
    for (int i = 0; i < 4; ++i)
        s.materials.push_back({"m" + std::to_string(i), 0.1 * (i + 1), i == 3 ? 0.0 : 0.2 * i, 1000.0});
    s.pairs.push_back({1, 2, 0.77, 0.0});
    for (int i = 0; i < 8; ++i) {
        scenario::Body body;
        body.type = static_cast<scenario::BodyType>(upTo(3));
        body.collides = upTo(4) != 0;
        for (int k = upTo(3); k > 0; --k) {
            body.shapes.push_back({scenario::Sphere{1.0}, {}, upTo(4)});
            if (seed % 2 == 0) continue;
            const auto bits = [&] { return static_cast<std::uint32_t>(1 + upTo(7)); };
            body.shapes.back().filter = {bits(), bits(), upTo(5) - 2};
        }
        s.bodies.push_back(body);
    }
    for (int i = 0; i < 4; ++i) {
        scenario::Joint joint;
        joint.bodyA = upTo(8);
        joint.bodyB = (joint.bodyA + 1 + upTo(7)) % 8;
        joint.collideConnected = upTo(2) == 0;
        s.joints.push_back(joint);
    }
    return s;
}

TEST(PairTable, AgreesWithTheScenarioModel) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Scenario s = crowd(seed);
        const PairTable table(s);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const auto expected = pairCoefficients(s, a, b);
                EXPECT_EQ(table.coefficients(a, b).friction, expected.friction);
                EXPECT_EQ(table.coefficients(a, b).restitution, expected.restitution);
            }
        for (int a = 0; a < 8; ++a)
            for (int b = 0; b < 8; ++b) {
                if (a == b) continue;
                const bool shapes = !s.bodies[a].shapes.empty() && !s.bodies[b].shapes.empty();
                EXPECT_EQ(table.mayCollide(a, b), shapes && mayCollide(s, a, b))
                    << seed << " " << a << " " << b;
            }
    }
}

/// The table of a scenario that never had the joints which do not hold.
TEST(PairTable, JointsThatDoNotHoldKeepNothingApart) {
    int differing = 0;
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Scenario s = crowd(seed);
        Scenario left = s;
        left.joints.clear();
        for (std::size_t j = 0; j < s.joints.size(); j += 2) left.joints.push_back(s.joints[j]);
        PairTable table(s);
        const PairTable expected(left), whole(s);
        table.keepApart(s, [](std::size_t joint) { return joint % 2 == 0; });
        const int count = static_cast<int>(s.bodies.size());
        for (int a = 0; a < count; ++a)
            for (int b = 0; b < count; ++b) {
                if (a == b) continue;
                EXPECT_EQ(table.mayCollide(a, b), expected.mayCollide(a, b));
                differing += expected.mayCollide(a, b) != whole.mayCollide(a, b);
            }
    }
    EXPECT_GT(differing, 0);
}

TEST(PairTable, ExamplesNameShapesOfTheirMaterialsThatMayTouch) {
    std::size_t total = 0;
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Scenario s = crowd(seed);
        const PairTable table(s);
        std::vector<bool> bounces(8, false);
        for (const auto& m : table.examples()) {
            EXPECT_LE(m.materialA, m.materialB);
            EXPECT_TRUE(table.mayCollide(m.a.body, m.b.body));
            EXPECT_TRUE(mayTouch(s.bodies[m.a.body].shapes[m.a.shape], s.bodies[m.b.body].shapes[m.b.shape]));
            const auto materialOf = [&](const PairTable::ShapeRef& r) {
                return s.bodies[r.body].shapes[r.shape].material;
            };
            EXPECT_EQ(materialOf(m.a), m.materialA);
            EXPECT_EQ(materialOf(m.b), m.materialB);
            if (pairCoefficients(s, m.materialA, m.materialB).restitution > 0.0) {
                EXPECT_TRUE(table.mayBounce(m.a.body));
                EXPECT_TRUE(table.mayBounce(m.b.body));
            }
            ++total;
        }
    }
    EXPECT_GT(total, 50u);
}

TEST(Reach, CoversFreeFlight) {
    Scenario s;
    s.gravity = {0, -10, 0};
    s.duration = 2.0;
    scenario::Body body;
    body.pose.position = {0, 30, 0};
    body.velocity = {40, 0, 0};
    s.bodies = {body, body};
    s.bodies[1].pose.position = {0, 50, 0};
    const Reach reach = reachOf(s, 1.0, 1e6);
    EXPECT_EQ(reach.middle.y, 40.0);
    // The bound holds: after 2 s the first body is at (80, 10): 85.4 m from the middle.
    EXPECT_GE(reach.distance, 85.4);
    EXPECT_EQ(reachOf(s, 1.0, 60.0).distance, 60.0);
}

}  // namespace
}  // namespace rigor::adapter
