// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The step by island size (island_method.hpp): which islands are large, and pausing of the others.
//
// A paused body is like one asleep, but keeps its velocity: no forces, no rows, no motion. Kinematic bodies
// take part in both halves of the step, each time from where they began, and end where the usual method takes them.
#include <algorithm>
#include <utility>

#include "engine/pipeline/step.hpp"

namespace rigor::engine {

/// Sorts the islands by their contacts. Contacts and joints whose island has changed its method keep their
/// impulses as forces: the sub-steps of the two methods differ in length.
template <class S>
void Step<S>::sortIslands() {
    // Most small worlds end here.
    const auto most = static_cast<std::size_t>(def_.islandContacts);
    if (countedContacts(contacts_.list().size(), joints_.records().size()) <= most &&
        std::find(bodies_.islands.begin(), bodies_.islands.end(), IslandSize::Large) == bodies_.islands.end())
        return;
    IslandSort<S>& sort = state_.sort;
    const Islands& islands = world_.currentIslands();
    sort.counts.assign(islands.count(), {});
    const auto islandOf = [&](std::uint32_t a, std::uint32_t b) {
        return std::min(islands.islandOf(a), islands.islandOf(b));  // kNullIndex is above all
    };
    for (const Contact<S>& contact : contacts_.list()) {
        const std::uint32_t k = islandOf(contact.bodyA, contact.bodyB);
        if (k == kNullIndex) continue;
        ++sort.counts[k].contacts;
        sort.counts[k].large += contact.islands == IslandSize::Large;
    }
    for (const auto& record : joints_.records())
        if (const std::uint32_t k = islandOf(record.joint.a, record.joint.b); k != kNullIndex)
            ++sort.counts[k].joints;
    sort.large.assign(islands.count(), 0);
    bool any = false;
    for (std::size_t k = 0; k < islands.count(); ++k) {
        const typename IslandSort<S>::Counts& c = sort.counts[k];
        const std::size_t size = countedContacts(c.contacts, c.joints);
        sort.large[k] = size > most || (2 * c.large > c.contacts && 2 * size > most);
        any = any || sort.large[k];
    }
    if (any) joinByForces(islands);
    state_.anyUsual = state_.anyLarge = false;
    for (std::size_t k = 0; k < islands.count(); ++k)
        if (!bodies_.asleep[islands.members(k).front()])
            (sort.large[k] ? state_.anyLarge : state_.anyUsual) = true;
    state_.anyUsual = state_.anyUsual || !state_.anyLarge;
    const auto sizeOf = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t k = islandOf(a, b);
        return k != kNullIndex && sort.large[k] ? IslandSize::Large : IslandSize::Usual;
    };
    const Real shorter = static_cast<Real>(algorithms_.usual.substeps) / Real(algorithms_.large->substeps);
    const auto factorTo = [&](IslandSize to) {
        return to == IslandSize::Large ? shorter : Real(1) / shorter;
    };
    for (Contact<S>& contact : contacts_.list()) {
        const IslandSize size = sizeOf(contact.bodyA, contact.bodyB);
        if (size == contact.islands) continue;
        contact.islands = size;
        contact.lastNormal.setZero();  // another midpoint than that of the last step
        for (auto& impulse : contact.impulses) {
            impulse.normal *= factorTo(size);
            impulse.friction *= factorTo(size);
        }
        contact.moment *= factorTo(size);
    }
    sort.before.assign(bodies_.islands.begin(), bodies_.islands.end());
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) bodies_.islands[i] = sizeOf(i, i);
    for (auto& record : joints_.records()) {
        const IslandSize size = sizeOf(record.joint.a, record.joint.b);
        if (size == record.islands) continue;
        record.islands = size;
        for (Real& impulse : record.impulse) impulse *= factorTo(size);
    }
    changeHalves(sort.before);
    if (any) sort.startPoses.assign(bodies_.pose.begin(), bodies_.pose.end());
}

/// Islands that forces connect are of one size: each end sees the other where it is at the same time.
template <class S>
void Step<S>::joinByForces(const Islands& islands) {
    IslandSort<S>& sort = state_.sort;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& record : world_.forces.records()) {
            const std::uint32_t a = islands.islandOf(record.place.a), b = islands.islandOf(record.place.b);
            if (a == kNullIndex || b == kNullIndex || sort.large[a] == sort.large[b]) continue;
            sort.large[a] = sort.large[b] = 1;
            changed = true;
        }
    }
}

/// Lets the islands of this step's method take part, and pauses the others.
template <class S>
void Step<S>::beginIslands() {
    state_.islands = &method_ == &algorithms_.usual ? IslandSize::Usual : IslandSize::Large;
    state_.substepSize = state_.size / Real(method_.substeps);
    state_.lastSubstepSize = world_.clock.lastSubstepSize;
    if (state_.islands == IslandSize::Large)
        state_.lastSubstepSize *= Real(algorithms_.usual.substeps) / Real(method_.substeps);
    motion_.beginStep();
    state_.searchedAgain = false;
    if (state_.islands == IslandSize::Large) state_.searchTime = halfOf(IslandSize::Large);
    if (method_.secondSearch > 0) state_.foreseen.assign(bodies_.velocity.begin(), bodies_.velocity.end());
    if (state_.islands == IslandSize::Large)
        placeKinematic(
            0, motion_.isAtMidpoint() ? halfOf(IslandSize::Large) - halfOf(IslandSize::Usual) : Real(0));
    if (!state_.anyUsual || !state_.anyLarge) return;
    pauseOthers();
    // Kinematic bodies take part with both sizes, each time from where they were.
    if (state_.islands == IslandSize::Usual) return placeKinematic(0);
    for (Contact<S>& contact : contacts_.list())  // they named rows of the last step
        if (contact.islands == IslandSize::Usual) contact.block.fill(kNullIndex);
}

/// Puts kinematic bodies where so many sub-steps of the usual method have taken them, and `later` [s] more.
template <class S>
void Step<S>::placeKinematic(int substeps, Real later) {
    const Real h = state_.size / Real(algorithms_.usual.substeps);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_.constants[i].type != BodyType::Kinematic) continue;
        bodies_.pose[i] = state_.sort.startPoses[i];
        for (int k = 0; k < substeps; ++k)
            algorithms_.usual.motion.carry(bodies_.pose[i], bodies_.velocity[i], h);
        if (later != 0) algorithms_.usual.motion.carry(bodies_.pose[i], bodies_.velocity[i], later);
    }
}

template <class S>
void Step<S>::pauseOthers() {
    IslandSort<S>& sort = state_.sort;
    sort.paused.resize(bodies_.size(), 0);
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_.constants[i].type != BodyType::Dynamic) continue;
        if (bodies_.islands[i] == state_.islands) {
            resume(i);
        } else if (!bodies_.asleep[i]) {
            sort.paused[i] = 1;
            bodies_.asleep[i] = 1;
            bodies_.invMass[i] = 0;
        }
    }
}

/// Empty where no body is paused.
template <class S>
std::span<const std::uint8_t> Step<S>::pausedBodies() const {
    if (state_.anyUsual && state_.anyLarge) return state_.sort.paused;
    return {};
}

template <class S>
void Step<S>::resume(std::uint32_t body) {
    if (!std::exchange(state_.sort.paused[body], std::uint8_t(0))) return;
    bodies_.asleep[body] = 0;
    bodies_.invMass[body] = Real(1) / bodies_.constants[body].mass;
}

template <class S>
void Step<S>::endIslands() {
    // The way of kinematic bodies does not depend on which islands there are.
    if (!state_.anyUsual) placeKinematic(algorithms_.usual.substeps);
    world_.clock.lastSubstepSize = state_.size / Real(algorithms_.usual.substeps);
    for (std::uint32_t i = 0; i < state_.sort.paused.size(); ++i) resume(i);
    if (state_.anyUsual && state_.anyLarge) sortImpacts();
}

/// Sorts them by time. They are few, and in order within each half of the step.
template <class S>
void Step<S>::sortImpacts() {
    const auto earlier = [](const ImpactEvent<S>& a, const ImpactEvent<S>& b) { return a.time < b.time; };
    const auto first = state_.impacts.begin();
    for (auto next = first; next != state_.impacts.end(); ++next)
        std::rotate(std::upper_bound(first, next, *next, earlier), next, next + 1);
}

#define RIGOR_INSTANTIATE(S)                                              \
    template void Step<S>::sortIslands();                                 \
    template void Step<S>::beginIslands();                                \
    template std::span<const std::uint8_t> Step<S>::pausedBodies() const; \
    template void Step<S>::endIslands();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
