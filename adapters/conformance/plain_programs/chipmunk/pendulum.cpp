// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pendulum: a rod on a pin, struck so that it goes over the top, one that turns and turns, and one that carries another.
#include "adapters/conformance/plain_programs/chipmunk/space.hpp"

namespace rigor::plain {
namespace {

/// A rod of 1 kg on a pin through its end, with this moment and spin.
Trajectory pendulum(double moment, double spin, double dt, int steps) {
    cpSpace* space = earth();
    cpBody* rod = cpBodyNew(1, moment);
    cpBodySetPosition(rod, cpv(0, -0.5));
    cpBodySetVelocity(rod, cpv(0.5 * spin, 0));
    cpBodySetAngularVelocity(rod, spin);
    cpSpaceAddBody(space, rod);
    cpSpaceAddConstraint(space, cpPivotJointNew2(cpSpaceGetStaticBody(space), rod, cpv(0, 0), cpv(0, 0.5)));
    return run(space, {rod}, dt, steps);
}

TEST(PlainChipmunk, Pendulum) {
    const Trajectory plain = pendulum(1.0 / 12 * (0.06 * 0.06 + 1), 8.5, 1.0 / 60, 120);
    EXPECT_GT(travel(plain, 0), 0.9);
    const Scenario scene = load("scenarios/library/2d/physical_pendulum_2d.json");
    // The moment of the program is a rounding off that of the file.
    EXPECT_TRUE(same(plain, adapterRun("chipmunk:preset=default", scene, 1.0 / 60, 120),
                     {1e-11, 1e-11, 1e-10, 1e-10}));
}

TEST(PlainChipmunk, TurningPendulum) {
    const Trajectory plain = pendulum(0.08333333333333333, -7.5, 1.0 / 240, 720);
    EXPECT_GT(travel(plain, 0), 0.9);
    const Scenario scene = load("scenarios/library/2d/turning_pendulum_2d.json");
    EXPECT_TRUE(same(plain, adapterRun("chipmunk:preset=default", scene, 1.0 / 240, 720),
                     {1e-11, 1e-11, 1e-10, 1e-10}));
}

/// Two rods, let go from the horizontal. Over 2 s at 1/60 s the pins come apart by 50 mm: they are held on velocities.
TEST(PlainChipmunk, DoublePendulum) {
    for (const double dt : {1.0 / 60, 1.0 / 240}) {
        cpSpace* space = earth();
        std::vector<cpBody*> rods;
        for (const double x : {0.5, 1.5}) {
            rods.push_back(cpBodyNew(1, cpMomentForBox(1, 1, 0.04)));
            cpBodySetPosition(rods.back(), cpv(x, 0));
            cpSpaceAddBody(space, rods.back());
        }
        cpSpaceAddConstraint(space,
                             cpPivotJointNew2(cpSpaceGetStaticBody(space), rods[0], cpv(0, 0), cpv(-0.5, 0)));
        cpSpaceAddConstraint(space, cpPivotJointNew2(rods[0], rods[1], cpv(0.5, 0), cpv(-0.5, 0)));
        const int steps = static_cast<int>(std::lround(0.5 / dt));
        const Trajectory plain = run(space, rods, dt, steps);
        EXPECT_GT(travel(plain, 1), 0.5);
        const Scenario scene = load("scenarios/library/2d/double_pendulum_2d.json");
        EXPECT_TRUE(
            same(plain, adapterRun("chipmunk:preset=default", scene, dt, steps), {1e-10, 1e-10, 1e-9, 1e-9}));
    }
}

}  // namespace
}  // namespace rigor::plain
