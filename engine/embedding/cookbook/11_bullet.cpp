// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball of 300 m/s and a plate of a centimetre.
//> stopped, impact after 0.007 s
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.continuousCollision = "conservative_advancement";
    World<S> world(def);
    BodyDef<S> place;
    place.type = BodyType::Static;
    place.pose.p = {2.1, 0, 0};
    addSolid<S>(world, {{Box<S>{{0.005, 1, 1}}}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {0, 0, 0};
    place.velocity = {300, 0, 0};
    const BodyId ball = addSolid<S>(world, {{Sphere<S>{0.05}}}, place);
    const auto& step = world.step(1.0 / 60);
    if (step.impacts.empty()) return 1;
    const double when = step.impacts[0].time;
    for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
    std::printf("%s, impact after %.3f s\n", world.pose(ball).p.x() < 2.1 ? "stopped" : "through", when);
}
