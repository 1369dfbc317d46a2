// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wheel: a chassis and one driven wheel on a Hinge-2 as in ODE's buggy demo, steering locked at zero, the
// suspension by its ERP and CFM. Nothing touches: spring and motor turn the chassis against the wheel.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, Wheel) {
    constexpr double h = 1.0 / 60, k = 400, c = 8;
    OdeSimulation demo;
    dMass mass;
    dMassSetParameters(&mass, 10, 0, 0, 0, 0.5, 1.5, 1.25, 0, 0, 0);
    const dBodyID chassis = demo.addBody(&mass, {0, 1, 0});
    dMassSetParameters(&mass, 2, 0, 0, 0, 0.05, 0.05, 0.09, 0, 0, 0);
    const dBodyID wheel = demo.addBody(&mass, {0.8, 0.6, 0});
    dBodySetLinearVel(wheel, 0, 0.5, 0);
    const dJointID strut = dJointCreateHinge2(demo.world, nullptr);
    dJointAttach(strut, chassis, wheel);
    dJointSetHinge2Anchor(strut, 0.8, 0.6, 0);
    const dVector3 up = {0, 1, 0}, pin = {0, 0, -1};
    dJointSetHinge2Axes(strut, up, pin);
    dJointSetHinge2Param(strut, dParamLoStop, 0);
    dJointSetHinge2Param(strut, dParamHiStop, 0);
    dJointSetHinge2Param(strut, dParamSuspensionERP, h * k / (h * k + c));
    dJointSetHinge2Param(strut, dParamSuspensionCFM, 1 / (h * k + c));
    dJointSetHinge2Param(strut, dParamVel2, 6);
    dJointSetHinge2Param(strut, dParamFMax2, 0.5);
    const Trajectory plain = demo.run(h, 120);
    EXPECT_GT(std::abs(plain.back()[1].angularVelocity.z), 4.0);
    const Scenario scene = load("adapters/conformance/plain_programs/ode/wheel.json");
    EXPECT_TRUE(same(plain, adapterRun("ode:preset=default", scene, h, 120)));
}

}  // namespace
}  // namespace rigor::plain
