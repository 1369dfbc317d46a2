// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Starts beside a start: the published numbers of the generator, within their size, each time the same, and
// still scenarios whose joints hold.
#include "validation/chaos/perturb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/chaos/philox.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

Scenario libraryScenario(const std::string& name) {
    return loadScenario(findScenario(name)).scenario;
}

/// Known results of Random123 (kat_vectors, philox4x32 10).
TEST(Philox, GivesThePublishedNumbers) {
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (PhiloxBlock{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
    constexpr std::uint32_t f = 0xffffffffu;
    EXPECT_EQ(philox({f, f, f, f}, {f, f}),
              (PhiloxBlock{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
    EXPECT_EQ(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
              (PhiloxBlock{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
    EXPECT_EQ(philoxUniform(0), -philoxUniform(f));
    EXPECT_GT(philoxUniform(0), -1.0);
}

TEST(Perturbed, IsAFunctionOfItsNumber) {
    const Scenario s = libraryScenario("pile");
    const Perturbation size{1e-3, 0.0, 0.0, 0.0};
    const Scenario one = perturbed(s, size, 7, 3), again = perturbed(s, size, 7, 3);
    const Scenario other = perturbed(s, size, 7, 4), seed = perturbed(s, size, 8, 3);
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        EXPECT_EQ(one.bodies[i].pose, again.bodies[i].pose);
        const Vec3 d = one.bodies[i].pose.position - s.bodies[i].pose.position;
        if (s.bodies[i].type != BodyType::Dynamic) {
            EXPECT_EQ(norm(d), 0.0);
            continue;
        }
        EXPECT_NE(one.bodies[i].pose, other.bodies[i].pose);
        EXPECT_NE(one.bodies[i].pose, seed.bodies[i].pose);
        for (const double x : {d.x, d.y, d.z}) {
            EXPECT_LE(std::abs(x), 1e-3 * (1.0 + 1e-9));
            sum += x;
            squares += x * x;
            ++count;
        }
    }
    // Uniform: mean 0, variance a^2/3, each within four standard errors.
    EXPECT_LT(std::abs(sum / count), 4.0 * 1e-3 / std::sqrt(3.0 * count));
    EXPECT_NEAR(squares / count, 1e-6 / 3.0, 4.0 * 1e-6 * std::sqrt(4.0 / 45.0 / count));
}

/// Anchors coincide, or the loader would refuse the file; the links keep their angles to each other.
TEST(Perturbed, JoinedBodiesMoveAsOne) {
    for (const char* name : {"double_pendulum_2d", "pendulum_chain", "heavy_end_chain", "motor_pair"}) {
        SCOPED_TRACE(name);
        const Scenario s = libraryScenario(name);
        const Scenario p = perturbed(s, {0.0, 0.1, 0.0, 0.2}, 1, 1);
        EXPECT_NO_THROW((void)loadScenarioText(scenarioText(p), "p"));
        bool moved = false;
        for (std::size_t i = 0; i < s.bodies.size(); ++i) moved |= p.bodies[i].pose != s.bodies[i].pose;
        EXPECT_TRUE(moved);
        for (std::size_t i = 1; i < s.bodies.size(); ++i) {
            const auto between = [&](const Scenario& of) {
                return inverse(of.bodies[i - 1].pose) * of.bodies[i].pose;
            };
            EXPECT_LT(norm(between(p).position - between(s).position), 1e-12);
        }
        // The velocities are those of one rigid body, so that no joint is violated by them.
        for (const Joint& j : p.joints) {
            const auto velocityAt = [&](int body, Vec3 anchor) {
                if (body == kNone) return Vec3{};
                const Body& b = p.bodies[body];
                return b.velocity + cross(b.angularVelocity,
                                          rotate(b.pose.orientation, anchor - b.massProperties.centerOfMass));
            };
            const auto before = [&](int body, Vec3 anchor) {
                if (body == kNone) return Vec3{};
                const Body& b = s.bodies[body];
                return b.velocity + cross(b.angularVelocity,
                                          rotate(b.pose.orientation, anchor - b.massProperties.centerOfMass));
            };
            const double was = norm(before(j.bodyA, j.anchorA) - before(j.bodyB, j.anchorB));
            EXPECT_NEAR(norm(velocityAt(j.bodyA, j.anchorA) - velocityAt(j.bodyB, j.anchorB)), was, 1e-12);
        }
    }
}

TEST(Perturbed, WhatCannotMoveIsSaid) {
    EXPECT_THROW((void)perturbed(libraryScenario("double_pendulum_2d"), {1e-3, 0, 0, 0}, 1, 1),
                 std::invalid_argument)
        << "it hangs: a shift would tear it off";
    EXPECT_THROW((void)perturbed(libraryScenario("slider_crank"), {1e-3, 1e-3, 0, 0}, 1, 1),
                 std::invalid_argument);
}

}  // namespace
}  // namespace rigor::validation
