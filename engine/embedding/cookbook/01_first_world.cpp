// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball falls on the ground and stays there.
//> height 0.500
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    const auto wood = world.addMaterial(0.5, 0.0);  // friction, restitution
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    addSolid<S>(world, {{HalfSpace<S>{{0, 1, 0}, 0}, 0, wood}}, fixed);
    BodyDef<S> above;
    above.pose.p = {0, 2, 0};
    const BodyId ball = addSolid<S>(world, {{Sphere<S>{0.5}, 700, wood}}, above);  // density [kg/m^3]
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    std::printf("height %.3f\n", world.pose(ball).p.y());
}
