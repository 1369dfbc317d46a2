// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes, materials and contacts of a world: from poses to manifolds, from manifolds to rows, and the
// impulses back, kept by shape pair and feature for warm starting.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/ccd/continuous_collision.hpp"
#include "engine/constraints/row.hpp"
#include "engine/constraints/soft.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/core/tasks.hpp"
#include "engine/faults/fault.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// A shape of a body; the dense index is its broad-phase proxy.
template <class S>
struct ShapeRecord {
    Shape<S> shape;
    Pose<S> local;           ///< in the frame at the body's centre of mass
    std::uint32_t body = 0;  ///< dense index
    std::uint32_t material = 0;
    ShapeId id;
    typename S::Real reach = 0, inner = 0;  ///< coreReach, innerRadius (ccd/moving_shape.hpp) [m]
};

/// Two shapes that touch or nearly do. A is the body of lower index.
template <class S>
struct Contact {
    using Real = typename S::Real;
    static constexpr std::uint32_t kNoBlock = 0xffffffffu;
    struct Point {
        Real normalImpulse = 0;                            ///< of the last (sub-)step [N s], >= 0
        typename S::Vec frictionImpulse = S::Vec::Zero();  ///< on B, world frame [N s]
        Real normalTotal = 0;                              ///< of all sub-steps of the last step [N s]
        typename S::Vec frictionTotal = S::Vec::Zero();
        Real separation = 0;     ///< now: found, and what the bodies' motion since has made of it [m]
        typename S::Vec rA, rB;  ///< arms of the impulses, as found: world axes, from the centres of mass
        std::uint32_t block = kNoBlock;  ///< its rows in this step; kNoBlock: let through
        bool impact = false;             ///< hit, rather than rested, in this step
        Real rebound = 0;   ///< bias of the normal row once an impact ahead has taken place, < 0 [m/s]
        Real approach = 0;  ///< normal speed when its rows were planned; < 0: closing [m/s]
    };
    std::uint32_t shapeA = 0, shapeB = 0, bodyA = 0, bodyB = 0;  ///< dense indices
    std::uint32_t piece = 0xffffffffu;  ///< segment or triangle of the chain, mesh or field; none of others
    PairCoefficients<S> coefficients;
    bool asleep = false;  ///< neither body takes impulses: it stays as it was, without rows
    bool ahead = false;   ///< fast for their sizes: must not be let through, however far apart they are
    Manifold<S> manifold;
    ManifoldCache<S> cache;  ///< of the manifold choice
    std::array<Point, S::maxManifoldPoints> points;
    bool touching = false;  ///< at the end of the step: overlapped when found, or pushed in the step
    std::uint32_t firstRow = 0, blocks = 0;  ///< of this step, while rows are made
};

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
};

template <class S>
class ContactSet {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    void setCombineRules(CombineRule<Real> friction, CombineRule<Real> restitution) {
        combineFriction_ = friction, combineRestitution_ = restitution;
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
    std::vector<std::uint64_t>& excluded() { return excluded_; }
    static std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t(a) << 32 | b) : (std::uint64_t(b) << 32 | a);
    }
    /// After shapes or bodies were added or removed: contacts are forgotten where dense indices changed.
    void structureChanged(bool indicesChanged);

    /// Broad phase at the bodies' poses, and on their way ahead if `ccd` wants that.
    void findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase, Real speculativeDistance,
                   const ContinuousCollision<S>& ccd, const Tasks& tasks);
    /// Narrow phase of the pairs; takes over the impulses of contacts that were there in the last step.
    void findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                       ManifoldFunction<S> makeManifold, Real speculativeDistance,
                       const ContinuousCollision<S>& ccd, const Tasks& tasks);
    /// Appends the rows of all contacts. The bodies' velocities are those of the start of the step.
    void addRows(const BodyArrays<S>& bodies, const ContactStep<S>& step, ConstraintRows<S>& rows,
                 const Tasks& tasks);
    /// Separations after the bodies have moved by `motion` (translation [m], rotation vector [rad]), to first
    /// order: C += n . (dB + aB x rB - dA - aA x rA), exact for translation and for rolling spheres.
    void advance(std::span<const Velocity<S>> motion);
    /// After the rows are solved: the points that an impact ahead has reached get their rebound as relaxed
    /// bias. True: there are some.
    bool bounceAhead(ConstraintRows<S>& rows) const;
    /// Reads the impulses of the solved rows.
    void storeImpulses(const ConstraintRows<S>& rows);

    /// Ends a step: appends what began and what ended.
    void noteEvents(const BodyArrays<S>& bodies, std::vector<Event<S>>& events);

    /// Lets a fault at what findManifolds and addRows have made.
    void spoilPairs(const Fault<S>& fault) { fault.pairs(movable_, proxyPairs_); }
    void spoilManifolds(const BodyArrays<S>& bodies, const Fault<S>& fault, std::uint64_t step);
    void spoilRows(const BodyArrays<S>& bodies, const Fault<S>& fault, ConstraintRows<S>& rows);

    const std::vector<ProxyPair>& proxyPairs() const { return proxyPairs_; }
    const std::vector<Aabb<S>>& boxes() const { return boxes_; }
    const std::vector<Contact<S>>& contacts() const { return contacts_; }
    std::vector<Contact<S>>& contacts() { return contacts_; }
    /// True where the contact of two shapes (bodies in order) has rows in this step.
    bool hasRows(std::uint32_t shapeA, std::uint32_t shapeB) const;
    /// True where contacts between the two bodies are possible.
    bool mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

  private:
    static bool isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact);
    /// Two shapes, or one and a piece of the other, that may touch.
    struct Candidate {
        std::uint32_t a, b, piece;  ///< as in Contact
        std::uint32_t old;          ///< their contact of the last step in previous_, or kNone
    };
    void findCandidates(const BodyArrays<S>& bodies, Real speculativeDistance);
    void findPieces(std::uint32_t surface, std::uint32_t other, Real speculativeDistance);
    /// What finding the manifolds of a step needs to know.
    struct Search {
        const BodyArrays<S>& bodies;
        const NarrowPhase<S>& narrowPhase;
        ManifoldFunction<S> makeManifold;
        Real speculativeDistance;
        const ContinuousCollision<S>& ccd;
    };
    void findContact(const Search& search, const Candidate& candidate, Contact<S>& contact) const;
    void collide(const Search& search, const Candidate& candidate, Manifold<S>& manifold) const;
    void placePoints(const BodyArrays<S>& bodies, Contact<S>& contact) const;
    void takeOver(const BodyArrays<S>& bodies, const Contact<S>& old, Contact<S>& contact) const;
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

    std::vector<Contact<S>> contacts_, previous_;  ///< sorted by shape pair and piece
    std::vector<Candidate> candidates_;            ///< in the same order
    std::vector<std::uint32_t> pieces_;

    std::vector<Pose<S>> shapePoses_;
    std::vector<Aabb<S>> boxes_;
    std::vector<std::uint8_t> movable_;
    bool boxesValid_ = false;
    std::vector<ProxyPair> proxyPairs_;
};

/// Unit tangents that with n form a right-handed orthonormal frame; a function of n alone.
template <class S>
std::array<typename S::Vec, S::tangents> tangentBasis(const typename S::Vec& n);

}  // namespace rigor::engine
