// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Candidates: the pairs of shapes that may touch, made from the pairs of the broad phase.
//
//     broad phase pairs  (2,5)      (2,9)   (4,5)              sorted by pairKey
//     old candidates     (2,5)      (3,7)   (4,5)#0 (4,5)#3    sorted by pairKey, then by piece
//     new candidates     (2,5)kept  (2,9)   (4,5)#0 (4,5)#4    a merge; (3,7) and (4,5)#3 are removed
//
// Invariant: candidates are sorted as contacts are, and each has at most one contact; a candidate that
// persists keeps its slot, its contact and its cached manifold. The candidates of chains, meshes and height
// fields are per piece and found anew in every step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/contacts/collision_filter.hpp"
#include "engine/contacts/contact_search.hpp"
#include "engine/contacts/pair_search.hpp"
#include "engine/contacts/shape_set.hpp"
#include "engine/contacts/slot_list.hpp"

namespace rigor::engine {

/// Two shapes, or a shape and a piece of a surface, that may touch.
template <class S>
struct Candidate {
    using Real = typename S::Real;
    std::uint32_t a = 0, b = 0, piece = kNullIndex;  ///< index of a surface's piece, as in Contact
    std::uint32_t contact = kNullIndex;              ///< the slot of its contact, or kNullIndex
    bool ridge = false;                              ///< facesDiffer() of the pieces nearby
    std::uint32_t begun = kNullIndex;  ///< index of its new contact in ContactFinder, or kNullIndex
    bool found = false;                ///< it has a contact in this step
    bool queried = false;              ///< the narrow phase was called in this step
    // --- the cached result of the narrow phase (contact_cache.hpp)
    bool cached = false;
    bool onB = false;                         ///< the normal is fixed to B, else to A
    bool byA = false;                         ///< A is the smaller shape
    Real radius = 0;                          ///< bounding radius of the smaller shape [m]; 0: results are
                                              ///< not cached
    Real separationBound = 0;                 ///< separation of a pair without a contact:
                                              ///< Manifold::separationLowerBound
    Pose<S> relative;                         ///< the smaller shape in the frame of the other when queried
    typename S::Vec normal = S::Vec::Zero();  ///< normal in the frame of the body that it is fixed to
};

template <class S>
class Candidates {
  public:
    using Real = typename S::Real;

    /// Updates the candidates where pairs or pieces may have changed. `pairs` are taken.
    void update(const BodyArrays<S>& bodies, const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
                PairSearch<S>& pairs, const ContactSearch<S>& search, const Tasks& tasks);
    /// Must be called after shapes or bodies were added or removed, or the filter has changed.
    void invalidate() { valid_ = mayCollideHolds_ = false; }
    /// Follows the shapes to their new indices, which keep their order; kNullIndex: the shape is gone, and with it the
    /// candidates.
    void renumber(std::span<const std::uint32_t> newIndex);
    /// Swaps the two shapes of candidates whose bodies are out of order, and forgets their cached manifolds.
    void orderBodies(const ShapeSet<S>& shapes);
    /// The next step calls the narrow phase for the shapes of this body.
    void forgetCached(const ShapeSet<S>& shapes, std::uint32_t body);

    SlotList<Candidate<S>>& list() { return list_; }
    const SlotList<Candidate<S>>& list() const { return list_; }
    /// Slots of contacts whose candidate was removed; cleared by the function that removes them.
    std::vector<std::uint32_t>& orphans() { return orphans_; }

    /// Distances that the cached manifolds were found with. Results for other distances are not valid.
    const ContactSearch<S>& cachedSearch() const { return cachedSearch_; }
    ContactSearch<S>& cachedSearch() { return cachedSearch_; }
    /// Completes restored candidates: what follows from their shapes. False: they are not in order, or a shape
    /// is missing.
    bool completeRestored(const ShapeSet<S>& shapes);

  private:
    void merge(const BodyArrays<S>& bodies, const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
               const std::vector<ProxyPair>& pairs, Real speculativeDistance);
    void findPieces(const ShapeSet<S>& shapes, std::uint32_t surface, std::uint32_t other, Real distance);

    SlotList<Candidate<S>> list_;
    std::vector<std::uint64_t> keys_;  ///< pairKey of each candidate, in order
    std::vector<std::uint32_t> orphans_;
    ContactSearch<S> cachedSearch_;
    bool valid_ = false, havePieces_ = false;
    bool mayCollideHolds_ = false;  ///< the filter lets the shapes of all candidates collide
    // --- scratch of merge()
    std::vector<std::uint32_t> oldOrder_;
    std::vector<std::uint64_t> oldKeys_;
    std::vector<std::uint32_t> pieces_;
};

}  // namespace rigor::engine
