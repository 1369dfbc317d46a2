// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stack: ten unit cubes on a floor, with the library's CFM and with a softer one.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

void compare(const std::string& spec, double contactCfm) {
    OdeSimulation demo;
    demo.surface.mu = 0.5;
    if (contactCfm > 0.0) {
        demo.surface.mode |= dContactSoftCFM;
        demo.surface.soft_cfm = contactCfm;
    }
    dGeomSetPosition(demo.inSpace(dCreateBox(nullptr, 40, 1, 40)), 0, -0.5, 0);
    demo.addBody(nullptr, {0, -0.5, 0});
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 1, 1, 1);
    for (int i = 0; i < 10; ++i) {
        const dBodyID cube = demo.addBody(&mass, {0, 0.49999 + 0.99999 * i, 0});
        dGeomSetBody(demo.inSpace(dCreateBox(nullptr, 1, 1, 1)), cube);
    }
    const Trajectory plain = demo.run(1.0 / 60, 60);

    const Scenario scene = load("scenarios/library/3d/box_stack.json");
    EXPECT_GT(travel(plain, 10), 1e-6);
    EXPECT_TRUE(same(plain, adapterRun(spec, scene, 1.0 / 60, 60)));
}

TEST(PlainOde, Stack) {
    compare("ode:preset=default", 0.0);
}

TEST(PlainOde, StackOfSoftContacts) {
    compare("ode:preset=default,contact_cfm=1e-6", 1e-6);
}

}  // namespace
}  // namespace rigor::plain
