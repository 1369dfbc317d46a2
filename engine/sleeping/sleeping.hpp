// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sleeping: bodies that have come to rest are left out of the step; the family `sleeping`.
//
// A body asleep stays exactly where it is: no forces, no rows, no motion; its contacts are kept as they were.
// For other bodies it is a body that takes no momentum. It wakes with its whole island.
#pragma once

#include <span>
#include <vector>

#include "engine/contacts/contact.hpp"
#include "engine/core/table.hpp"
#include "engine/sleeping/islands.hpp"
#include "engine/state/sleep.hpp"

namespace rigor::engine {

template <class S>
struct SleepStep {
    using Real = typename S::Real;
    BodyArrays<S>& bodies;
    const ContactList<S>& contacts;
    const Islands& islands;             ///< islands of the contacts and joints of this step
    std::vector<std::uint8_t>& marked;  ///< scratch, by island
    Real h;                             ///< length of the whole step [s]
    Real linearVelocity;                ///< slower is at rest [m/s]
    Real angularVelocity;               ///< slower is at rest [rad/s]
    Real timeToSleep;                   ///< time that all bodies of an island must have been at rest [s]
};

template <class S>
struct SleepingScheme {
    /// Wakes bodies, when contacts are known and before rows are made. Null: no body ever sleeps.
    void (*wake)(const SleepStep<S>& step) = nullptr;
    /// Called at the end of the step: puts bodies to sleep.
    void (*rest)(const SleepStep<S>& step) = nullptr;
};
template <class S>
using SleepingFactory = SleepingScheme<S> (*)();
template <class S>
std::span<const AlgorithmEntry<SleepingFactory<S>>> sleepingTable();

}  // namespace rigor::engine
