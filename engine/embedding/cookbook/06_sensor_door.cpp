// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A door that opens while a body is in front of it: a sensor, and the events of a step.
//> open from 0.38 s to 1.68 s
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> place;
    place.type = BodyType::Static;
    ShapeDef<S> front{Box<S>{{1, 1, 1}}, {}};
    front.sensor = true;
    const ShapeId sensor = world.addShape(world.addBody(place), front);
    place.type = BodyType::Kinematic;
    place.pose.p = {0, 0, 2};
    const BodyId door = world.addBody(place);
    world.addShape(door, {Box<S>{{0.5, 1, 0.05}}, {}});
    place.pose.p = {-2.05, 0, 0};
    place.velocity = {2, 0, 0};
    place.type = BodyType::Dynamic;
    addSolid<S>(world, {{Sphere<S>{0.3}}}, place);
    double opened = 0, closed = 0;
    for (int i = 0; i < 180; ++i)
        for (const auto& event : world.step(1.0 / 60).events) {
            (event.kind == EventKind::SensorBegins ? opened : closed) = world.time();
            const bool occupied = !world.sensorOverlaps(sensor).empty();
            world.setVelocity(door, {0, occupied ? 1.0 : -1.0, 0}, {0, 0, 0});
        }
    std::printf("open from %.2f s to %.2f s\n", opened, closed);
}
