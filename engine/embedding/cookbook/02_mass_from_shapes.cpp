// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A hammer of two parts: mass, centre of mass and inertia are those of the shapes.
//> 4.58 kg, centre 0.308 m from the handle's end
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    Pose<S> handle, head;
    handle.p = {0, 0.15, 0};
    head.p = {0, 0.32, 0};
    const BodyId hammer = addSolid<S>(
        world, {{Box<S>{{0.02, 0.15, 0.02}}, 700, 0, handle}, {Box<S>{{0.09, 0.03, 0.025}}, 7850, 0, head}});
    const auto& made = world.constants(hammer);
    std::printf("%.2f kg, centre %.3f m from the handle's end\n", made.mass, made.centerOfMass.y());
}
