// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Records of a world: a shape, and the contact of two shapes.
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/ids.hpp"
#include "engine/core/prefetch.hpp"
#include "engine/narrowphase/manifolds.hpp"
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
    /// Bounding radius of the core about the centre of mass, and inscribed radius (ccd/moving_shape.hpp) [m].
    typename S::Real boundingRadius = 0, inscribedRadius = 0;
    typename S::Real radius = 0;              ///< bounding radius about the shape's own origin [m]
    typename S::Vec middle = S::Vec::Zero();  ///< a point well inside, in the frame of the shape [m]
};

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
        Vec friction = Vec::Zero();  ///< on B, world frame [N s]
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
    bool asleep = false;                 ///< neither body takes impulses: it is not updated and has no rows
    bool speculative = false;  ///< found on the bodies' way by continuous collision: has rows at any distance
    bool touching = false;     ///< overlapped when found, or had an impulse in the step since
    bool touched = false;      ///< value of `touching` at the end of the step before
    bool placed = false;       ///< the points' arms and separations are those of the manifold
    bool impacts = false;      ///< some point has `impact`
    PairCoefficients<S> coefficients;
    /// Row block of each point in this step; kPatch: solved as a patch, without rows; kNullIndex: not solved.
    PerPoint<std::uint32_t> block = [] {
        PerPoint<std::uint32_t> none;
        none.fill(kNullIndex);
        return none;
    }();
    Manifold<S> manifold;
    ManifoldCache<S> cache;  ///< of the manifold choice, or the points of a cached manifold
    alignas(S::dim == 3 ? 64 : alignof(Real)) PerPoint<Impulse> impulses;  ///< of the last (sub-)step
    PerPoint<Impulse> totals;                                              ///< of all of the last step
    std::uint32_t shapeA = 0, shapeB = 0;                                  ///< dense indices
    std::uint32_t piece = 0xffffffffu;  ///< segment or triangle of the chain, mesh or field; none of others
    std::uint32_t firstRow = 0, blocks = 0;  ///< of this step, while rows are made
    PerPoint<Point> points;
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

}  // namespace rigor::engine
