// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A hammer of two parts has their mass and centre of mass; it gets others when a part goes.
//> 4.58 kg, centre 0.308 m from the handle's end; without its head 0.34 kg, 0.150 m
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    Pose<S> handle, head;
    handle.p = {0, 0.15, 0};
    head.p = {0, 0.32, 0};
    const BodyId hammer = addSolid<S>(world, {{Box<S>{{0.02, 0.15, 0.02}}, 700, kUsualMaterial, handle},
                                              {Box<S>{{0.09, 0.03, 0.025}}, 7850, kUsualMaterial, head}});
    const auto& is = world.constants(hammer);
    std::printf("%.2f kg, centre %.3f m from the handle's end; ", is.mass, is.centerOfMass.y());
    world.removeShape(world.shapes().back().id);
    std::printf("without its head %.2f kg, %.3f m\n", is.mass, is.centerOfMass.y());
}
