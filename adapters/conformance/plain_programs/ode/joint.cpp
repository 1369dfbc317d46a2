// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: a rod on a hinge, and a bob on a double ball joint, which keeps a distance.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, Hinge) {
    OdeSimulation demo;
    dMass mass;
    dMassSetParameters(&mass, 1, 0, 0, 0, 0.0006, 0.0836, 0.0836, 0, 0, 0);
    const dBodyID rod = demo.addBody(&mass, {0.5, 0, 0});
    const dJointID hinge = dJointCreateHinge(demo.world, nullptr);
    dJointAttach(hinge, rod, nullptr);
    dJointSetHingeAnchor(hinge, 0, 0, 0);
    dJointSetHingeAxis(hinge, 0, 0, 1);
    const Trajectory plain = demo.run(1.0 / 60, 180);

    const Scenario scene =
        load("scenarios/library/3d/physical_pendulum.json", {"bodies.rod.inertia=[0.0006,0.0836,0.0836]"});
    EXPECT_GT(travel(plain, 0), 0.9);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 180)));
}

TEST(PlainOde, DoubleBall) {
    OdeSimulation demo;
    dMass mass;
    dMassSetParameters(&mass, 1, 0, 0, 0, 0.004, 0.004, 0.004, 0, 0, 0);
    const dBodyID bob = demo.addBody(&mass, {1, 0, 0});
    const dJointID rod = dJointCreateDBall(demo.world, nullptr);
    dJointAttach(rod, bob, nullptr);
    dJointSetDBallAnchor1(rod, 1, 0, 0);
    dJointSetDBallAnchor2(rod, 0, 0, 0);
    const Trajectory plain = demo.run(1.0 / 240, 480);

    const Scenario scene = load("scenarios/library/3d/point_pendulum.json");
    EXPECT_GT(travel(plain, 0), 1.5);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 240, 480)));
}

}  // namespace
}  // namespace rigor::plain
