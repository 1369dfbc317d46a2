// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fixed steps under a clock that stutters, with one frame that takes a second.
//> 20 steps, 0.883 s skipped, drawn at 0.86 of the way
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> moving;
    moving.velocity = {60, 0, 0};  // a metre per step
    const BodyId body = world.addBody(moving);
    FrameStepper<S> stepper(world, {.step = 1.0 / 60, .mostSteps = 8});
    int steps = 0;
    for (const double frame : {0.016, 0.017, 0.033, 1.0, 0.016, 0.149}) steps += stepper.advance(frame);
    const double drawn = stepper.pose(body).p.x(), last = world.pose(body).p.x();
    std::printf("%d steps, %.3f s skipped, drawn at %.2f of the way\n", steps, stepper.skipped(),
                drawn - (last - 1));
}
