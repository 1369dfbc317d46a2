// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world_parts.hpp"

#include "engine/ccd/traits.hpp"
#include "engine/contacts/moving_shape.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {

template <class S>
WorldParts<S>::WorldParts(const WorldDef<S>& definition)
    : def(definition), algorithms(definition), tasks(definition.threads) {
    contacts.materials().setCombineRules(algorithms.combineFriction, algorithms.combineRestitution);
}

/// The last body takes the place of the removed one; likewise its joints.
template <class S>
void WorldParts<S>::removeBody(BodyId body) {
    const std::uint32_t dense = bodies.dense(body);
    wakeNeighboursOf(dense);
    std::vector<std::uint8_t> without;
    for (const ShapeRecord<S>& shape : contacts.shapes().records()) without.push_back(shape.body == dense);
    contacts.removeShapes(bodies.arrays(), without);
    const auto [gone, last] = bodies.remove(body);
    if (gone != last) contacts.bodyMoved(last, gone);
    joints.bodyRemoved(gone, last);
    forces.bodyRemoved(gone, last);
    jointsChanged();
    algorithms.broadPhase->reset();
    islands.changed();
}

template <class S>
void WorldParts<S>::removeShape(ShapeId shape) {
    const std::uint32_t dense = contacts.shapes().ids().dense(shape);
    const std::uint32_t body = contacts.shapes()[dense].body;
    wakeNeighboursOf(body);
    std::vector<std::uint8_t> without(contacts.shapes().size(), 0);
    without[dense] = 1;
    contacts.removeShapes(bodies.arrays(), without);
    sumShapeMasses(body);
    algorithms.broadPhase->reset();
    islands.changed();
}

template <class S>
void WorldParts<S>::addShapeMass(std::uint32_t body) {
    BodyMass<S>& mass = bodies.mass(body);
    ++mass.shapeCount;
    const BodyConstants<S>& constants = bodies.arrays().constants[body];
    if (mass.byHand() || constants.type != BodyType::Dynamic) return;
    addMass<S>(massOfShape<S>(contacts.shapes().records().back(), constants.centerOfMass), mass.shapes);
    updateMass(body);
}

template <class S>
void WorldParts<S>::sumShapeMasses(std::uint32_t body) {
    BodyMass<S>& mass = bodies.mass(body);
    const BodyConstants<S>& constants = bodies.arrays().constants[body];
    mass.shapes = BodyMass<S>{}.shapes;
    mass.shapeCount = 0;
    for (const ShapeRecord<S>& shape : contacts.shapes().records()) {
        if (shape.body != body) continue;
        ++mass.shapeCount;
        if (constants.type == BodyType::Dynamic && !mass.byHand())
            addMass<S>(massOfShape<S>(shape, constants.centerOfMass), mass.shapes);
    }
    updateMass(body);
}

/// Shapes of a body just built are the last ones: the search ends there.
template <class S>
void WorldParts<S>::updateMass(std::uint32_t body) {
    const typename S::Vec way = bodies.applyMass(body);
    if (way.isZero(0)) return;
    std::vector<ShapeRecord<S>>& shapes = contacts.shapes().records();
    std::uint32_t left = bodies.mass(body).shapeCount;
    for (std::size_t i = shapes.size(); i-- > 0 && left > 0;) {
        ShapeRecord<S>& shape = shapes[i];
        if (shape.body != body) continue;
        --left;
        shape.local.p -= way;
        shape.boundingRadius = coreBoundingRadius<S>(shape.shape, shape.local);
        shape.surface.v += cross(shape.surface.w, way);
    }
    joints.centerMoved(body, way);
    forces.centerMoved(body, way);
    contacts.candidates().forgetCached(contacts.shapes(), body);
}

template <class S>
void WorldParts<S>::setContinuous(std::uint32_t body, ContinuousMode mode) {
    BodyConstants<S>& constants = bodies.arrays().constants[body];
    const bool always = continuousCollisionTraits(def.continuousCollision).acts;
    constants.continuousMode = mode;
    constants.continuous = mode == ContinuousMode::On || (mode == ContinuousMode::World && always);
    if (!constants.continuous || algorithms.continuous) return;
    WorldDef<S> with = def;
    with.continuousCollision = "conservative_advancement";
    algorithms = StepAlgorithms<S>(with);
}

template <class S>
void WorldParts<S>::wakeAll() {
    for (std::uint32_t i = 0; algorithms.sleeping.wake && i < bodies.size(); ++i)
        wakeBody(bodies.arrays(), i);
}

template <class S>
void WorldParts<S>::removeJoint(JointId joint) {
    currentIslands();  // finds the islands of the last step
    const Joint<S>& gone = joints.joint(joint);
    wakeIslandOf(gone.a);
    wakeIslandOf(gone.b);
    joints.remove(joint);
    jointsChanged();
}

template <class S>
void WorldParts<S>::wakeIslandOf(std::uint32_t body) {
    if (!bodies.arrays().asleep[body]) return;
    islands.find(links());
    const Islands& now = currentIslands();
    for (const std::uint32_t i : now.members(now.islandOf(body))) wakeBody(bodies.arrays(), i);
}

template <class S>
void WorldParts<S>::wakeNeighboursOf(std::uint32_t body) {
    wakeIslandOf(body);
    const auto wakeOther = [&](std::uint32_t a, std::uint32_t b) {
        if (a == body) wakeIslandOf(b);
        if (b == body) wakeIslandOf(a);
    };
    for (const Contact<S>& contact : contacts.list()) wakeOther(contact.bodyA, contact.bodyB);
    for (const auto& record : joints.records()) wakeOther(record.joint.a, record.joint.b);
}

template <class S>
void WorldParts<S>::wakeReachOf(std::uint32_t body) {
    if (bodies.arrays().constants[body].type != BodyType::Dynamic) wakeAll();
    wakeIslandOf(body);
}

#define RIGOR_INSTANTIATE(S) template struct WorldParts<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
