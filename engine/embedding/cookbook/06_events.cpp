// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts that begin and end, as events of a step.
//> bounces: 3 begun
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    const auto rubber = world.addMaterial(0.5, 0.8);
    BodyDef<S> place;
    place.type = BodyType::Static;
    addSolid<S>(world, {{HalfSpace<S>{{0, 1, 0}, 0}, 0, rubber}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {0, 1.2, 0};
    addSolid<S>(world, {{Sphere<S>{0.2}, 1000, rubber}}, place);
    int begun = 0;
    for (int i = 0; i < 120; ++i)
        for (const auto& event : world.step(1.0 / 60).events) begun += event.kind == EventKind::ContactBegins;
    std::printf("bounces: %d begun\n", begun);
}
