// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The step by kinds of islands (island_method.hpp): which islands are of which kind, and pausing of the others.
//
// A paused body is like one asleep, but keeps its velocity: no forces, no rows, no motion. Kinematic bodies
// take part in every pass over the step, each time from where they began, and end where the usual method takes them.
#include <algorithm>
#include <utility>

#include "engine/pipeline/step.hpp"

namespace rigor::engine {

/// Sorts the islands by their contacts. Contacts and joints whose island has changed its method keep their
/// impulses as forces: the sub-steps of the methods differ in length.
template <class S>
void Step<S>::sortIslands() {
    const auto most = static_cast<std::size_t>(def_.islandContacts);
    findViolent();
    const auto isUsual = [](IslandKind kind) { return kind == IslandKind::Usual; };
    // Most small worlds end here.
    if (countedContacts(contacts_.list().size(), joints_.records().size()) <= most &&
        !mayBeViolent(state_.sort.violent.size()) &&
        std::all_of(bodies_.islands.begin(), bodies_.islands.end(), isUsual))
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
        sort.counts[k].large += contact.islands == IslandKind::Large;
        sort.counts[k].bounces |= contact.coefficients.restitution > 0;
    }
    for (const auto& record : joints_.records())
        if (const std::uint32_t k = islandOf(record.joint.a, record.joint.b); k != kNullIndex)
            ++sort.counts[k].joints;
    countViolent(islands);
    sort.kind.assign(islands.count(), IslandKind::Usual);
    bool any = false;
    for (std::size_t k = 0; k < islands.count(); ++k) {
        const typename IslandSort<S>::Counts& c = sort.counts[k];
        const std::size_t size = countedContacts(c.contacts, c.joints);
        if (size > most || (2 * c.large > c.contacts && 2 * size > most))
            sort.kind[k] = IslandKind::Large;
        else if (isViolent(c))
            sort.kind[k] = IslandKind::Violent;
        any = any || sort.kind[k] != IslandKind::Usual;
    }
    if (any) joinByForces(islands);
    state_.any = {};
    for (std::size_t k = 0; k < islands.count(); ++k)
        if (!bodies_.asleep[islands.members(k).front()]) state_.any[sort.kind[k]] = true;
    state_.any.usual = state_.any.usual || !(state_.any.large || state_.any.violent);
    const auto kindOf = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t k = islandOf(a, b);
        return k != kNullIndex ? sort.kind[k] : IslandKind::Usual;
    };
    // Impulses are of sub-steps.
    const auto factor = [&](IslandKind from, IslandKind to) {
        return Real(algorithms_.method(from).substeps) / Real(algorithms_.method(to).substeps);
    };
    for (Contact<S>& contact : contacts_.list()) {
        const IslandKind kind = kindOf(contact.bodyA, contact.bodyB);
        if (kind == contact.islands) continue;
        const Real share = factor(contact.islands, kind);
        contact.islands = kind;
        contact.lastNormal.setZero();  // another midpoint than that of the last step
        for (auto& impulse : contact.impulses) {
            impulse.normal *= share;
            impulse.friction *= share;
        }
        contact.moment *= share;
    }
    sort.before.assign(bodies_.islands.begin(), bodies_.islands.end());
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) bodies_.islands[i] = kindOf(i, i);
    for (auto& record : joints_.records()) {
        const IslandKind kind = kindOf(record.joint.a, record.joint.b);
        if (kind == record.islands) continue;
        const Real share = factor(record.islands, kind);
        record.islands = kind;
        for (Real& impulse : record.impulse) impulse *= share;
    }
    changeHalves(sort.before);
    if (any) sort.startPoses.assign(bodies_.pose.begin(), bodies_.pose.end());
}

/// Islands that forces connect are of one kind: each end sees the other where it is at the same time.
template <class S>
void Step<S>::joinByForces(const Islands& islands) {
    IslandSort<S>& sort = state_.sort;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& record : world_.forces.records()) {
            const std::uint32_t a = islands.islandOf(record.place.a), b = islands.islandOf(record.place.b);
            if (a == kNullIndex || b == kNullIndex || sort.kind[a] == sort.kind[b]) continue;
            const bool large = sort.kind[a] == IslandKind::Large || sort.kind[b] == IslandKind::Large;
            sort.kind[a] = sort.kind[b] = large ? IslandKind::Large : IslandKind::Usual;
            changed = true;
        }
    }
}

/// Lets the islands of this step's method take part, and pauses the others.
template <class S>
void Step<S>::beginIslands() {
    const IslandKind kind = state_.islands = kind_;
    state_.substepSize = state_.size / Real(method_.substeps);
    state_.lastSubstepSize = world_.clock.lastSubstepSize;
    motion_.beginStep();
    state_.searchedAgain = false;
    if (method_.secondSearch > 0) state_.foreseen.assign(bodies_.velocity.begin(), bodies_.velocity.end());
    if (kind != IslandKind::Usual) {
        state_.lastSubstepSize *= Real(algorithms_.usual.substeps) / Real(method_.substeps);
        state_.searchTime[kind] = halfOf(kind);
        placeKinematic(0, motion_.isAtMidpoint() ? halfOf(kind) - halfOf(IslandKind::Usual) : Real(0));
    }
    if (!isShared()) return;
    pauseOthers();
    // Kinematic bodies take part with all kinds, each time from where they were.
    if (kind == IslandKind::Usual) return placeKinematic(0);
    if (kind == IslandKind::Violent && state_.any.large) return;
    for (Contact<S>& contact : contacts_.list())  // they named rows of the last step
        if (contact.islands != kind) contact.block.fill(kNullIndex);
}

/// Whether islands of several kinds are awake.
template <class S>
bool Step<S>::isShared() const {
    return int(state_.any.usual) + int(state_.any.large) + int(state_.any.violent) > 1;
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
    if (isShared()) return state_.sort.paused;
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
    if (!state_.any.usual) placeKinematic(algorithms_.usual.substeps);
    world_.clock.lastSubstepSize = state_.size / Real(algorithms_.usual.substeps);
    for (std::uint32_t i = 0; i < state_.sort.paused.size(); ++i) resume(i);
    if (isShared()) sortImpacts();
}

/// Sorts them by time. They are few, and in order within each pass.
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
