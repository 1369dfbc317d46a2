// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ray, a moved sphere and a search for what is near.
//> ray at 3.50 m, sphere after 3.25 m, nearest 2.50 m away
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> place;
    place.pose.p = {4, 0, 0};
    addSolid<S>(world, {{Box<S>{{0.5, 0.5, 0.5}}}}, place);
    place.pose.p = {0, 3, 0};
    addSolid<S>(world, {{Sphere<S>{0.5}}}, place);
    const WorldQueries<S> queries(world);  // they are of the world as it is now
    const auto ray = queries.castRay({0, 0, 0}, {10, 0, 0});
    const auto sweep = queries.castShape(Sphere<S>{0.25}, {}, {10, 0, 0});
    const auto near = queries.nearest(S::Vec(0, 0, 0), 5.0);
    if (!ray || !sweep || !near) return 1;
    std::printf("ray at %.2f m, sphere after %.2f m, nearest %.2f m away\n", 10 * ray->fraction,
                10 * sweep->fraction, near->distance);
}
