// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Update of one contact: manifold from the poses of two shapes, and impulses from the points of the last
// step.
//
//     cached manifold valid   moved with the bodies; impulses stay
//     else                    narrow phase -> points reduced to the manifold of the solver -> cache;
//                             impulses by feature, from the points before
//     both                    speculative points of continuous collision, coefficients, touching
//
// Different contacts may be updated by different threads: nothing but the candidate and the contact is
// written to.
#pragma once

#include <optional>
#include <span>

#include "engine/contacts/contact_cache.hpp"
#include "engine/contacts/look_ahead.hpp"
#include "engine/contacts/material_table.hpp"

namespace rigor::engine {

/// A second search within a step (pipeline/step_second_search.cpp).
struct SecondSearch {
    /// Flag of each body, 1: its motion was not foreseen by the first search. Empty: the search is the first.
    std::span<const std::uint8_t> disturbed;
    IslandKind islands = IslandKind::Usual;  ///< kind of the islands that take part
};

/// Input that contacts are made from in one step.
template <class S>
struct ContactUpdate {
    const BodyArrays<S>& bodies;
    const ShapeSet<S>& shapes;
    const MaterialTable<S>& materials;
    const NarrowPhase<S>& narrowPhase;
    ManifoldFunction<S> makeManifold;  ///< null: all points of the narrow phase are used
    const LookAhead<S>& ahead;
    ContactCache<S> cache;
    bool coefficientsHold;        ///< coefficients of persisting contacts are those of their materials
    typename S::Real motionTime;  ///< ContactSearch::longestMotionTime() [s]
    bool bouncesAhead;            ///< ContactSearch::bouncesAhead
    std::span<const std::uint8_t>
        touched;  ///< dynamic bodies that touched something in the last step; where ahead
    SecondSearch second = {};

    /// Updates a contact of the last step. False: it has ended.
    bool update(Candidate<S>& candidate, Contact<S>& contact) const;
    /// The new contact of a candidate that had none in the last step, if there is one.
    std::optional<Contact<S>> find(Candidate<S>& candidate) const;

    // --- in the second search of a step
    bool isSecond() const { return !second.disturbed.empty(); }
    /// Finds the manifold of a contact again, or moves it with its bodies if neither is disturbed. The contact stays one,
    /// with its impulses, until the step ends.
    void refresh(Candidate<S>& candidate, Contact<S>& contact) const;
    /// A candidate without a contact may have one now.
    bool mayBegin(const Candidate<S>& candidate) const;

  private:
    using Real = typename S::Real;

    bool isDisturbed(const Candidate<S>& candidate) const;
    void queryAgain(Candidate<S>& candidate, Contact<S>& contact) const;
    void query(Candidate<S>& candidate, Manifold<S>& manifold) const;
    void dropFarPoints(Candidate<S>& candidate, Manifold<S>& manifold) const;
    bool mayMeet(const Candidate<S>& candidate) const;
    void makePoints(Candidate<S>& candidate, Contact<S>& contact) const;
    bool complete(Candidate<S>& candidate, Contact<S>& contact) const;
};

}  // namespace rigor::engine
