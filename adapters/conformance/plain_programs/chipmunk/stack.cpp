// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stack: ten boxes on each other, and a block on a floor: Chipmunk as it comes, and with more iterations and less slop.
#include "adapters/conformance/plain_programs/chipmunk/space.hpp"

namespace rigor::plain {
namespace {

TEST(PlainChipmunk, Stack) {
    for (const bool fine : {false, true}) {
        cpSpace* space = earth();
        if (fine) {
            cpSpaceSetIterations(space, 100);
            cpSpaceSetCollisionSlop(space, 0.0005);
        }
        std::vector<cpBody*> bodies{addBox(space, 0, 40, 1, cpv(0, -0.5), std::sqrt(0.5))};
        for (int i = 0; i < 10; ++i)
            bodies.push_back(addBox(space, 1, 1, 1, cpv(0, 0.49999 + i * 0.99999), std::sqrt(0.5)));
        const Trajectory plain = run(space, bodies, 1.0 / 60, 180);
        EXPECT_GT(travel(plain, 10), fine ? 1e-4 : 0.01);
        const Scenario scene = load("scenarios/library/2d/box_stack_2d.json");
        const char* spec =
            fine ? "chipmunk:preset=default,iterations=100,slop=0.0005" : "chipmunk:preset=default";
        EXPECT_TRUE(same(plain, adapterRun(spec, scene, 1.0 / 60, 180), {1e-9, 1e-9, 1e-8, 1e-8}));
    }
}

/// A block that slides to rest: Chipmunk multiplies the coefficients of the two shapes.
TEST(PlainChipmunk, Slide) {
    cpSpace* space = earth();
    std::vector<cpBody*> bodies{addBox(space, 0, 40, 1, cpv(0, -0.5), std::sqrt(0.4 * 0.6)),
                                addBox(space, 2, 0.5, 0.1, cpv(0, 0.05), 1, cpv(-4, 0))};
    const Trajectory plain = run(space, bodies, 1.0 / 60, 90);
    EXPECT_GT(travel(plain, 1), 1.5);
    const Scenario scene = load("scenarios/library/2d/slide_and_stop_2d.json");
    EXPECT_TRUE(same(plain, adapterRun("chipmunk:preset=default", scene, 1.0 / 60, 90),
                     {1e-12, 1e-12, 1e-12, 1e-12}));
}

}  // namespace
}  // namespace rigor::plain
