// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball falls on the ground and stays there, with the friction and the mass that shapes have by default.
//> height 0.500, 366.5 kg
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    world.addShape(world.addBody(fixed), {HalfSpace<S>{{0, 1, 0}, 0}, {}});
    BodyDef<S> above;
    above.pose.p = {0, 2, 0};
    const BodyId ball = world.addBody(above);
    ShapeDef<S> sphere{Sphere<S>{0.5}, {}};
    sphere.density = 700;  // [kg/m^3]
    world.addShape(ball, sphere);
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    std::printf("height %.3f, %.1f kg\n", world.pose(ball).p.y(), world.constants(ball).mass);
}
