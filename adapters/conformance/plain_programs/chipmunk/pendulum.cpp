// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pendulum: a rod on a pin, struck so that it goes over the top.
#include "adapters/conformance/plain_programs/chipmunk/space.hpp"

namespace rigor::plain {
namespace {

TEST(PlainChipmunk, Pendulum) {
    cpSpace* space = earth();
    cpBody* rod = cpBodyNew(1, 1.0 / 12 * (0.06 * 0.06 + 1));
    cpBodySetPosition(rod, cpv(0, -0.5));
    cpBodySetVelocity(rod, cpv(4.25, 0));
    cpBodySetAngularVelocity(rod, 8.5);
    cpSpaceAddBody(space, rod);
    cpSpaceAddConstraint(space, cpPivotJointNew2(cpSpaceGetStaticBody(space), rod, cpv(0, 0), cpv(0, 0.5)));
    const Trajectory plain = run(space, {rod}, 1.0 / 60, 120);
    EXPECT_GT(travel(plain, 0), 0.9);
    const Scenario scene = load("scenarios/library/2d/physical_pendulum_2d.json");
    // The moment of the program is a rounding off that of the file.
    EXPECT_TRUE(same(plain, adapterRun("chipmunk:preset=default", scene, 1.0 / 60, 120),
                     {1e-11, 1e-11, 1e-10, 1e-10}));
}

}  // namespace
}  // namespace rigor::plain
