// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of a box that slides on the ground with a sphere on it, stopped after every phase: boxes, pairs,
// manifolds, impulses and residual of every iteration, contacts, islands.
#include <cstdio>
#include <engine/engine.hpp>

using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    def.measureResiduals = true;  // residuals are natural maps of the rows, not changes by an iteration
    World<S> world(def);
    const auto wood = world.addMaterial(0.5, 0.0);
    BodyDef<S> body;
    body.type = BodyType::Static;
    world.addShape(world.addBody(body), {HalfSpace<S>{{0, 1, 0}, 0}, {}, wood});
    body.type = BodyType::Dynamic;
    body.mass = 2;
    body.inertia = S::Inertia::Identity() * 0.3;
    body.pose.p = {0, 0.5, 0};
    body.velocity = {1, 0, 0};
    world.addShape(world.addBody(body), {Box<S>{{0.5, 0.5, 0.5}}, {}, wood});
    body.mass = 1;
    body.pose.p = {0, 1.25, 0};
    world.addShape(world.addBody(body), {Sphere<S>{0.25}, {}, wood});

    world.observeIterations([](int iteration, const ConstraintRows<S>& rows, double residual) {
        std::printf("    iteration %d, residual %.1e, normal impulses", iteration, residual);
        for (const auto& block : rows.blocks)
            if (block.kind == BlockKind::Contact) std::printf(" %.4f", rows.rows[block.first].impulse);
        std::printf("\n");
    });
    for (world.beginStep(1.0 / 60); world.stepping();) {
        const Phase done = world.nextPhase();
        std::printf("%s\n", phaseName(done));
        world.runPhase();
        if (done == Phase::BroadPhase) {
            for (std::size_t i = 0; i < world.boxes().size(); ++i) {
                const auto& box = world.boxes()[i];
                std::printf("    box of %s: (%.3g, %.3g, %.3g) to (%.3g, %.3g, %.3g)\n",
                            bodyName(world.bodyOf(world.shapes()[i])).c_str(), box.min[0], box.min[1],
                            box.min[2], box.max[0], box.max[1], box.max[2]);
            }
            for (const auto& pair : world.pairs())
                std::printf("    pair %s %s\n", bodyName(world.bodyOf(world.shapes()[pair.a])).c_str(),
                            bodyName(world.bodyOf(world.shapes()[pair.b])).c_str());
        }
        if (done == Phase::NarrowPhase)
            for (const auto& c : world.manifolds())
                for (int i = 0; i < c.manifold.count; ++i)
                    std::printf("    point of %s and %s, separation %.1e\n",
                                bodyName(world.bodyOf(world.shapes()[c.shapeA])).c_str(),
                                bodyName(world.bodyOf(world.shapes()[c.shapeB])).c_str(),
                                c.manifold.points[i].separation);
    }
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    for (const auto& c : contacts) std::printf("%s\n", describe(c).c_str());
    for (std::size_t k = 0; k < world.islands().count(); ++k) {
        std::printf("island");
        for (const BodyId id : world.islands().bodies(k)) std::printf(" %s", bodyName(id).c_str());
        std::printf("\n");
    }
    std::printf("%d iterations, last residual %.1e\n", world.lastStep().iterations,
                world.lastStep().residuals.back());
}
