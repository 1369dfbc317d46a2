// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plane mechanisms in Bullet beside its scheme written out: joints are held on velocities, J v' = -(erp / h) C with
// J of the start of the step, as ODE's are (plain_programs/ode/joint_scheme.cpp says what that costs). A hundred
// sweeps of sequential impulses come to that scheme's solution; ten do for open chains, and leave loops up
// to 0.18 of the scheme's own error beside it.
#include "adapters/conformance/plain_programs/planar_scheme.hpp"

namespace rigor::plain {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr int kSteps = 120;

TEST(PlainBullet, MechanismsAreHeldOnVelocities) {
    for (const char* path : kMechanisms) {
        SCOPED_TRACE(path);
        const Scenario scene = load(path);
        for (const double erp : {0.2, 0.8}) {
            const Trajectory written = PlanarScheme(scene, Hold::Velocities, erp).run(kStep, kSteps);
            const std::string spec = "bullet:preset=matched,erp=" + std::to_string(erp);
            EXPECT_TRUE(same(written, adapterRun(spec, scene, kStep, kSteps), {1e-6, 2e-6, 1e-5, 5e-5}));
            EXPECT_TRUE(same(written, adapterRun(spec + ",iterations=10000", scene, kStep, kSteps),
                             {1e-13, 2e-13, 1e-12, 4e-12}));
        }
    }
}

TEST(PlainBullet, TenSweepsAreNearToThat) {
    for (const char* path : kMechanisms) {
        SCOPED_TRACE(path);
        const Scenario scene = load(path);
        const Trajectory exact = PlanarScheme(scene, Hold::Positions).run(kStep / 64, 64 * kSteps);
        const Trajectory written = PlanarScheme(scene, Hold::Velocities, 0.2).run(kStep, kSteps);
        const Trajectory found = adapterRun("bullet:preset=default", scene, kStep, kSteps);
        EXPECT_LT(farthest(found, written), 0.18 * farthest(written, exact, 64));
    }
}

}  // namespace
}  // namespace rigor::plain
