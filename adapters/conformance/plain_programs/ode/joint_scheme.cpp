// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plane mechanisms in ODE beside its scheme written out: joints are held on velocities, J v' = -(erp / h) C
// with J of the start of the step. A body on such a joint leaves along the tangent and loses energy; error
// reduction brings it back and with it a part of the energy, two tenths a step by default. The tests measure
// that ODE's trajectories are those of that scheme, at every erp, and the error that is left with erp = 0.8,
// and with positions held instead.
#include "adapters/conformance/plain_programs/planar_scheme.hpp"

namespace rigor::plain {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr int kSteps = 120;

TEST(PlainOde, MechanismsAreHeldOnVelocities) {
    // The direct solver is softened by a CFM of 1e-10, which moves a piston by 2e-8 m within two seconds.
    constexpr Bounds kSoftened{1e-7, 3e-7, 2e-6, 6e-6};
    for (const char* path : kMechanisms) {
        SCOPED_TRACE(path);
        const Scenario scene = load(path);
        for (const double erp : {0.2, 0.8}) {
            const std::string setting = ",erp=" + std::to_string(erp);
            PlanarScheme exactTurns(scene, Hold::Velocities, erp);
            EXPECT_TRUE(same(exactTurns.run(kStep, kSteps),
                             adapterRun("ode:preset=matched" + setting, scene, kStep, kSteps), kSoftened));
            PlanarScheme firstOrder = PlanarScheme(scene, Hold::Velocities, erp).turningToFirstOrder();
            EXPECT_TRUE(same(firstOrder.run(kStep, kSteps),
                             adapterRun("ode:preset=default" + setting, scene, kStep, kSteps), kSoftened));
        }
    }
}

/// Energy lost and the distance from the exact motion (positions held, steps of 1/3840 s), of the scheme as
/// ODE has it and with one change.
TEST(PlainOde, WhatHoldingJointsOnVelocitiesCosts) {
    for (const char* path : kMechanisms) {
        SCOPED_TRACE(path);
        const Scenario scene = load(path);
        const Trajectory exact = PlanarScheme(scene, Hold::Positions).run(kStep / 64, 64 * kSteps);
        const Trajectory asFound = PlanarScheme(scene, Hold::Velocities, 0.2).run(kStep, kSteps);
        const double lost = energyDrift(scene, asFound);
        const auto energyAt = [&](double erp) {
            return energyDrift(scene, PlanarScheme(scene, Hold::Velocities, erp).run(kStep, kSteps));
        };
        EXPECT_GT(energyAt(0.0), 1.8 * lost) << "error reduction gives energy back";
        EXPECT_LT(energyAt(0.8), 0.35 * lost);
        const Trajectory onPositions = PlanarScheme(scene, Hold::Positions).run(kStep, kSteps);
        EXPECT_LT(energyDrift(scene, onPositions), 0.3 * lost);
        if (std::string(path).find("double_pendulum") == std::string::npos) {
            EXPECT_LT(farthest(onPositions, exact, 64), 0.3 * farthest(asFound, exact, 64));
        }
    }
}

}  // namespace
}  // namespace rigor::plain
