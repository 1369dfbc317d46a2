// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A sphere falls on the ground and stays there.
#include <cstdio>
#include <engine/engine.hpp>

using namespace rigor::engine;

int main() {
    WorldDef<Space3d> def;
    def.gravity = {0, -9.81, 0};
    World<Space3d> world(def);
    const auto wood = world.addMaterial(0.5, 0.0);
    BodyDef<Space3d> body;
    body.pose.p = {0, 2, 0};
    const BodyId ball = world.addBody(body);
    world.addShape(ball, {Sphere<Space3d>{0.5}, {}, wood});
    body.type = BodyType::Static;
    body.pose.p = {0, 0, 0};
    world.addShape(world.addBody(body), {HalfSpace<Space3d>{{0, 1, 0}, 0}, {}, wood});
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    std::printf("height %.4f\n", world.pose(ball).p.y());
}
