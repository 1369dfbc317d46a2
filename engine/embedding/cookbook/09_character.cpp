// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A character on a height field: a capsule that stays upright and walks where the program says.
//> walked 6 m, on the ground
#include <cmath>
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    std::vector<double> heights;
    for (int k = 0; k < 41; ++k)
        for (int i = 0; i < 41; ++i) heights.push_back(0.3 * std::sin(0.5 * i) * std::cos(0.4 * k));
    BodyDef<S> place;
    place.type = BodyType::Static;
    addSolid<S>(world, {{makeHeightField<S>(41, 41, 0.5, 0.5, heights, 1.0)}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {-3, 1.5, 0};
    const BodyId character = addSolid<S>(world, {{Capsule<S>{0.3, 0.6}, 900, kFrictionless}}, place);
    JointDef<S> upright;  // it may move in all directions and turn in none
    upright.type = JointType::SixDof;
    upright.bodyB = character;  // bodyA is the world
    upright.anchorA = place.pose.p;
    for (int k = 0; k < 6; ++k) upright.axes[k].mode = k < 3 ? AxisMode::Free : AxisMode::Locked;
    world.addJoint(upright);
    for (int i = 0; i < 360; ++i) {
        const double falling = world.velocity(character).y();
        const bool started = i >= 60;  // it has landed by then
        world.setVelocity(character, {started ? 1.2 : 0.0, falling, 0}, {0, 0, 0});
        world.step(1.0 / 60);
    }
    const auto p = world.pose(character).p;
    const auto down = WorldQueries<S>(world).castRay(p, {0, -3, 0}, [&](BodyId b) { return b != character; });
    std::printf("walked %.0f m, %s\n", p.x() + 3,
                down && 3 * down->fraction < 1.1 ? "on the ground" : "lost");
}
