// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes, materials and contacts of a world: from poses to manifolds, from manifolds to rows, and the
// impulses back, kept by shape pair and feature for warm starting.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/broadphase/enlarged_boxes.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/core/ids.hpp"
#include "engine/core/tasks.hpp"
#include "engine/faults/fault.hpp"
#include "engine/pipeline/contact.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/pipeline/slot_list.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
class Patches;  // solvers/wide/patches.hpp

/// What making contact rows needs to know of a step.
template <class S>
struct ContactStep {
    typename S::Real h;                     ///< of the (sub-)step [s]
    typename S::Real restitutionThreshold;  ///< [m/s]
    typename S::Real restingGap;            ///< what gravity may close in this step, generously [m]
    typename S::Real impactSpeed;           ///< faster approaches are impacts: not warm started from [m/s]
    BiasRule<typename S::Real> bias;        ///< what overlap does to the rows
    typename S::Real slop;                  ///< [m]
    typename S::Real gapSlop;               ///< gaps up to this count as closed [m]
    typename S::Real warmStart;             ///< factor on the last impulses; 0: none
    bool bounces = true;                    ///< false: restitution is off
    bool begins = true;                     ///< the first sub-step of a step
};

/// How contacts are looked for: WorldDef's settings of the same names.
template <class S>
struct ContactSearch {
    typename S::Real speculativeDistance = 0, reuseDistance = 0, boxMargin = 0;
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
        candidatesValid_ = mayHolds_ = false;
        return excluded_;
    }
    static std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t(a) << 32 | b) : (std::uint64_t(b) << 32 | a);
    }
    /// After shapes or bodies were added or removed: contacts are forgotten where dense indices changed.
    void structureChanged(bool indicesChanged);

    /// Broad phase at the bodies' poses, and on their way ahead if `ccd` wants that.
    void findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase, const ContactSearch<S>& search,
                   const ContinuousCollision<S>& ccd, const Tasks& tasks);
    /// Narrow phase of the pairs; takes over the impulses of contacts that were there in the last step.
    void findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                       ManifoldFunction<S> makeManifold, const ContinuousCollision<S>& ccd,
                       const Tasks& tasks);
    /// Pairs, or pieces, that the last findManifolds has asked the narrow phase about.
    std::size_t asked() const { return asked_; }
    /// Appends the rows of all contacts. The bodies' velocities are those of the start of the step.
    void addRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, ConstraintRows<S>& rows,
                 const Tasks& tasks);
    /// All contacts as patches, for a solver that wants those in place of rows (contact_patches.cpp).
    void addPatches(const BodyArrays<S>& bodies, const ContactStep<S>& step, Patches<S>& patches,
                    const Tasks& tasks);
    /// Reads the impulses of the solved patches, of the last sub-step and of all of them.
    void storePatches(Patches<S>& patches, const Tasks& tasks);
    /// Separations after the bodies have moved by `motion` (translation [m], rotation vector [rad]), to first
    /// order: C += n . (dB + aB x rB - dA - aA x rA), exact for translation and for rolling spheres.
    void advance(std::span<const Velocity<S>> motion);
    /// After the rows are solved: the points that an impact ahead has reached get their rebound as relaxed
    /// bias. True: there are some.
    bool bounceAhead(ConstraintRows<S>& rows) const;
    /// Reads the impulses of the solved rows.
    void storeImpulses(const ConstraintRows<S>& rows);

    /// Ends a step: bodies that have passed a chain, mesh or height field since it began go back to the side
    /// that they came from (surface_sides.hpp).
    void keepSides(BodyArrays<S>& bodies, const Tasks& tasks);
    /// Appends what began and what ended.
    void noteEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events, const Tasks& tasks);

    /// Lets a fault at what findManifolds and addRows have made.
    void spoilPairs(const Fault<S>& fault) {
        fault.pairs(movable_, proxyPairs_);
        pairCount_ = proxyPairs_.size();
    }
    void spoilManifolds(const BodyArrays<S>& bodies, const Fault<S>& fault, std::uint64_t step);
    void spoilRows(const BodyArrays<S>& bodies, const Fault<S>& fault, ConstraintRows<S>& rows);

    /// Pairs of boxes that overlap, and their number.
    const std::vector<ProxyPair>& proxyPairs() const;
    std::size_t pairCount() const { return pairCount_; }
    const std::vector<Aabb<S>>& boxes() const { return boxes_; }
    /// Sorted by shape pair and piece.
    const ContactList<S>& contacts() const { return contacts_; }
    ContactList<S>& contacts() { return contacts_; }
    /// True where the contact of two shapes (bodies in order) has rows in this step.
    bool hasRows(std::uint32_t shapeA, std::uint32_t shapeB) const;
    /// What belongs to a state beside contacts(): which answers of the narrow phase are kept (snapshot.cpp).
    template <class A, class C>
    static void visitAnswers(A& archive, C& set);
    /// After both were restored. False: they do not belong together, or to shapes that are there.
    bool completeRestored();
    /// True where contacts between the two bodies are possible.
    bool mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

  private:
    static bool isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact);
    /// Two shapes, or one and a piece of the other, that may touch.
    struct Candidate {
        std::uint32_t a = 0, b = 0, piece = kNullIndex;  ///< as in Contact
        std::uint32_t contact = kNullIndex;              ///< its slot in contacts_, or kNullIndex
        bool ridge = false;                              ///< facesDiffer() of the pieces near
        std::uint32_t fresh =
            kNullIndex;      ///< the place of a new one in fresh_, or kNullIndex; while they are found
        bool found = false;  ///< they touch or nearly do in this step
        bool asked = false;  ///< the narrow phase was, in this step
        // --- what the narrow phase has answered, while that is kept (contact_reuse.cpp)
        bool kept = false;
        bool onB = false;          ///< the normal turns with B, else with A
        bool byA = false;          ///< A is the smaller of the two
        Real radius = 0;           ///< of the smaller [m]; 0: answers are not kept
        Real apart = 0;            ///< where nothing was found: Manifold::apart
        Pose<S> relative;          ///< the smaller in the frame of the other, then
        Vec normal = Vec::Zero();  ///< in the frame that it turns with
    };
    /// Of a candidate in this step: what is read of all of them, side by side.
    struct Outcome {
        std::uint32_t contact = kNullIndex;  ///< the slot of the one that it had before
        bool found = false;
    };
    /// Of kTally candidates in this step: contacts that they had and have, had, or have, and who was asked.
    struct Tally {
        std::uint32_t kept = 0, lost = 0, fresh = 0, asked = 0;
        std::uint32_t first = 0;  ///< place of the first contact
        std::uint32_t found() const { return kept + fresh; }
        void add(bool had, bool has, bool was) {
            kept += had && has;
            lost += had && !has;
            fresh += !had && has;
            asked += was;
        }
        void add(const Tally& other) {
            kept += other.kept;
            lost += other.lost;
            fresh += other.fresh;
            asked += other.asked;
        }
    };
    static constexpr std::size_t kTally = 32;
    // --- surface_sides.cpp
    Vec middleNow(const BodyArrays<S>& bodies, std::uint32_t shape) const;
    bool stayOnSide(const BodyArrays<S>& bodies, std::uint32_t shape, Vec& now) const;
    // --- contact_candidates.cpp
    void findCandidates(const BodyArrays<S>& bodies, const Tasks& tasks);
    void rememberPairs();
    void findPieces(std::uint32_t surface, std::uint32_t other);
    const std::vector<ProxyPair>& pairsNear() const {
        return search_.boxMargin > 0 ? enlarged_.pairs() : proxyPairs_;
    }
    /// What finding the manifolds of a step needs to know.
    struct Search {
        const BodyArrays<S>& bodies;
        const NarrowPhase<S>& narrowPhase;
        ManifoldFunction<S> makeManifold;  ///< null: the points are left as they are
        const ContinuousCollision<S>& ccd;
    };
    /// The part of a contact that is looked for in that of the next step.
    struct OldPoints {
        std::size_t count;
        std::array<std::uint32_t, S::maxManifoldPoints> feature;
        std::array<Vec, S::maxManifoldPoints> pointB;
    };
    /// A contact that was there in the last step as it is now. False: there is none any more.
    bool renewContact(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    /// The contact of a candidate that had none, if it has one now.
    std::optional<Contact<S>> findContact(const Search& search, Candidate& candidate) const;
    bool completeContact(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    // --- contact_reuse.cpp
    Candidate makeCandidate(std::uint32_t a, std::uint32_t b, std::uint32_t piece) const;
    Real slack(const Candidate& candidate) const;
    /// How far apart shapes may be for the narrow phase to report them [m].
    Real askedDistance(const Candidate& candidate) const {
        return search_.speculativeDistance + slack(candidate);
    }
    Pose<S> relative(const Candidate& candidate) const;
    bool stillValid(const Candidate& candidate) const;
    void keep(Candidate& candidate) const;
    void keepPoints(Candidate& candidate, Contact<S>& contact) const;
    void carry(const Candidate& candidate, Contact<S>& contact) const;
    void forgetOtherAnswers();
    void makePoints(const Search& search, Candidate& candidate, Contact<S>& contact) const;
    void ask(const Search& search, Candidate& candidate, Manifold<S>& manifold) const;
    static void placePoints(const BodyArrays<S>& bodies, Contact<S>& contact);
    static void clearStep(Contact<S>& contact);
    static void takeOver(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact);
    static void matchPoints(const BodyArrays<S>& bodies, const OldPoints& old, Contact<S>& contact);
    void settle(const Search& search, const Tasks& tasks);
    void changeContacts(const Search& search, std::size_t part);
    void orderContacts(std::size_t part);
    void removeContact(std::uint32_t slot);
    void addContact(const Search& search, Candidate& candidate);
    static void planRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact);
    static bool planPoint(const BodyArrays<S>& bodies, const ContactStep<S>& step, Contact<S>& contact,
                          std::size_t index);
    static void makePointRows(const BodyArrays<S>& bodies, const ContactStep<S>& step,
                              const Contact<S>& contact, std::size_t index, Block<S>& block, Row<S>* rows);
    static void pushApart(const ContactStep<S>& step, const Block<S>& block, Real s, Row<S>& normal);

    std::vector<ShapeRecord<S>> shapes_;
    PairCoefficients<S> combine(const PairCoefficients<S>& a, const PairCoefficients<S>& b) const;

    CombineRule<Real> combineFriction_ = nullptr, combineRestitution_ = nullptr;
    std::uint32_t materialCount_ = 1;
    std::vector<PairCoefficients<S>> materials_ = std::vector<PairCoefficients<S>>(1);
    std::vector<PairCoefficients<S>> pairs_ = std::vector<PairCoefficients<S>>(1);
    std::vector<std::uint64_t> excluded_;

    ContactList<S> contacts_;
    SlotList<Candidate> candidates_;         ///< in the same order; a contact belongs to each that found one
    std::vector<std::uint64_t> keys_;        ///< of candidates_, in their order: pairKey of their shapes
    std::vector<ProxyPair> candidatePairs_;  ///< what they were made of, where boxes are not enlarged
    std::vector<std::uint32_t> oldOrder_;    ///< of candidates_, while they are made anew
    std::vector<std::uint64_t> oldKeys_;
    std::vector<std::uint32_t> dropped_;  ///< slots of contacts whose pair is near no more
    std::vector<Outcome> outcomes_;       ///< of candidates_
    std::vector<Tally> tallies_;          ///< of parts of them
    std::vector<std::uint8_t> turned_;    ///< of contacts_: 1 where touching has begun or ended
    ContactSearch<S> search_, keptFor_;   ///< of this step; of the answers that are kept
    EnlargedBoxes<S> enlarged_;
    std::size_t asked_ = 0;
    bool candidatesValid_ = false, candidatesHavePieces_ = false;
    bool mayHolds_ = false;          ///< candidates that there are may collide
    std::vector<Contact<S>> fresh_;  ///< new in this step, in any order
    std::vector<std::uint32_t> pieces_;
    std::vector<std::uint32_t> surfaces_;  ///< shapes that are chains, meshes or height fields
    std::vector<std::uint8_t> crossed_;    ///< of the shapes: 1 where a surface was in the way
    /// Of a contact that touched in the last step and is no more.
    struct Gone {
        std::uint32_t bodyA, bodyB, shapeA, shapeB, piece;
    };
    std::vector<Gone> gone_;

    std::vector<Pose<S>> shapePoses_;
    std::vector<Aabb<S>> boxes_;
    std::vector<std::uint8_t> movable_;
    bool boxesValid_ = false;
    bool coefficientsHold_ = false;              ///< those of contacts_ are those of their materials
    mutable std::vector<ProxyPair> proxyPairs_;  ///< made when asked for, where boxes are enlarged
    mutable bool proxyPairsHold_ = true;
    std::size_t pairCount_ = 0;
};

/// Unit tangents that with n form a right-handed orthonormal frame; a function of n alone.
template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n);

}  // namespace rigor::engine
