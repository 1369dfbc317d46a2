// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Islands of a world, and what of a world's building and steering wakes bodies.
#include "engine/pipeline/world.hpp"

namespace rigor::engine {

template <class S>
void World<S>::findIslands() const {
    islandsStale_ = false;
    const auto dynamic = [&](std::uint32_t i) { return bodies_.constants[i].type == BodyType::Dynamic; };
    islandMarks_.resize(bodies_.size());
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) islandMarks_[i] = dynamic(i);
    islands_.begin(static_cast<std::uint32_t>(bodies_.size()));
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (dynamic(a) && dynamic(b)) islands_.join(a, b);
    };
    for (const Contact<S>& contact : contacts_.list()) join(contact.bodyA, contact.bodyB);
    for (const auto& record : joints_.records()) join(record.joint.a, record.joint.b);
    islands_.finish(islandMarks_, bodies_.id);
}

template <class S>
SleepStep<S> World<S>::sleepStep() {
    return {bodies_,
            contacts_.list(),
            islands(),
            islandMarks_,
            progress_.size,
            def_.sleepLinearVelocity,
            def_.sleepAngularVelocity,
            def_.timeToSleep};
}

/// All of it: what leans on the body must see what becomes of it.
template <class S>
void World<S>::wakeIslandOf(std::uint32_t body) {
    if (!bodies_.asleep[body]) return;
    findIslands();
    for (const std::uint32_t i : islands_.members(islands_.islandOf(body))) wakeBody(bodies_, i);
}

template <class S>
void World<S>::wakeNeighboursOf(std::uint32_t body) {
    wakeIslandOf(body);
    const auto wakeOther = [&](std::uint32_t a, std::uint32_t b) {
        if (a == body) wakeIslandOf(b);
        if (b == body) wakeIslandOf(a);
    };
    for (const Contact<S>& contact : contacts_.list()) wakeOther(contact.bodyA, contact.bodyB);
    for (const auto& record : joints_.records()) wakeOther(record.joint.a, record.joint.b);
}

#define RIGOR_INSTANTIATE(S)                             \
    template void World<S>::findIslands() const;         \
    template SleepStep<S> World<S>::sleepStep();         \
    template void World<S>::wakeIslandOf(std::uint32_t); \
    template void World<S>::wakeNeighboursOf(std::uint32_t);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
