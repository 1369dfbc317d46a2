// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ray, a moved sphere and a search for what is near; then the world moves, and the queries follow.
//> ray at 3.50 m, sphere after 3.25 m, nearest 2.50 m away; a second later the ray at 4.50 m
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> place;
    place.pose.p = {4, 0, 0};
    place.velocity = {1, 0, 0};
    addSolid<S>(world, {{Box<S>{{0.5, 0.5, 0.5}}}}, place);
    place = {};
    place.pose.p = {0, 3, 0};
    addSolid<S>(world, {{Sphere<S>{0.5}}}, place);
    WorldQueries<S> queries(world);
    const auto ray = queries.castRay({0, 0, 0}, {10, 0, 0});
    const auto sweep = queries.castShape(Sphere<S>{0.25}, {}, {10, 0, 0});
    const auto near = queries.nearest(S::Vec(0, 0, 0), 5.0);
    if (!ray || !sweep || !near) return 1;
    std::printf("ray at %.2f m, sphere after %.2f m, nearest %.2f m away; ", 10 * ray->fraction,
                10 * sweep->fraction, near->distance);
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    queries.update();  // to where the bodies are now
    const auto later = queries.castRay({0, 0, 0}, {10, 0, 0});
    std::printf("a second later the ray at %.2f m\n", later ? 10 * later->fraction : 0.0);
}
