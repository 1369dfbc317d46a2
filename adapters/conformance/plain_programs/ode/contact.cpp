// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact: a block slides over a floor until it rests, ODE as it comes.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, Contact) {
    OdeSimulation demo;
    demo.surface.mu = 0.5;
    const dGeomID floor = demo.inSpace(dCreateBox(nullptr, 40, 1, 40));
    dGeomSetPosition(floor, 0, -0.5, 0);
    demo.addBody(nullptr, {0, -0.5, 0});
    dMass mass;
    dMassSetParameters(&mass, 2, 0, 0, 0, 0.045, 0.085, 0.045, 0, 0, 0);
    const dBodyID block = demo.addBody(&mass, {0, 0.05, 0});
    dGeomSetBody(demo.inSpace(dCreateBox(nullptr, 0.5, 0.1, 0.5)), block);
    dBodySetLinearVel(block, 4, 0, 0);
    const Trajectory plain = demo.run(1.0 / 60, 90);

    const Scenario scene =
        load("scenarios/library/3d/slide_and_stop.json", {"bodies.block.inertia=[0.045,0.085,0.045]"});
    EXPECT_GT(travel(plain, 1), 1.5);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 90)));
}

}  // namespace
}  // namespace rigor::plain
