// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Debris falls through the players and lands on the floor: layers and masks.
//> player at 0.50 m, debris at 0.10 m
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    enum Layer : std::uint64_t { kScenery = 1, kPlayers = 2, kDebris = 4 };
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    const auto add = [&](double height, const Shape<S>& shape, BodyType type, const ShapeFilter& filter) {
        BodyDef<S> place;
        place.type = type;
        place.pose.p = {0, height, 0};
        ShapeDef<S> part{shape, {}};
        part.filter = filter;
        const BodyId body = world.addBody(place);
        world.addShape(body, part);
        return body;
    };
    add(0, HalfSpace<S>{{0, 1, 0}, 0}, BodyType::Static, {.layers = kScenery});
    const BodyId player = add(0.5, Box<S>{{0.5, 0.5, 0.5}}, BodyType::Dynamic, {.layers = kPlayers});
    const BodyId debris = add(3, Sphere<S>{0.1}, BodyType::Dynamic, {.layers = kDebris, .mask = kScenery});
    for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
    std::printf("player at %.2f m, debris at %.2f m\n", world.pose(player).p.y(), world.pose(debris).p.y());
}
