// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Settings by preset, and algorithms as constants: a name with a typing mistake does not compile.
//> nsgs with cone friction; a slab that was static falls at 1.62 m/s^2
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    auto def = WorldDef<S>::preset("accurate");
    choose(def, choices::solver_nsgs, choices::friction_cone, choices::sleeping_islands);
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    const BodyId slab = addSolid<S>(world, {{Box<S>{{1, 0.1, 1}}}}, fixed);
    world.step(0.5);
    world.setGravity({0, -1.62, 0});
    world.setType(slab, BodyType::Dynamic);
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    std::printf("%s with %s friction; a slab that was static falls at %.2f m/s^2\n",
                world.def().solver.c_str(), world.def().friction.c_str(), -world.velocity(slab).y());
}
