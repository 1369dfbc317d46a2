// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MuJoCo's own limits in a run: numbers that it takes for none, contacts beyond the room it has, restitution
// without a coefficient, single precision of height fields.
#include <algorithm>
#include <cmath>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

/// MuJoCo starts again from its initial state when a number passes 1e10; the run has to end instead.
TEST(MujocoWorld, NumbersThatItTakesForNoneAreNotARestart) {
    Scenario s = scene();
    const int b = addBody(s, Sphere{0.1}, {0, 1, 0});
    s.bodies[b].velocity = {2e10, 0, 0};
    Simulation simulation(s, 0.01);
    simulation.steps(1);
    EXPECT_TRUE(std::isnan(simulation.state(b).position.x));
    simulation.steps(3);
    EXPECT_TRUE(std::isnan(simulation.state(b).velocity.x));
}

/// 30 plates on two floors at one place: 8 contacts each, more than there is room for at first. None may be lost.
TEST(MujocoWorld, RoomForContactsGrows) {
    Scenario s = scene(0.5);
    for (int i = 0; i < 2; ++i) addStatic(s, Box{{50, 1, 50}}, {0, -1, 0});
    const Vec3 half{0.5, 0.1, 0.5};
    for (int i = 0; i < 30; ++i)
        addBody(s, Box{half}, {2.0 * (i % 6), 0.0999, 2.0 * (i / 6)}, 2.0, boxMoments(2.0, half));
    const double dt = 1.0 / 240.0;
    Simulation simulation(s, dt);
    simulation.steps(2);
    const auto contacts = simulation.contacts();
    EXPECT_EQ(contacts.size(), 240u);
    simulation.steps(240);
    double impulse = 0.0;
    for (const ContactPoint& c : simulation.contacts()) impulse += c.normalImpulse;
    EXPECT_NEAR(impulse / (30 * 2.0 * 9.81 * dt), 1.0, 1e-2);
}

/// The spring that stands for a coefficient returns it, the better the more steps a bounce takes.
TEST(MujocoWorld, ABounceReturnsItsCoefficient) {
    for (const double e : {0.3, 0.8, 1.0}) {
        double error[2] = {};
        for (const int fine : {0, 1}) {
            Scenario s = scene(0.0, e);
            s.gravity = {};
            addStatic(s, Box{{5, 1, 5}}, {0, -1, 0});
            const int b = addBody(s, Sphere{0.5}, {0, 0.503, 0}, 1.0, even(0.1));
            s.bodies[b].velocity = {0, -2, 0};
            Simulation simulation(s, 1.0 / 1000.0,
                                  std::string("preset=matched,bounce_steps=") + (fine == 1 ? "80" : "10"));
            EXPECT_NEAR(simulation.world->readBack().pairs.front().restitution, e, 1e-6);
            EXPECT_EQ(simulation.ledgerLine("restitution")->realisation, adapter::Realisation::Approximate);
            simulation.steps(400);
            error[fine] = std::abs(simulation.state(b).velocity.y / 2.0 - e);
        }
        EXPECT_LT(error[0], 0.12) << e;
        EXPECT_LT(error[1], 0.012) << e;
    }
}

/// A height of the format's own triangles: cells split from (i + 1, k) to (i, k + 1).
double heightOf(const scenario::HeightField& f, double x, double z) {
    const double u = x / f.spacingX + 0.5 * (f.columns - 1), v = z / f.spacingZ + 0.5 * (f.rows - 1);
    const int i = static_cast<int>(u), k = static_cast<int>(v);
    const double a = u - i, b = v - k;
    const auto h = [&](int column, int row) { return f.heights[row * f.columns + column]; };
    if (a + b <= 1.0) return h(i, k) + a * (h(i + 1, k) - h(i, k)) + b * (h(i, k + 1) - h(i, k));
    return h(i + 1, k + 1) + (1.0 - a) * (h(i, k + 1) - h(i + 1, k + 1)) +
           (1.0 - b) * (h(i + 1, k) - h(i + 1, k + 1));
}

/// Small balls that fall onto a field without symmetry stop where its triangles are, on either side of the diagonals.
TEST(MujocoWorld, HeightFieldsLieAsTheFormatSays) {
    const scenario::HeightField field{
        4, 3, 1.0, 0.8, {0.0, 0.5, 0.2, 0.1, 0.4, -0.3, 0.6, 0.0, 0.1, 0.3, -0.2, 0.5}, 1.0};
    for (const auto& [x, z] :
         {std::pair{-1.2, -0.5}, {-0.8, -0.2}, {0.3, 0.2}, {-0.2, 0.5}, {0.9, -0.6}, {1.3, 0.6}}) {
        Scenario s = scene(5.0);
        addStatic(s, field);
        const double radius = 0.01;
        addBody(s, Sphere{radius}, {x, heightOf(field, x, z) + 0.05, z}, 1.0, even(1e3));
        Simulation simulation(s, 1.0 / 1000.0);
        for (int i = 0; i < 1000 && simulation.contacts().empty(); ++i) simulation.steps(1);
        ASSERT_FALSE(simulation.contacts().empty());
        const ContactPoint c = simulation.contacts().front();
        EXPECT_NEAR(c.pointA.y, heightOf(field, c.pointA.x, c.pointA.z), 1e-3) << x << ", " << z;
    }
}

}  // namespace
}  // namespace rigor::test
