// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Damping: ODE moves a body with the velocity that it has before it is damped,
//     v' = v + h g,   x += h v',   v = kept^h v',
// so the distance is too long by half a step of what damping takes, which cancels part of what symplectic
// Euler's gravity takes: nearer to the exponential than libraries that damp first.
#include "adapters/conformance/plain_programs/ode/simulation.hpp"

namespace rigor::plain {
namespace {

TEST(PlainOde, ABodyIsMovedBeforeItIsDamped) {
    constexpr double h = 1.0 / 60;
    const Scenario scene = load("scenarios/library/3d/damping.json");
    for (const int body : {0, 1}) {
        const double kept = body == 0 ? 0.8 : 0.02;
        OdeSimulation demo;
        dMass mass;
        dMassSetSphereTotal(&mass, 1, 0.1);
        const dBodyID ball = demo.addBody(&mass, {0, 2, 0});
        dBodySetLinearVel(ball, 3, 4, 0);
        dBodySetLinearDampingThreshold(ball, 0);
        dBodySetLinearDamping(ball, 1 - std::pow(kept, h));
        const Trajectory plain = demo.run(h, 90);
        double x = 0, y = 2, vx = 3, vy = 4;
        for (const auto& states : plain) {
            EXPECT_NEAR(states[0].position.x, x, 1e-13);
            EXPECT_NEAR(states[0].position.y, y, 1e-13);
            EXPECT_NEAR(states[0].velocity.y, vy, 1e-12);
            vy -= h * 9.81;
            x += h * vx;
            y += h * vy;
            vx *= std::pow(kept, h);
            vy *= std::pow(kept, h);
        }
        const Trajectory adapter = adapterRun("ode:preset=default", scene, h, 90);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            const Vec3 start{body == 0 ? 0.0 : 3.0, 0, 0};
            const Vec3 off = adapter[i][body].position - start - plain[i][0].position;
            EXPECT_LE(largest(off), 1e-14) << i;
        }
    }
}

}  // namespace
}  // namespace rigor::plain
