// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contacts of a world: its parts, and the order in which a step uses them.
//
//     shapes, materials, filter      what may collide, and how; changed by building
//       |
//     shapes.update -> pairs.update                  findPairs: boxes, broad phase
//       |
//     candidates.update -> finder.run -> list        findManifolds: narrow phase, contacts that begin and end
//       |
//     sides, events                                  at the end of the step
//
// A contact model uses the list in a step (contact_model.hpp).
//
// Invariant between the parts: candidates and list have the same order, and Candidate::contact is the slot of
// a candidate's contact. Dense indices of shapes and bodies are those of the bodies' arrays; structureChanged()
// says that they are others.
#pragma once

#include <optional>
#include <vector>

#include "engine/contacts/candidates.hpp"
#include "engine/contacts/collision_filter.hpp"
#include "engine/contacts/contact_events.hpp"
#include "engine/contacts/contact_finder.hpp"
#include "engine/contacts/material_table.hpp"
#include "engine/contacts/pair_search.hpp"
#include "engine/contacts/pre_solve.hpp"
#include "engine/contacts/sensors.hpp"
#include "engine/contacts/shape_set.hpp"
#include "engine/contacts/surface_sides.hpp"

namespace rigor::engine {

template <class S>
class Contacts {
  public:
    MaterialTable<S>& materials() { return materials_; }
    const MaterialTable<S>& materials() const { return materials_; }
    ShapeSet<S>& shapes() { return shapes_; }
    const ShapeSet<S>& shapes() const { return shapes_; }
    const CollisionFilter<S>& filter() const { return filter_; }
    PairSearch<S>& pairSearch() { return pairs_; }
    const PairSearch<S>& pairSearch() const { return pairs_; }
    Candidates<S>& candidates() { return candidates_; }
    const Candidates<S>& candidates() const { return candidates_; }
    /// Sorted by shape pair and piece.
    ContactList<S>& list() { return list_; }
    const ContactList<S>& list() const { return list_; }

    /// Bodies that a joint keeps from colliding: sorted keys (pairKey).
    void setExcluded(std::vector<std::uint64_t> pairs);
    /// Replaces the filter of a shape.
    void setShapeFilter(std::uint32_t shape, const ShapeFilter& filter);
    /// Must be called after shapes were added, bodies have changed their type, or static ones have moved.
    void structureChanged();
    /// Removes the shapes of which the flag is 1. Contacts of the others stay; those of the removed ones end.
    void removeShapes(const BodyArrays<S>& bodies, std::span<const std::uint8_t> gone);
    /// Must be called after a body has got another dense index.
    void bodyMoved(std::uint32_t from, std::uint32_t to);
    /// Must be called after a shape has got another material.
    void materialsChanged() { coefficientsOf_ = 0; }
    /// Sets the callback that is called for each contact before it is solved.
    void setPreSolve(PreSolveCall<S> call) {
        preSolve_ = std::move(call);
        coefficientsOf_ = 0;
    }
    /// The law of an impact of two shapes that continuous collision has found, with their bodies' centres of mass at
    /// pA and pB: of their materials, or of the callback. Nothing: the callback refuses it.
    std::optional<PreSolveAnswer<S>> lawOfImpact(const BodyArrays<S>& bodies, std::uint32_t shapeA,
                                                 std::uint32_t shapeB, const Manifold<S>& manifold,
                                                 const typename S::Vec& pA, const typename S::Vec& pB) const;
    Sensors<S>& sensors() { return sensors_; }
    const Sensors<S>& sensors() const { return sensors_; }

    /// The contacts of this body start the next step without impulses.
    void forgetImpulses(std::uint32_t body);

    /// Broad phase at the bodies' poses, and along their way ahead where `ahead` looks there.
    void findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase, const ContactSearch<S>& search,
                   const LookAhead<S>& ahead, const Tasks& tasks);
    /// Narrow phase of the pairs; contacts that persist keep the impulses of the last step.
    void findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                       ManifoldFunction<S> makeManifold, const LookAhead<S>& ahead, const Tasks& tasks);
    /// The second search of a step, after bodies have moved (ContactUpdate::second): manifolds of the pairs that the first
    /// has found, as far ahead as bodies move in `motionTime` [s]. Contacts may begin, and none ends. The callback is called
    /// for those that begin.
    void findAgain(const BodyArrays<S>& bodies, const SecondSearch& second, typename S::Real motionTime,
                   const NarrowPhase<S>& narrowPhase, ManifoldFunction<S> makeManifold,
                   const LookAhead<S>& ahead, const Tasks& tasks);
    /// Narrow-phase queries of the last step.
    std::size_t queries() const { return finder_.queries(); }
    /// Pairs of boxes that overlap.
    const std::vector<ProxyPair>& pairs() const { return pairs_.overlapping(shapes_); }

    /// keepSides() then refers to where the bodies are now.
    void beginWays(const BodyArrays<S>& bodies, const Tasks& tasks) {
        if (!shapes_.surfaces().empty()) shapes_.update(bodies, {}, LookAhead<S>{}, tasks);
    }
    /// Ends a step: moves bodies that have passed through a surface back (surface_sides.hpp).
    void keepSides(BodyArrays<S>& bodies, const Tasks& tasks) {
        sides_.keep(shapes_, filter_, bodies, tasks);
    }
    /// The same for the way back from midpoints, to the end of the step.
    void keepSidesOfMidpoints(BodyArrays<S>& bodies, const Tasks& tasks) {
        sides_.keepOfMidpoints(shapes_, filter_, bodies, tasks);
    }
    /// Appends an event for every contact, then for every overlap with a sensor, that has begun or ended.
    void addEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events, const Tasks& tasks) {
        events.insert(events.end(), removedEvents_.begin(), removedEvents_.end());
        removedEvents_.clear();
        events_.add(bodies, shapes_.records(), list_, finder_.ended(), events, tasks);
        sensors_.update(shapes_, filter_, bodies, events, tasks);
    }
    /// Completes a restored state. False: contacts and cached manifolds are inconsistent, or a shape is
    /// missing.
    bool completeRestored();

  private:
    void runFinder(const BodyArrays<S>& bodies, const ContactSearch<S>& search, const SecondSearch& second,
                   const NarrowPhase<S>& narrowPhase, ManifoldFunction<S> makeManifold,
                   const LookAhead<S>& ahead, const Tasks& tasks);
    void findTouched(const BodyArrays<S>& bodies);
    template <class IsNew>
    void callPreSolve(const BodyArrays<S>& bodies, const IsNew& isNew);

    MaterialTable<S> materials_;
    ShapeSet<S> shapes_;
    CollisionFilter<S> filter_;
    PairSearch<S> pairs_;
    Candidates<S> candidates_;
    ContactList<S> list_;
    ContactFinder<S> finder_;
    SurfaceSides<S> sides_;
    ContactEvents<S> events_;
    std::vector<Event<S>> removedEvents_;  ///< ends of contacts whose shapes were removed since the last step
    Sensors<S> sensors_;
    PreSolveCall<S> preSolve_;
    std::vector<std::uint8_t> touched_;  ///< ContactUpdate::touched
    ContactSearch<S> search_;            ///< search distances of this step
    /// Revision of the materials that the coefficients of the list are from; 0: some may be from none.
    std::uint64_t coefficientsOf_ = 0;
};

}  // namespace rigor::engine
