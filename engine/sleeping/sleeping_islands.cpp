// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sleeping by islands ([Catto2005] for the use, [Ericson2005] for islands). A body is at rest while
//     |v| < linearVelocity,     |w| < angularVelocity
// and counts the time t_i it has been. An island sleeps at the end of a step when
//     min over its bodies of t_i >= timeToSleep
// and no kinematic body that moves touches it: its velocities are set to zero and it is left out from then
// on. All of it, or a body would sleep on one that is about to give way.
//
// It wakes, all of it, when a body of the same island is awake and not at rest (a contact or joint with it is
// how that body came to be in the island; contacts ahead count), or a kinematic body that moves touches it.
// The world wakes it for a force, a new velocity, shape or joint, and when a neighbour is removed
// (WorldParts::wakeIslandOf). An awake body at rest wakes no other; it goes to sleep beside the others in its
// time.
//
// Cost: O(bodies + contacts) per step. Limits: the kinetic energy at falling asleep, at most
// (m linearVelocity^2 + I angularVelocity^2) / 2 per body, is lost; slower creep than the thresholds stops;
// a body held up at the highest point of its way for longer than timeToSleep, without contact, sleeps there.
#include "engine/sleeping/sleeping.hpp"

namespace rigor::engine {
namespace {

template <class S>
bool atRest(const SleepStep<S>& step, std::uint32_t i) {
    const Velocity<S>& velocity = step.bodies.velocity[i];
    return velocity.v.squaredNorm() < step.linearVelocity * step.linearVelocity &&
           dotAng(velocity.w, velocity.w) < step.angularVelocity * step.angularVelocity;
}

/// Marks the islands that a moving kinematic body touches.
template <class S>
void markPushed(const SleepStep<S>& step) {
    step.marked.assign(step.islands.count(), 0);
    const auto moving = [&](std::uint32_t i) {
        const Velocity<S>& velocity = step.bodies.velocity[i];
        return step.bodies.constants[i].type == BodyType::Kinematic &&
               (velocity.v.squaredNorm() > 0 || dotAng(velocity.w, velocity.w) > 0);
    };
    for (const Contact<S>& contact : step.contacts) {
        if (contact.vetoed) continue;
        const std::uint32_t a = step.islands.islandOf(contact.bodyA),
                            b = step.islands.islandOf(contact.bodyB);
        if (b != kNullIndex && moving(contact.bodyA)) step.marked[b] = 1;
        if (a != kNullIndex && moving(contact.bodyB)) step.marked[a] = 1;
    }
}

template <class S>
void wake(const SleepStep<S>& step) {
    markPushed(step);
    for (std::size_t k = 0; k < step.islands.count(); ++k) {
        bool wakes = step.marked[k];
        for (const std::uint32_t i : step.islands.members(k))
            wakes = wakes || (!step.bodies.asleep[i] && !atRest(step, i));
        for (const std::uint32_t i : step.islands.members(k))
            if (wakes && step.bodies.asleep[i]) wakeBody(step.bodies, i);
    }
}

template <class S>
void rest(const SleepStep<S>& step) {
    markPushed(step);
    for (std::size_t k = 0; k < step.islands.count(); ++k) {
        bool sleeps = !step.marked[k];
        for (const std::uint32_t i : step.islands.members(k)) {
            if (step.bodies.asleep[i]) continue;
            typename S::Real& time = step.bodies.stillTime[i];
            time = atRest(step, i) ? time + step.h : typename S::Real(0);
            sleeps = sleeps && time >= step.timeToSleep;
        }
        for (const std::uint32_t i : step.islands.members(k))
            if (sleeps && !step.bodies.asleep[i]) putToSleep(step.bodies, i);
    }
}

}  // namespace

template <class S>
SleepingScheme<S> sleepingIslands() {
    return {&wake<S>, &rest<S>};
}
#define RIGOR_INSTANTIATE(S) template SleepingScheme<S> sleepingIslands<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
