// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Break: a pendulum let go beside its pivot tears its hinge loose where the rod pulls with more than 18 N, as
// the manual's section on joint feedback has it: the force of the step just done, then detach.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, Break) {
    OdeSimulation demo;
    dMass mass;
    dMassSetParameters(&mass, 1, 0, 0, 0, 0.0006, 0.0836, 0.0836, 0, 0, 0);
    const dBodyID rod = demo.addBody(&mass, {0.5, 0, 0});
    const dJointID hinge = dJointCreateHinge(demo.world, nullptr);
    dJointAttach(hinge, rod, nullptr);
    dJointSetHingeAnchor(hinge, 0, 0, 0);
    dJointSetHingeAxis(hinge, 0, 0, 1);
    dJointFeedback feedback{};
    dJointSetFeedback(hinge, &feedback);
    Trajectory plain{demo.states()};
    std::vector<bool> held;
    for (int i = 0; i < 120; ++i) {
        demo.step(1.0 / 60);
        plain.push_back(demo.states());
        const dReal* f = feedback.f1;
        if (std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) > 18) dJointAttach(hinge, nullptr, nullptr);
        held.push_back(dJointGetBody(hinge, 0) != nullptr);
    }

    const Scenario scene = load("scenarios/library/3d/physical_pendulum.json",
                                {"joints.pivot.break_force=18", "bodies.rod.inertia=[0.0006,0.0836,0.0836]"});
    std::vector<bool> adapterHeld;
    EXPECT_TRUE(held[10] && !held[60]);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 120, &adapterHeld)));
    EXPECT_EQ(held, adapterHeld);
}

}  // namespace
}  // namespace rigor::plain
