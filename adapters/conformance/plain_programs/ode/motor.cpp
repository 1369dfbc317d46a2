// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Motors and stops of ODE's own joints (manual, "Stop and motor parameters"): a cabin driven up its shaft to the
// upper stop, and a rod on a hinge that falls on its lower one.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, SliderMotor) {
    OdeSimulation demo;
    dMass mass;
    dMassSetBoxTotal(&mass, 4, 0.4, 0.4, 0.4);
    const dBodyID cabin = demo.addBody(&mass, {0, 1, 0});
    const dJointID shaft = dJointCreateSlider(demo.world, nullptr);
    dJointAttach(shaft, cabin, nullptr);
    dJointSetSliderAxis(shaft, 0, 1, 0);
    dJointSetSliderParam(shaft, dParamLoStop, -0.1);
    dJointSetSliderParam(shaft, dParamHiStop, 1.2);
    dJointSetSliderParam(shaft, dParamVel, 1);
    dJointSetSliderParam(shaft, dParamFMax, 50);
    const Trajectory plain = demo.run(1.0 / 60, 150);
    EXPECT_NEAR(travel(plain, 0), 1.2, 0.02);
    const Scenario scene = load("scenarios/library/3d/slider_motor.json");
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 150)));
}

TEST(PlainOde, HingeStop) {
    OdeSimulation demo;
    dMass mass;
    dMassSetParameters(&mass, 2, 0, 0, 0, 0.0012, 0.1673, 0.1673, 0, 0, 0);
    const dBodyID rod = demo.addBody(&mass, {0.5, 0, 0});
    const dJointID pivot = dJointCreateHinge(demo.world, nullptr);
    dJointAttach(pivot, rod, nullptr);
    dJointSetHingeAnchor(pivot, 0, 0, 0);
    dJointSetHingeAxis(pivot, 0, 0, 1);
    dJointSetHingeParam(pivot, dParamLoStop, -0.5235987755982988);
    dJointSetHingeParam(pivot, dParamHiStop, 0.1);
    const Trajectory plain = demo.run(1.0 / 60, 120);
    EXPECT_GT(travel(plain, 0), 0.2);
    const Scenario scene =
        load("scenarios/library/3d/hinge_limit.json", {"bodies.rod.inertia=[0.0012,0.1673,0.1673]"});
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, 1.0 / 60, 120)));
}

}  // namespace
}  // namespace rigor::plain
