// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two balls of 300 m/s and a plate of a centimetre: one is a bullet, in a world that looks at no other that closely.
//> the bullet is stopped, the ball is through
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> place;
    place.type = BodyType::Static;
    place.pose.p = {2.1, 0, 0};
    addSolid<S>(world, {{Box<S>{{0.005, 2, 2}}}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {0, 0, 0};
    place.velocity = {300, 0, 0};
    place.continuous = ContinuousMode::On;
    const BodyId bullet = addSolid<S>(world, {{Sphere<S>{0.05}}}, place);
    place.pose.p = {0, 1, 0};
    place.continuous = ContinuousMode::World;
    const BodyId ball = addSolid<S>(world, {{Sphere<S>{0.05}}}, place);
    for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
    const auto result = [&](BodyId body) { return world.pose(body).p.x() < 2.1 ? "stopped" : "through"; };
    std::printf("the bullet is %s, the ball is %s\n", result(bullet), result(ball));
}
