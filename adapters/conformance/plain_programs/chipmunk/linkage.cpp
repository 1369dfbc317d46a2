// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Linkage: a four-bar linkage of three boxes on four pivots, let go. The numbers are those of the file, places of pins in the
// world as cpPivotJointNew takes them.
#include "adapters/conformance/plain_programs/chipmunk/space.hpp"

namespace rigor::plain {
namespace {

TEST(PlainChipmunk, Linkage) {
    cpSpace* space = earth();
    const auto bar = [&](double mass, double length, const cpVect& at, double angle) {
        cpBody* body = cpBodyNew(mass, cpMomentForBox(mass, length, 0.06));
        cpBodySetPosition(body, at);
        cpBodySetAngle(body, angle);
        return cpSpaceAddBody(space, body);
    };
    cpBody* crank = bar(0.5, 0.3, cpv(0.1316373842835559, 0.07191383079063045), 0.5);
    cpBody* coupler = bar(1, 0.9, cpv(0.6172966130422727, 0.42161991063512677), 0.6653266027623032);
    cpBody* rocker = bar(0.8, 0.7, cpv(0.9856592287587168, 0.3497060798444963), 1.6117814322682023);
    cpBody* ground = cpSpaceGetStaticBody(space);
    const auto pin = [&](cpBody* a, cpBody* b, const cpVect& at) {
        cpConstraint* pivot = cpSpaceAddConstraint(space, cpPivotJointNew(a, b, at));
        cpConstraintSetCollideBodies(pivot, cpFalse);
    };
    pin(ground, crank, cpv(0, 0));
    pin(crank, coupler, cpv(0.2632747685671118, 0.1438276615812609));
    pin(coupler, rocker, cpv(0.9713184575174336, 0.6994121596889926));
    pin(ground, rocker, cpv(1, 0));
    const Trajectory plain = run(space, {crank, coupler, rocker}, 1.0 / 240, 240);
    EXPECT_GT(travel(plain, 0), 0.1);
    const Scenario scene = load("scenarios/library/2d/four_bar_linkage_2d.json");
    // Moments and anchors are a rounding off those of the file.
    EXPECT_TRUE(
        same(plain, adapterRun("chipmunk:preset=default", scene, 1.0 / 240, 240), {1e-9, 1e-9, 1e-8, 1e-7}));
}

}  // namespace
}  // namespace rigor::plain
