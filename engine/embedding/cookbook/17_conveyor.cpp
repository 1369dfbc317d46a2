// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A conveyor: the surface of a static shape moves over its body, carries a parcel, and is stopped.
//> on the belt 1.50 m/s, stopped 2.25 m from the start
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
    const BodyId base = world.addBody(place);
    ShapeDef<S> surface;
    surface.shape = Box<S>{{5, 0.1, 0.5}};
    surface.surfaceVelocity.v = {1.5, 0, 0};  // velocity of the surface over the body, axes of the body
    const ShapeId belt = world.addShape(base, surface);
    place.type = BodyType::Dynamic;
    place.pose.p = {-2, 0.3, 0};
    const BodyId parcel = addSolid<S>(world, {{Box<S>{{0.2, 0.2, 0.2}}}}, place);
    for (int i = 0; i < 90; ++i) world.step(1.0 / 60);
    std::printf("on the belt %.2f m/s, ", world.velocity(parcel).x());
    world.setSurfaceVelocity(belt, {});
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    std::printf("stopped %.2f m from the start\n", world.pose(parcel).p.x() + 2);
}
