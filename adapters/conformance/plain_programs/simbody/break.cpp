// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Break: a rod that is let go beside its pivot tears its hinge loose. Simbody breaks no joint; constraints can be switched
// off, and their forces are those of an instant. What is too much at the start of a step is off in that step.
#include "adapters/conformance/plain_programs/simbody/system.hpp"

namespace rigor::plain {
namespace {

using SimTK::Constraint;

struct Hinge {
    Constraint::Ball point;
    std::vector<Constraint> parts;
    double strength;  ///< [N]

    /// Switches the hinge off where it bears too much.
    void tear(System& rod) const {
        if (point.isDisabled(rod.state)) return;
        rod.system.realize(rod.state, SimTK::Stage::Acceleration);
        if (point.getBallReactionForceOnBody2(rod.state).norm() <= strength) return;
        for (const Constraint& part : parts) part.disable(rod.state);
    }
};

/// `early`: the hinge is looked at before a step as well as after it.
Trajectory tornRod(double strength, int steps, bool early, std::vector<bool>& held) {
    System rod;
    SimTK::MobilizedBody& ground = rod.matter.updGround();
    rod.bodies.push_back(SimTK::MobilizedBody::Free(ground, rigid(1, boxInertia(1, {1, 0.06, 0.06}))));
    SimTK::MobilizedBody& body = rod.bodies[0];
    Hinge hinge{Constraint::Ball(ground, SimTK::Vec3(0), body, SimTK::Vec3(-0.5, 0, 0)), {}, strength};
    hinge.parts = {hinge.point,
                   Constraint::ConstantAngle(ground, SimTK::XAxis, body, SimTK::ZAxis, SimTK::Pi / 2),
                   Constraint::ConstantAngle(ground, SimTK::YAxis, body, SimTK::ZAxis, SimTK::Pi / 2)};
    rod.finish();
    body.setQToFitTranslation(rod.state, SimTK::Vec3(0.5, 0, 0));
    const double dt = 1.0 / 60;
    SimTK::RungeKuttaMersonIntegrator integrator(rod.system);
    integrator.setFixedStepSize(dt);
    integrator.setAllowInterpolation(false);
    integrator.setConstraintTolerance(1e-10);
    Trajectory trajectory{rod.states(rod.state)};
    for (int i = 1; i <= steps; ++i) {
        if (early) hinge.tear(rod);
        integrator.initialize(rod.state);
        while (integrator.getTime() < i * dt) integrator.stepTo(i * dt, i * dt);
        rod.state = integrator.getAdvancedState();
        hinge.tear(rod);
        trajectory.push_back(rod.states(rod.state));
        held.push_back(!hinge.point.isDisabled(rod.state));
    }
    return trajectory;
}

/// At rest the hinge bears m g / 4, later up to 5/2 m g.
TEST(PlainSimbody, Break) {
    for (const auto& [strength, text] : {std::pair{2.0, "2"}, {18.0, "18"}}) {
        SCOPED_TRACE(text);
        const Scenario scene = load("scenarios/library/3d/physical_pendulum.json",
                                    {std::string("joints.pivot.break_force=") + text});
        std::vector<bool> held, adapterHeld;
        const Trajectory plain = tornRod(strength, 60, true, held);
        EXPECT_TRUE(same(plain, adapterRun("simbody:preset=matched", scene, 1.0 / 60, 60, &adapterHeld),
                         {1e-9, 1e-9, 1e-8, 1e-8}));
        EXPECT_EQ(held, adapterHeld);
        EXPECT_FALSE(held.back());
    }
}

/// A hinge that is too weak from the start lets go at once, or a step too late where it is looked at after steps alone.
TEST(PlainSimbody, AHingeThatIsLookedAtAfterStepsAloneBreaksOneStepLate) {
    std::vector<bool> held;
    const double dt = 1.0 / 60, fall = 0.5 * 9.81 * (10 * dt) * (10 * dt);
    EXPECT_NEAR(tornRod(2, 10, true, held).back()[0].position.y, -fall, 1e-9);
    EXPECT_GT(std::abs(tornRod(2, 10, false, held).back()[0].position.y + fall), 1e-3);
}

}  // namespace
}  // namespace rigor::plain
