// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes for benchmarks of whole steps, and of what a step hands to its solver; the same on every machine.
#pragma once

#include <string>
#include <vector>

#include "engine/core/benchmarks/random.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::engine::benchmark_scene {

inline constexpr double kStep = 1.0 / 60.0;  ///< [s]

template <class S>
WorldDef<S> onEarth() {
    WorldDef<S> def;
    def.gravity[1] = typename S::Real(-9.81);
    return def;
}

template <class S>
class SceneBuilder {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    explicit SceneBuilder(const WorldDef<S>& def) : world(def), material_(world.addMaterial(Real(0.5), 0)) {}

    /// A body of density 1000 kg/m^3 (2D: kg/m^2).
    BodyId add(const Shape<S>& shape, const Vec& place) {
        const MassProperties<S> mass = massProperties<S>(shape, Real(1000));
        BodyDef<S> def;
        def.pose.p = place;
        def.mass = mass.mass;
        def.inertia = mass.inertia;
        def.centerOfMass = mass.center;
        const BodyId id = world.addBody(def);
        world.addShape(id, {shape, {}, material_});
        bodies.push_back(id);
        return id;
    }
    void addHalfSpace(const Vec& normal, double offset) {
        BodyDef<S> def;
        def.type = BodyType::Static;
        const BodyId id = world.addBody(def);
        world.addShape(id, {HalfSpace<S>{normal, static_cast<Real>(offset)}, {}, material_});
        bodies.push_back(id);
    }

    World<S> world;
    std::vector<BodyId> bodies;

  private:
    std::uint32_t material_;
};

template <class S>
typename S::Vec place(double x, double y, double z) {
    typename S::Vec v = S::Vec::Zero();
    const double from[3] = {x, y, z};
    for (int k = 0; k < S::dim; ++k) v[k] = static_cast<typename S::Real>(from[k]);
    return v;
}

/// Unit boxes at rest, layer i with (base - i)^2 of them (2D: base - i), 5 cm apart.
template <class S>
SceneBuilder<S> pyramid(int base, const WorldDef<S>& def = onEarth<S>()) {
    SceneBuilder<S> scene(def);
    scene.addHalfSpace(S::Vec::Unit(1), 0);
    const Box<S> box{S::Vec::Constant(typename S::Real(0.5))};
    for (int layer = 0; layer < base; ++layer)
        for (int i = 0; i < base - layer; ++i)
            for (int k = 0; k < (S::dim == 2 ? 1 : base - layer); ++k)
                scene.add(box, place<S>(1.05 * (i + 0.5 * layer), layer + 0.5, 1.05 * (k + 0.5 * layer)));
    return scene;
}

/// Spheres, boxes and capsules in turn, side by side over a floor between four (2D: two) walls.
template <class S>
SceneBuilder<S> pile(int count, const WorldDef<S>& def = onEarth<S>()) {
    using R = typename S::Real;
    SceneBuilder<S> scene(def);
    Random random(7);
    const int row = S::dim == 2 ? 6 : 4;
    const double side = 1.1 * row;
    scene.addHalfSpace(S::Vec::Unit(1), 0);
    for (int axis = 0; axis < S::dim; axis += 2) {
        scene.addHalfSpace(S::Vec::Unit(axis), 0);
        scene.addHalfSpace(-S::Vec::Unit(axis), -side);
    }
    for (int i = 0; i < count; ++i) {
        const int column = i % row, depth = S::dim == 2 ? 0 : i / row % row;
        const int layer = i / (S::dim == 2 ? row : row * row);
        const auto at = place<S>(1.1 * column + random.between(0.5, 0.6), 1.1 * layer + 0.6,
                                 1.1 * depth + random.between(0.5, 0.6));
        const auto size = static_cast<R>(random.between(0.3, 0.45));
        if (i % 3 == 0)
            scene.add(Sphere<S>{size}, at);
        else if (i % 3 == 1)
            scene.add(Box<S>{S::Vec::Constant(size)}, at);
        else
            scene.add(Capsule<S>{size / 2, size / 2}, at);
    }
    return scene;
}

/// Capsules hanging from the world one after the other by ball joints (2D: hinges), let go sideways.
template <class S>
SceneBuilder<S> chain(int links, const WorldDef<S>& def = onEarth<S>()) {
    using R = typename S::Real;
    SceneBuilder<S> scene(def);
    BodyId above;
    for (int i = 0; i < links; ++i) {
        const BodyId link = scene.add(Capsule<S>{R(0.1), R(0.15)}, place<S>(0.02 * i, -0.25 - 0.5 * i, 0));
        JointDef<S> joint;
        joint.bodyA = above;
        joint.bodyB = link;
        joint.anchorA = above ? place<S>(0, -0.25, 0) : place<S>(0, 0, 0);
        joint.anchorB = place<S>(0, 0.25, 0);
        scene.world.addJoint(joint);
        above = link;
    }
    return scene;
}

/// Input of the solver in the step after `settled` steps: rows, and velocities by dense body index.
template <class S>
struct FrozenRows {
    ConstraintRows<S> rows;
    std::vector<Velocity<S>> velocities;
};
template <class S>
FrozenRows<S> freeze(SceneBuilder<S>& scene, int settled) {
    World<S>& world = scene.world;
    for (int i = 0; i < settled; ++i) world.step(static_cast<typename S::Real>(kStep));
    world.beginStep(static_cast<typename S::Real>(kStep));
    while (world.nextPhase() != Phase::Solve) world.runPhase();
    FrozenRows<S> frozen{world.rows(), {Velocity<S>{}}};
    for (const BodyId body : scene.bodies)
        frozen.velocities.push_back({world.velocity(body), world.angularVelocity(body)});
    while (world.stepping()) world.runPhase();
    return frozen;
}

}  // namespace rigor::engine::benchmark_scene
