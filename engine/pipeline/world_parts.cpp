// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/world_parts.hpp"

#include "engine/state/sleep.hpp"

namespace rigor::engine {

template <class S>
WorldParts<S>::WorldParts(const WorldDef<S>& definition)
    : def(definition), algorithms(definition), tasks(definition.threads) {
    contacts.materials().setCombineRules(algorithms.combineFriction, algorithms.combineRestitution);
}

/// The last body takes the place of the removed one; likewise its shapes and joints.
template <class S>
void WorldParts<S>::removeBody(BodyId body) {
    wakeNeighboursOf(bodies.dense(body));
    const auto [gone, last] = bodies.remove(body);
    contacts.shapes().bodyRemoved(gone, last);
    joints.bodyRemoved(gone, last);
    forces.bodyRemoved(gone, last);
    jointsChanged();
    contacts.structureChanged(true);
    algorithms.broadPhase->reset();
    islands.changed();
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
    BodyArrays<S>& all = bodies.arrays();
    if (algorithms.sleeping.wake && all.constants[body].type != BodyType::Dynamic)
        for (std::uint32_t i = 0; i < all.size(); ++i) wakeBody(all, i);
    wakeIslandOf(body);
}

RIGOR_INSTANTIATE_CLASS(WorldParts)

}  // namespace rigor::engine
