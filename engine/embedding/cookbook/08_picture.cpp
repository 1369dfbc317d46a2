// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A picture of a world, by a sink of lines: here SVG, or any program's own.
//> 12 edges, 4 contact points
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

struct Counter : LineSink<S> {
    int edges = 0, points = 0;
    void line(const Vec&, const Vec&, DebugKind kind, BodyId body) override {
        edges += kind == DebugKind::Outline && body.index == 2;  // the second body
    }
    void point(const Vec&, DebugKind kind, BodyId) override { points += kind == DebugKind::Contact; }
};

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    BodyDef<S> place;
    place.type = BodyType::Static;
    addSolid<S>(world, {{HalfSpace<S>{{0, 1, 0}, 0}}}, place);
    place.type = BodyType::Dynamic;
    place.pose.p = {0, 0.5, 0};
    addSolid<S>(world, {{Box<S>{{0.5, 0.5, 0.5}}}}, place);
    world.step(1.0 / 60);
    Counter counter;
    drawWorld<S>(world, {}, counter);
    SvgLines<S> picture;
    drawWorld<S>(world, {}, picture);
    if (picture.text().empty()) return 1;  // write it to a file
    std::printf("%d edges, %d contact points\n", counter.edges, counter.points);
}
