// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs: a stop that gives way, by the manual's ERP = h k / (h k + c) and CFM = 1 / (h k + c), on a slider
// and on a piston whose turning is driven.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

constexpr double kSpringStep = 1.0 / 60;

template <class Set>
void spring(Set set, dJointID joint, double target, double k, double c) {
    set(joint, dParamHiStop, target);
    set(joint, dParamLoStop, target);
    set(joint, dParamStopERP, kSpringStep * k / (kSpringStep * k + c));
    set(joint, dParamStopCFM, 1 / (kSpringStep * k + c));
}

TEST(PlainOde, SliderSpring) {
    OdeSimulation demo;
    dMass mass;
    dMassSetBoxTotal(&mass, 3, 0.2, 0.2, 0.2);
    const dBodyID weight = demo.addBody(&mass, {0, 2, 0});
    const dJointID rail = dJointCreateSlider(demo.world, nullptr);
    dJointAttach(rail, weight, nullptr);
    dJointSetSliderAxis(rail, 0, 1, 0);
    spring(dJointSetSliderParam, rail, 0, 300, 6);
    const Trajectory plain = demo.run(kSpringStep, 180);

    const Scenario scene = load("scenarios/library/3d/slider_spring.json");
    EXPECT_GT(travel(plain, 0), 0.1);
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, kSpringStep, 180)));
}

/// The adapter turns the body by an AMotor of its own instead of the piston's second motor: the same row with
/// other roundings.
TEST(PlainOde, PistonSpring) {
    OdeSimulation demo;
    dMass mass;
    dMassSetBoxTotal(&mass, 2, 0.3, 0.3, 0.3);
    const dBodyID body = demo.addBody(&mass, {0, 1, 0});
    const dJointID piston = dJointCreatePiston(demo.world, nullptr);
    dJointAttach(piston, body, nullptr);
    dJointSetPistonAnchor(piston, 0, 1, 0);
    dJointSetPistonAxis(piston, 1, 0, 0);
    spring(dJointSetPistonParam, piston, 0.4, 80, 2);
    dJointSetPistonParam(piston, dParamVel2, 3);
    dJointSetPistonParam(piston, dParamFMax2, 0.05);
    const Trajectory plain = demo.run(kSpringStep, 120);

    const Scenario scene = load("scenarios/library/3d/six_dof_spring.json");
    EXPECT_GT(travel(plain, 0), 0.4);
    EXPECT_TRUE(
        same(plain, adapterRun("ode:preset=default", scene, kSpringStep, 120), {1e-12, 1e-12, 1e-12, 1e-12}));
}

}  // namespace
}  // namespace rigor::plain
