// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A pyramid of 385 boxes with the settings for large scenes, on two threads.
//> top at 9.5 m
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3f;

int main() {
    auto def = WorldDef<S>::preset("fast");
    def.gravity = {0, -9.81f, 0};
    def.threads = 2;
    World<S> world(def);
    BodyDef<S> place;
    place.type = BodyType::Static;
    addSolid<S>(world, {{HalfSpace<S>{{0, 1, 0}, 0}}}, place);
    place.type = BodyType::Dynamic;
    BodyId last;
    for (int layer = 0; layer < 10; ++layer)
        for (int i = 0; i < (10 - layer) * (10 - layer); ++i) {
            const int side = 10 - layer;
            place.pose.p = {1.05f * float(i % side) + 0.525f * float(layer), 0.5f + float(layer),
                            1.05f * float(i / side) + 0.525f * float(layer)};
            last = addSolid<S>(world, {{Box<S>{{0.5f, 0.5f, 0.5f}}}}, place);
        }
    for (int i = 0; i < 120; ++i) world.step(1.0f / 60);
    std::printf("top at %.1f m\n", double(world.pose(last).p.y()));
}
