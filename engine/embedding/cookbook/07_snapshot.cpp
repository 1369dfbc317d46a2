// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A snapshot, and the same future from it, bit for bit.
//> the same
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    const auto wood = world.addMaterial(0.5, 0.2);
    BodyDef<S> place;
    place.type = BodyType::Static;
    addSolid<S>(world, {{HalfSpace<S>{{0, 1, 0}, 0}, 0, wood}}, place);
    place.type = BodyType::Dynamic;
    for (int i = 0; i < 5; ++i) {
        place.pose.p = {0.2 * i, 1.0 + 1.1 * i, 0};
        addSolid<S>(world, {{Box<S>{{0.5, 0.5, 0.5}}, 500, wood}}, place);
    }
    std::vector<unsigned char> saved;
    world.saveSnapshot(saved);
    const auto run = [&] {
        for (int i = 0; i < 100; ++i) world.step(1.0 / 60);
        return world.stateHash();
    };
    const auto first = run();
    world.restoreSnapshot(saved);
    std::printf("%s\n", run() == first ? "the same" : "another");
}
