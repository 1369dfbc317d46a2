// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/read_back.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace rigor::validation {
namespace {

scenario::Scenario oneBlock() {
    scenario::Scenario s;
    s.gravity = {0, -9.81, 0};
    s.materials = {{"wood", 0.4, 0.25, 1000.0}, {"steel", 0.9, 0.5, 7800.0}};
    scenario::Body b;
    b.name = "block";
    b.pose = {{1, 2, 3}, scenario::fromAxisAngle({0, 0.6, 0.8}, 0.7)};
    b.velocity = {4, 0, 0};
    b.angularVelocity = {0, 5, 0};
    b.gravityScale = 0.5;
    b.massProperties = {2.0, {0, 0.125, 0}, scenario::Mat3::diagonal(1e-4, 2e-4, 3e-4)};
    s.bodies = {b};
    return s;
}

adapter::ReadBack faithful(const scenario::Scenario& s) {
    adapter::ReadBack back;
    for (const auto& b : s.bodies)
        back.bodies.push_back({b.massProperties.mass,
                               b.massProperties.centerOfMass,
                               b.massProperties.inertia,
                               {b.pose.position, b.pose.orientation, b.velocity, b.angularVelocity},
                               b.gravityScale * s.gravity});
    back.pairs = {{0, 1, 0.6, 0.25}};  // sqrt(0.4 * 0.9), min(0.25, 0.5)
    return back;
}

std::vector<std::string> wrong(const std::vector<results::ReadBackRow>& rows) {
    std::vector<std::string> names;
    for (const auto& r : rows)
        if (!r.ok) names.push_back(r.quantity);
    return names;
}

TEST(ReadBack, AFaithfulBuildHasEveryQuantityAndNoMismatch) {
    const auto s = oneBlock();
    const auto rows = compareReadBack(s, faithful(s), readBackTolerance("f64"));
    std::vector<std::string> quantities;
    for (const auto& r : rows) quantities.push_back(r.quantity);
    EXPECT_THAT(quantities, testing::UnorderedElementsAre("mass", "position", "orientation", "velocity",
                                                          "angular_velocity", "com", "inertia", "gravity",
                                                          "friction", "restitution"));
    EXPECT_THAT(wrong(rows), testing::IsEmpty());
}

struct Tampering {
    const char* quantity;
    std::function<void(adapter::ReadBack&)> tamper;
};

class TamperedReadBack : public testing::TestWithParam<Tampering> {};

/// Each quantity alone, off by a relative 1e-7: found in double, forgiven in single precision.
TEST_P(TamperedReadBack, IsFoundAndNamed) {
    const auto s = oneBlock();
    auto back = faithful(s);
    GetParam().tamper(back);
    EXPECT_THAT(wrong(compareReadBack(s, back, readBackTolerance("f64"))),
                testing::ElementsAre(GetParam().quantity));
    EXPECT_THAT(wrong(compareReadBack(s, back, readBackTolerance("f32"))), testing::IsEmpty());
}

constexpr double kOff = 1.0 + 1e-7;
INSTANTIATE_TEST_SUITE_P(
    Quantities, TamperedReadBack,
    testing::Values(Tampering{"mass", [](auto& b) { b.bodies[0].mass *= kOff; }},
                    Tampering{"com", [](auto& b) { b.bodies[0].centerOfMass.y *= kOff; }},
                    Tampering{"inertia", [](auto& b) { b.bodies[0].inertia(2, 2) *= kOff; }},
                    Tampering{"inertia", [](auto& b) { b.bodies[0].inertia(0, 1) = 1e-11; }},
                    Tampering{"position", [](auto& b) { b.bodies[0].state.position.z *= kOff; }},
                    Tampering{"orientation", [](auto& b) { b.bodies[0].state.orientation.w += 1e-7; }},
                    Tampering{"velocity", [](auto& b) { b.bodies[0].state.velocity.x *= kOff; }},
                    Tampering{"angular_velocity",
                              [](auto& b) { b.bodies[0].state.angularVelocity.y *= kOff; }},
                    Tampering{"gravity", [](auto& b) { b.bodies[0].gravity.y *= kOff; }},
                    Tampering{"friction", [](auto& b) { b.pairs[0].friction *= kOff; }},
                    Tampering{"restitution", [](auto& b) { b.pairs[0].restitution *= kOff; }}));

TEST(ReadBack, TheOppositeQuaternionIsTheSameOrientation) {
    const auto s = oneBlock();
    auto back = faithful(s);
    auto& q = back.bodies[0].state.orientation;
    q = {-q.w, -q.x, -q.y, -q.z};
    EXPECT_THAT(wrong(compareReadBack(s, back, 1e-9)), testing::IsEmpty());
}

TEST(ReadBack, InThePlaneOnlyThePlanarInertiaCounts) {
    auto s = oneBlock();
    s.dimension = 2;
    auto back = faithful(s);
    back.bodies[0].inertia = scenario::Mat3::diagonal(0, 0, 3e-4);
    EXPECT_THAT(wrong(compareReadBack(s, back, 1e-9)), testing::IsEmpty());
}

TEST(ReadBack, NaNIsAMismatchAndSoIsAMissingBody) {
    const auto s = oneBlock();
    auto back = faithful(s);
    back.bodies[0].inertia(1, 1) = std::nan("");
    back.bodies[0].mass = std::nan("");
    EXPECT_THAT(wrong(compareReadBack(s, back, 1e-5)), testing::UnorderedElementsAre("mass", "inertia"));
    back.bodies.clear();
    EXPECT_THAT(wrong(compareReadBack(s, back, 1e-5)), testing::ElementsAre("bodies"));
}

/// A hundred bodies, one wrong: a handful of rows, the wrong one among them.
TEST(ReadBack, LargeScenesAreCondensed) {
    auto s = oneBlock();
    for (int i = 1; i < 100; ++i) {
        s.bodies.push_back(s.bodies[0]);
        s.bodies.back().name = "b" + std::to_string(i);
    }
    auto back = faithful(s);
    back.bodies[57].mass = 3.0;
    const auto rows = compareReadBack(s, back, 1e-9);
    EXPECT_LT(rows.size(), 15u);
    EXPECT_EQ(readBackProblem(rows, {}), "read-back, mass of b57: found 3, expected 2");
}

}  // namespace
}  // namespace rigor::validation
