// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact of two shapes: what the narrow phase found, what the solver starts with, and what it did.
#pragma once

#include <array>
#include <cstdint>

#include "engine/contacts/shape_record.hpp"
#include "engine/contacts/slot_list.hpp"
#include "engine/core/ids.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/state/island_kind.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Contact of two shapes that touch or nearly do. A is the body of lower index. A large world reads all
/// contacts three times per step, from memory: the fields that a contact with a cached manifold, solved as a
/// patch, needs come first, in whole cache lines.
template <class S>
struct alignas(64) Contact {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    template <class T>
    using PerPoint = std::array<T, S::maxManifoldPoints>;
    static constexpr std::uint32_t kPatch = 0xfffffffeu;
    struct Impulse {
        Real normal = 0;             ///< [N s], >= 0
        Vec friction = Vec::Zero();  ///< impulse on B, world frame [N s]
    };
    /// Input of the rows of one point.
    struct Point {
        Vec rA = Vec::Zero(), rB = Vec::Zero();  ///< arms of the impulses when found: world axes, from the
                                                 ///< centres of mass [m]
        Real separation = 0;  ///< signed distance now: as found, updated by the bodies' motion since [m]
        Real rebound = 0;     ///< bias of the normal row after a speculative impact, < 0 [m/s]
        Real approach = 0;    ///< normal velocity when its rows were made; < 0: closing [m/s]
        bool impact = false;  ///< an impact, not a resting contact, in this step
    };
    std::uint32_t bodyA = 0, bodyB = 0;  ///< dense indices
    bool asleep = false;                 ///< true if neither body takes impulses: the point is not updated
                                         ///< and has no rows
    bool speculative = false;  ///< found on the bodies' way by continuous collision: has rows at any distance
    bool touching = false;     ///< overlapped when found, or had an impulse in the step since
    bool touched = false;      ///< value of `touching` at the end of the step before
    bool vetoed = false;       ///< refused by the callback in its last call (pre_solve.hpp)
    bool placed = false;       ///< the points' arms and separations are those of the manifold
    bool impacts = false;      ///< some point has `impact`
    bool parted = false;       ///< has acted in this step, and is open since the second search
    bool driven = false;       ///< a surface has a velocity over its body: surfaceA, surfaceB
    IslandKind islands = IslandKind::Usual;  ///< the method that solves its island
    PairCoefficients<S> coefficients;
    /// Row block of each point in this step; kPatch: solved as a patch, without rows; kNullIndex: not solved.
    PerPoint<std::uint32_t> block = [] {
        PerPoint<std::uint32_t> none;
        none.fill(kNullIndex);
        return none;
    }();
    Manifold<S> manifold;
    ManifoldCache<S> cache;  ///< data of the manifold choice, or the points of a cached manifold
    alignas(S::dim == 3 ? 64
                        : alignof(PerPoint<Impulse>)) PerPoint<Impulse> impulses;  ///< impulses of the last
                                                                                   ///< (sub-)step
    PerPoint<Impulse> totals;              ///< sums over the last step
    std::uint32_t shapeA = 0, shapeB = 0;  ///< dense indices
    std::uint32_t piece = 0xffffffffu;  ///< segment or triangle of the chain, mesh or field; none of others
    std::uint32_t firstRow = 0, blocks = 0;  ///< place in the rows of this step while rows are made
    PerPoint<Point> points;
    /// If driven: the velocities of the two surfaces over their bodies, at the centres of mass, world axes.
    Velocity<S> surfaceA, surfaceB;
    /// Angular impulses of rolling and torsional friction on B, of all points [N m s], world axes: of the last
    /// (sub-)step, and its sum over the last step.
    typename S::Ang moment = zeroAng<S>(), momentTotal = zeroAng<S>();
    /// Normal of the rows of the last step if it led from midpoint to midpoint (row_lag.hpp), else 0.
    Vec lastNormal = Vec::Zero();
    /// Time from the step's rows until its shapes touch and bounce (step_bounces.cpp) [s]; 0: not within the step.
    Real bounceTime = 0;
};

/// Point at which the impulse of a contact point acts: the same for both bodies, otherwise opposite impulses
/// would make a couple. Against a body that takes no momentum it lies on the other body's surface, so that
/// its arm does not depend on the penetration.
template <class S>
typename S::Vec impulsePoint(const ManifoldPoint<S>& where, bool movesA, bool movesB) {
    if (!movesB) return where.pointA;
    if (!movesA) return where.pointB;
    return typename S::Real(0.5) * (where.pointA + where.pointB);
}

/// The contacts of a world, sorted by shape pair and piece.
template <class S>
using ContactList = SlotList<Contact<S>>;

/// The same for (a, b) and (b, a); sorts as the pair (lower, higher) does.
constexpr std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
    return a < b ? (std::uint64_t(a) << 32 | b) : (std::uint64_t(b) << 32 | a);
}

/// True when neither body takes impulses and neither moves: sleeping, static or resting kinematic bodies.
template <class S>
bool isAsleep(const BodyArrays<S>& bodies, const Contact<S>& contact) {
    if (bodies.invMass[contact.bodyA] > 0 || bodies.invMass[contact.bodyB] > 0) return false;
    const auto still = [&](std::uint32_t i) {
        return bodies.asleep[i] || bodies.constants[i].type == BodyType::Static ||
               (bodies.constants[i].type == BodyType::Kinematic && bodies.velocity[i].v.isZero(0) &&
                dotAng(bodies.velocity[i].w, bodies.velocity[i].w) == typename S::Real(0));
    };
    return still(contact.bodyA) && still(contact.bodyB);
}

/// The velocity of a shape's surface over its body, at the centre of mass, in world axes.
template <class S>
Velocity<S> surfaceNow(const BodyArrays<S>& bodies, const ShapeRecord<S>& shape) {
    const typename S::Rot& q = bodies.pose[shape.body].q;
    return {rotate(q, shape.surface.v), rotateAng(q, shape.surface.w)};
}

/// Sets the points' arms and separations to those of the manifold.
template <class S>
void placePoints(const BodyArrays<S>& bodies, Contact<S>& contact);
/// True where a contact of two shapes (bodies in order) is in the list and has rows in this step.
template <class S>
bool hasRows(const ContactList<S>& contacts, std::uint32_t shapeA, std::uint32_t shapeB);

}  // namespace rigor::engine
