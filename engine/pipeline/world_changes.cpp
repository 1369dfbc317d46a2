// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Changes of a world that runs: shapes that go, and bodies, shapes and gravity that become others.
#include <cmath>

#include "engine/pipeline/require.hpp"
#include "engine/pipeline/shape_def.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::engine {

template <class S>
void World<S>::requireBetweenSteps() const {
    require(!stepping(), "step_in_progress",
            "a world cannot change during a step: between its phases, or from a callback");
}

template <class S>
void World<S>::removeShape(ShapeId shape) {
    requireBetweenSteps();
    parts_.removeShape(shape);
}

template <class S>
void World<S>::setType(BodyId body, BodyType type) {
    requireBetweenSteps();
    const std::uint32_t i = parts_.bodies.dense(body);
    if (parts_.bodies.constants(body).type == type) return;
    for (const ShapeRecord<S>& shape : shapes())
        if (shape.body == i) requireBodyType<S>(shape.shape, type);
    parts_.wakeNeighboursOf(i);
    parts_.bodies.setType(i, type);
    parts_.sumShapeMasses(i);
    parts_.contacts.structureChanged();
    parts_.algorithms.broadPhase->reset();
    parts_.islands.changed();
    parts_.wakeReachOf(i);
}

template <class S>
void World<S>::setMass(BodyId body, const MassProperties<S>& properties) {
    requireBetweenSteps();
    checkMass<S>(properties);
    const std::uint32_t i = parts_.bodies.dense(body);
    require(parts_.bodies.constants(body).type == BodyType::Dynamic, "body_mass",
            "only a dynamic body has a mass");
    parts_.wakeIslandOf(i);
    BodyMass<S>& mass = parts_.bodies.mass(i);
    mass.mass = properties.mass;
    mass.center = properties.center;
    mass.inertia = properties.inertia;
    parts_.updateMass(i);
}

template <class S>
void World<S>::setMassOfShapes(BodyId body, Real mass) {
    requireBetweenSteps();
    require(mass >= 0 && std::isfinite(mass), "body_mass",
            "mass must be positive, or 0 for that of the shapes");
    const std::uint32_t i = parts_.bodies.dense(body);
    parts_.wakeIslandOf(i);
    BodyMass<S>& given = parts_.bodies.mass(i);
    given.mass = mass;
    given.inertia = zeroInertia<S>();
    parts_.sumShapeMasses(i);
}

template <class S>
void World<S>::setDensity(ShapeId shape, Real density) {
    requireBetweenSteps();
    require(density >= 0 && std::isfinite(density), "shape_density",
            "density must be finite and not negative");
    ShapeRecord<S>& record = parts_.contacts.shapes().records()[parts_.contacts.shapes().ids().dense(shape)];
    require(!record.sensor, "shape_density", "a sensor has no mass");
    parts_.wakeIslandOf(record.body);
    record.density = density;
    parts_.sumShapeMasses(record.body);
}

template <class S>
void World<S>::setMaterial(ShapeId shape, std::uint32_t material) {
    requireBetweenSteps();
    requireMaterial(material, parts_.contacts.materials().size());
    ShapeRecord<S>& record = parts_.contacts.shapes().records()[parts_.contacts.shapes().ids().dense(shape)];
    parts_.wakeNeighboursOf(record.body);
    record.material = material;
    parts_.contacts.materialsChanged();
}

template <class S>
void World<S>::setGravity(const Vec& gravity) {
    requireBetweenSteps();
    require(gravity.allFinite(), "gravity", "gravity must be finite");
    parts_.def.gravity = gravity;
    parts_.gravityChanged = true;
    parts_.wakeAll();
}

template <class S>
void World<S>::setGravityScale(BodyId body, Real scale) {
    requireBetweenSteps();
    require(std::isfinite(scale), "body_gravity_scale", "gravity scale must be finite");
    const std::uint32_t i = parts_.bodies.dense(body);
    parts_.wakeIslandOf(i);
    parts_.bodies.arrays().constants[i].gravityScale = scale;
}

template <class S>
void World<S>::setContinuous(BodyId body, ContinuousMode mode) {
    requireBetweenSteps();
    parts_.setContinuous(parts_.bodies.dense(body), mode);
}

template <class S>
std::span<const SensorOverlap> World<S>::sensorOverlaps(ShapeId sensor) const {
    const ShapeSet<S>& all = parts_.contacts.shapes();
    require(all[all.ids().dense(sensor)].sensor, "sensor", "the shape is not a sensor");
    return parts_.contacts.sensors().overlapsOf(sensor);
}

#define RIGOR_INSTANTIATE(S)                                           \
    template void World<S>::requireBetweenSteps() const;               \
    template void World<S>::removeShape(ShapeId);                      \
    template void World<S>::setType(BodyId, BodyType);                 \
    template void World<S>::setMass(BodyId, const MassProperties<S>&); \
    template void World<S>::setMassOfShapes(BodyId, Real);             \
    template void World<S>::setDensity(ShapeId, Real);                 \
    template void World<S>::setMaterial(ShapeId, std::uint32_t);       \
    template void World<S>::setGravity(const Vec&);                    \
    template void World<S>::setGravityScale(BodyId, Real);             \
    template void World<S>::setContinuous(BodyId, ContinuousMode);     \
    template std::span<const SensorOverlap> World<S>::sensorOverlaps(ShapeId) const;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
