// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A platform that is solid from above only: a callback refuses its contacts with what comes from below.
//> rose to 3.8 m, rests at 2.35 m
#include <algorithm>
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    BodyDef<S> place;
    place.type = BodyType::Static;
    place.pose.p = {0, 2, 0};
    const BodyId platform = addSolid<S>(world, {{Box<S>{{2, 0.1, 2}}}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {0, 0.5, 0};
    place.velocity = {0, 8, 0};
    const BodyId ball = addSolid<S>(world, {{Sphere<S>{0.25}}}, place);
    world.setPreSolve([&](PreSolveContact<S>& contact) {  // the platform was added first: it is A
        if (contact.bodyA != platform) return;
        const bool above = contact.normal.y() > 0.7 && contact.points[0].separation > -0.05;
        contact.veto = !above || contact.velocity.y() > 0.1;
    });
    double highest = 0;
    for (int i = 0; i < 240; ++i) {
        world.step(1.0 / 60);
        highest = std::max(highest, world.pose(ball).p.y());
    }
    std::printf("rose to %.1f m, rests at %.2f m\n", highest, world.pose(ball).p.y());
}
