// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plane mechanisms in Box2D beside its scheme written out: J v' = 0 with J of the start of the step, and then
// positions are moved onto the joints one after the other, without the velocities, until no error is above
// the slop (b2_linearSlop, 0.005 units, of a world scaled by four in `matched`). A body leaves along the
// tangent and loses energy; moving it back takes nothing out and gives nothing back. The tests measure that
// Box2D's trajectories and energies are those of that scheme, and the energy error that is left if positions
// are held instead, or if errors are corrected through the velocities.
#include "adapters/conformance/plain_programs/planar_scheme.hpp"

namespace rigor::plain {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr int kSteps = 120;

TEST(PlainBox2d, MechanismsAreProjected) {
    for (const char* path : kMechanisms) {
        SCOPED_TRACE(path);
        const Scenario scene = load(path);
        if (scene.dimension != 2) continue;
        for (const auto& [spec, slop] :
             {std::pair{"box2d:preset=matched", 0.005 / 4.0}, std::pair{"box2d:preset=default", 0.005}}) {
            const Trajectory written = PlanarScheme(scene, Hold::Projection, 0.0, slop).run(kStep, kSteps);
            const Trajectory found = adapterRun(spec, scene, kStep, kSteps);
            // Box2D decides which joint is moved last, and how far below the slop.
            EXPECT_LT(farthest(found, written), 1.3 * slop + 5e-4) << spec;
            const double lost = energyDrift(scene, written);
            EXPECT_NEAR(energyDrift(scene, found), lost, 0.012 * lost) << spec;

            EXPECT_LT(energyDrift(scene, PlanarScheme(scene, Hold::Positions).run(kStep, kSteps)),
                      0.12 * lost);
            EXPECT_LT(energyDrift(scene, PlanarScheme(scene, Hold::Velocities, 0.8).run(kStep, kSteps)),
                      0.2 * lost);
            // The run is without any correction: moving bodies back takes no energy out.
            EXPECT_GT(energyDrift(scene, PlanarScheme(scene, Hold::Velocities, 0.0).run(kStep, kSteps)),
                      lost);
        }
    }
}

}  // namespace
}  // namespace rigor::plain
