// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounce: a ball of restitution 0.8 on a plane.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, Bounce) {
    OdeSimulation demo;
    demo.surface.mode |= dContactBounce;
    demo.surface.bounce = 0.8;
    demo.inSpace(dCreatePlane(nullptr, 0, 1, 0, 0));
    demo.addBody(nullptr, {0, 0, 0});
    dMass mass;
    dMassSetSphereTotal(&mass, 1, 0.1);
    dGeomSetBody(demo.inSpace(dCreateSphere(nullptr, 0.1)), demo.addBody(&mass, {0, 1.1, 0}));
    const Trajectory plain = demo.run(1.0 / 60, 120);

    const Scenario scene = load("scenarios/library/3d/bouncing_ball.json");
    EXPECT_GT(travel(plain, 1), 0.9);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 120)));
}

}  // namespace
}  // namespace rigor::plain
