// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes, materials and contacts of a world: makes manifolds from poses and rows from manifolds, and stores
// the impulses, by shape pair and feature, for warm starting.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/broadphase/fat_aabbs.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/contacts/contact.hpp"
#include "engine/contacts/slot_list.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/core/ids.hpp"
#include "engine/core/tasks.hpp"
#include "engine/faults/fault.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
class Patches;  // solvers/wide/patches.hpp

/// Parameters of a step for contact rows.
template <class S>
struct ContactStep {
    typename S::Real h;                     ///< size of the (sub-)step [s]
    typename S::Real restitutionThreshold;  ///< [m/s]
    typename S::Real restingGap;            ///< upper bound of what gravity closes in this step [m]
    typename S::Real impactSpeed;           ///< faster approaches are impacts and not warm started from [m/s]
    BiasRule<typename S::Real> bias;        ///< bias of the rows from penetration
    typename S::Real slop;                  ///< [m]
    typename S::Real gapSlop;               ///< gaps up to this count as closed [m]
    typename S::Real warmStart;             ///< factor on the last impulses; 0: none
    bool bounces = true;                    ///< false: restitution is off
    bool begins = true;                     ///< the first sub-step of a step
};

/// Distances of the contact search: WorldDef's settings of the same names.
template <class S>
struct ContactSearch {
    typename S::Real speculativeDistance = 0, cacheTolerance = 0, boxMargin = 0;
};

/// The contacts of a world.
template <class S>
using ContactList = SlotList<Contact<S>>;

template <class S>
class ContactSet {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    void setCombineRules(CombineRule<Real> friction, CombineRule<Real> restitution) {
        combineFriction_ = friction;
        combineRestitution_ = restitution;
    }
    std::uint32_t addMaterial(const PairCoefficients<S>& own);
    void setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients);
    const PairCoefficients<S>& pair(std::uint32_t a, std::uint32_t b) const {
        return pairs_[a * materialCount_ + b];
    }
    std::uint32_t materialCount() const { return materialCount_; }

    std::vector<ShapeRecord<S>>& shapes() { return shapes_; }
    const std::vector<ShapeRecord<S>>& shapes() const { return shapes_; }
    /// Bodies that a joint keeps from colliding; sorted keys of pairKey.
    std::vector<std::uint64_t>& excluded() {
        candidatesValid_ = mayCollideHolds_ = false;
        return excluded_;
    }
    static std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t(a) << 32 | b) : (std::uint64_t(b) << 32 | a);
    }
    /// Must be called after shapes or bodies were added or removed; removes all contacts if dense indices
    /// changed.
    void structureChanged(bool indicesChanged);

    /// Broad phase at the bodies' poses, and along their predicted motion if `ccd` needs it.
    void findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase, const ContactSearch<S>& search,
                   const ContinuousCollision<S>& ccd, const Tasks& tasks);
    /// Narrow phase of the pairs; contacts that persist keep the impulses of the last step.
    void findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                       ManifoldFunction<S> makeManifold, const ContinuousCollision<S>& ccd,
                       const Tasks& tasks);
    /// Narrow-phase queries of the last findManifolds.
    std::size_t queries() const { return queries_; }
    /// Appends the rows of all contacts. The bodies' velocities are those of the start of the step.
    void addRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, ConstraintRows<S>& rows,
                 const Tasks& tasks);
    /// Adds all contacts as patches, for a solver that uses patches in place of rows (contact_patches.cpp).
    void addPatches(const BodyArrays<S>& bodies, const ContactStep<S>& step, Patches<S>& patches,
                    const Tasks& tasks);
    /// Reads the impulses of the solved patches: those of the last sub-step, and the sums over all.
    void storePatches(Patches<S>& patches, const Tasks& tasks);
    /// Updates the separations after the bodies have moved by `motion` (translation [m], rotation vector
    /// [rad]), to first order: C += n . (dB + aB x rB - dA - aA x rA), exact for translation and for rolling
    /// spheres.
    void advance(std::span<const Velocity<S>> motion);
    /// After the rows are solved: points of speculative contacts that the impact has reached get their
    /// rebound as relaxed bias. Returns whether there are any.
    bool applySpeculativeRestitution(ConstraintRows<S>& rows) const;
    /// Reads the impulses of the solved rows.
    void storeImpulses(const ConstraintRows<S>& rows);

    /// Ends a step: moves bodies that have passed through a chain, mesh or height field back to the side that
    /// they came from (surface_sides.hpp).
    void keepSides(BodyArrays<S>& bodies, const Tasks& tasks);
    /// Appends an event for every contact that has begun or ended.
    void addEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events, const Tasks& tasks);

    /// Inject a fault into the results of findPairs, findManifolds and addRows.
    void injectIntoPairs(const Fault<S>& fault) {
        fault.pairs(movable_, proxyPairs_);
        pairCount_ = proxyPairs_.size();
    }
    void injectIntoManifolds(const BodyArrays<S>& bodies, const Fault<S>& fault, std::uint64_t step);
    void injectIntoRows(const BodyArrays<S>& bodies, const Fault<S>& fault, ConstraintRows<S>& rows);

    /// Pairs of boxes that overlap, and their number.
    const std::vector<ProxyPair>& proxyPairs() const;
    std::size_t pairCount() const { return pairCount_; }
    const std::vector<Aabb<S>>& boxes() const { return boxes_; }
    /// Sorted by shape pair and piece.
    const ContactList<S>& contacts() const { return contacts_; }
    ContactList<S>& contacts() { return contacts_; }
    /// True where the contact of two shapes (bodies in order) has rows in this step.
    bool hasRows(std::uint32_t shapeA, std::uint32_t shapeB) const;
    /// Archives the cached manifolds, the part of the state beside contacts() (snapshot.cpp).
    template <class A, class C>
    static void visitManifoldCache(A& archive, C& set);
    /// Completes a restored state. False: contacts and cached manifolds are inconsistent, or a shape is
    /// missing.
    bool completeRestored();
    /// True where contacts between the two bodies are possible.
    bool mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

  private:
    static bool isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact);
    /// Two shapes, or a shape and a piece of a surface, that may touch.
    struct Candidate {
        std::uint32_t a = 0, b = 0, piece = kNullIndex;  ///< as in Contact
        std::uint32_t contact = kNullIndex;              ///< its slot in contacts_, or kNullIndex
        bool ridge = false;                              ///< facesDiffer() of the pieces nearby
        std::uint32_t begun = kNullIndex;  ///< index of its new contact in begun_, or kNullIndex
        bool found = false;                ///< it has a contact in this step
        bool queried = false;              ///< the narrow phase was called in this step
        // --- the cached result of the narrow phase (contact_reuse.cpp)
        bool cached = false;
        bool onB = false;          ///< the normal is fixed to B, else to A
        bool byA = false;          ///< A is the smaller shape
        Real radius = 0;           ///< of the smaller shape [m]; 0: results are not cached
        Real separationBound = 0;  ///< without a contact: Manifold::separationLowerBound
        Pose<S> relative;          ///< the smaller shape in the frame of the other when queried
        Vec normal = Vec::Zero();  ///< in the frame of the body that it is fixed to
    };
    /// Result of a candidate in this step, in an array of its own for cache efficiency.
    struct Outcome {
        std::uint32_t contact = kNullIndex;  ///< slot of its contact in the last step
        bool found = false;
    };
    /// Counters of a batch of kBatch candidates in this step.
    struct Counters {
        std::uint32_t persisting = 0, ended = 0, begun = 0;  ///< contacts
        std::uint32_t queried = 0;                           ///< narrow-phase queries
        std::uint32_t first = 0;                             ///< index of the batch's first contact
        std::uint32_t found() const { return persisting + begun; }
        void add(bool had, bool has, bool wasQueried) {
            persisting += had && has;
            ended += had && !has;
            begun += !had && has;
            queried += wasQueried;
        }
        void add(const Counters& other) {
            persisting += other.persisting;
            ended += other.ended;
            begun += other.begun;
            queried += other.queried;
        }
    };
    static constexpr std::size_t kBatch = 32;
    // --- surface_sides.cpp
    Vec middleNow(const BodyArrays<S>& bodies, std::uint32_t shape) const;
    bool stayOnSide(const BodyArrays<S>& bodies, std::uint32_t shape, Vec& now) const;
    // --- contact_candidates.cpp
    void findCandidates(const BodyArrays<S>& bodies, const Tasks& tasks);
    void rememberPairs();
    void findPieces(std::uint32_t surface, std::uint32_t other);
    const std::vector<ProxyPair>& pairsNear() const {
        return search_.boxMargin > 0 ? fatBoxes_.pairs() : proxyPairs_;
    }
    /// Parameters of findManifolds.
    struct Search {
        const BodyArrays<S>& bodies;
        const NarrowPhase<S>& narrowPhase;
        ManifoldFunction<S> makeManifold;  ///< null: all points of the narrow phase are used
        const ContinuousCollision<S>& ccd;
    };
    /// Points of the last step's manifold, for matching with those of this step.
    struct OldPoints {
        std::size_t count;
        std::array<std::uint32_t, S::maxManifoldPoints> feature;
        std::array<Vec, S::maxManifoldPoints> pointB;
    };
    /// Updates a contact of the last step. False: it has ended.
    bool updateContact(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    /// The new contact of a candidate that had none in the last step, if there is one.
    std::optional<Contact<S>> findContact(const Search& search, Candidate& candidate) const;
    bool completeContact(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    // --- contact_reuse.cpp
    Candidate makeCandidate(std::uint32_t a, std::uint32_t b, std::uint32_t piece) const;
    Real slack(const Candidate& candidate) const;
    /// Largest separation that the narrow phase reports [m].
    Real queryDistance(const Candidate& candidate) const {
        return search_.speculativeDistance + slack(candidate);
    }
    Pose<S> relative(const Candidate& candidate) const;
    bool isCacheValid(const Candidate& candidate) const;
    void cacheResult(Candidate& candidate) const;
    void cacheManifold(Candidate& candidate, Contact<S>& contact) const;
    void moveCachedManifold(const Candidate& candidate, Contact<S>& contact) const;
    void invalidateCacheOfOtherSearch();
    void makePoints(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    void queryNarrowPhase(const Search& search, Candidate& candidate, Manifold<S>& manifold) const;
    static void placePoints(const BodyArrays<S>& bodies, Contact<S>& contact);
    static void clearStep(Contact<S>& contact);
    static void transferImpulses(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact);
    static void matchPoints(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact);
    void commitContacts(const Search& search, const Tasks& tasks);
    void changeContacts(const Search& search, std::size_t batch);
    void orderContacts(std::size_t batch);
    void removeContact(std::uint32_t slot);
    void addContact(const Search& search, Candidate& candidate);
    static void prepareRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact);
    static bool preparePoint(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact,
                             std::size_t index);
    static void makePointRows(const BodyArrays<S>& bodies, const ContactStep<S>& step,
                              const Contact<S>& contact, std::size_t index, Block<S>& block, Row<S>* rows);
    static void setPenetrationBias(const ContactStep<S>& step, const Block<S>& block, Real s, Row<S>& normal);

    std::vector<ShapeRecord<S>> shapes_;
    PairCoefficients<S> combine(const PairCoefficients<S>& a, const PairCoefficients<S>& b) const;

    CombineRule<Real> combineFriction_ = nullptr, combineRestitution_ = nullptr;
    std::uint32_t materialCount_ = 1;
    std::vector<PairCoefficients<S>> materials_ = std::vector<PairCoefficients<S>>(1);
    std::vector<PairCoefficients<S>> pairs_ = std::vector<PairCoefficients<S>>(1);
    std::vector<std::uint64_t> excluded_;

    ContactList<S> contacts_;
    SlotList<Candidate> candidates_;         ///< in the same order; each has at most one contact
    std::vector<std::uint64_t> keys_;        ///< pairKey of each candidate, in order
    std::vector<ProxyPair> candidatePairs_;  ///< pairs that candidates_ was made from; without a box margin
    std::vector<std::uint32_t> oldOrder_;    ///< order of candidates_ before findCandidates
    std::vector<std::uint64_t> oldKeys_;
    std::vector<std::uint32_t> removed_;      ///< slots of contacts whose candidate was removed
    std::vector<Outcome> outcomes_;           ///< of each candidate
    std::vector<Counters> counters_;          ///< of each batch of candidates
    std::vector<std::uint8_t> touchChanged_;  ///< of each contact: 1 where touching has begun or ended
    ContactSearch<S> search_, cachedSearch_;  ///< of this step; of the cached manifolds
    FatAabbs<S> fatBoxes_;
    std::size_t queries_ = 0;
    bool candidatesValid_ = false, candidatesHavePieces_ = false;
    bool mayCollideHolds_ = false;   ///< mayCollide() is true for the bodies of all candidates
    std::vector<Contact<S>> begun_;  ///< new contacts of this step, in any order
    std::vector<std::uint32_t> pieces_;
    std::vector<std::uint32_t> surfaces_;  ///< shapes that are chains, meshes or height fields
    std::vector<std::uint8_t> crossed_;    ///< of each shape: 1 where it has crossed a surface
    /// Keys of a contact that touched in the last step and has been removed.
    struct EndedContact {
        std::uint32_t bodyA, bodyB, shapeA, shapeB, piece;
    };
    std::vector<EndedContact> ended_;

    std::vector<Pose<S>> shapePoses_;
    std::vector<Aabb<S>> boxes_;
    std::vector<std::uint8_t> movable_;
    bool boxesValid_ = false;
    bool coefficientsValid_ = false;             ///< coefficients of contacts_ are those of their materials
    mutable std::vector<ProxyPair> proxyPairs_;  ///< with a box margin made on demand
    mutable bool proxyPairsValid_ = true;
    std::size_t pairCount_ = 0;
};

/// Unit tangents that with n form a right-handed orthonormal frame; a function of n alone.
template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n);

}  // namespace rigor::engine
