// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a world keeps of a shape, and of two shapes that touch or nearly do.
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
    typename S::Real reach = 0, inner = 0;    ///< coreReach, innerRadius (ccd/moving_shape.hpp) [m]
    typename S::Real radius = 0;              ///< no point is further from its own origin [m]
    typename S::Vec middle = S::Vec::Zero();  ///< a point well inside, in the frame of the shape [m]
};

/// Two shapes that touch or nearly do. A is the body of lower index. Large worlds read all of them three
/// times in a step, from memory: what a kept contact that is solved as a patch needs comes first, in whole
/// cache lines, and the rest is left alone.
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
    /// What rows are made of.
    struct Point {
        Vec rA = Vec::Zero(), rB = Vec::Zero();  ///< arms of the impulses, as found: world axes, from the
                                                 ///< centres of mass [m]
        Real separation = 0;  ///< now: found, and what the bodies' motion since has made of it [m]
        Real rebound = 0;     ///< bias of the normal row once an impact ahead has taken place, < 0 [m/s]
        Real approach = 0;    ///< normal speed when its rows were planned; < 0: closing [m/s]
        bool impact = false;  ///< hit, rather than rested, in this step
    };
    std::uint32_t bodyA = 0, bodyB = 0;  ///< dense indices
    bool asleep = false;                 ///< neither body takes impulses: it stays as it was, without rows
    bool ahead = false;     ///< fast for their sizes: must not be let through, however far apart they are
    bool touching = false;  ///< overlapped when found, or pushed in the step since
    bool touched = false;   ///< at the end of the step before
    bool placed = false;    ///< the points' arms and separations are those of the manifold
    bool impacts = false;   ///< some of the points' are
    PairCoefficients<S> coefficients;
    /// The rows of each point in this step; kPatch: it is solved, but not by rows; kNullIndex: let through.
    PerPoint<std::uint32_t> block = [] {
        PerPoint<std::uint32_t> none;
        none.fill(kNullIndex);
        return none;
    }();
    Manifold<S> manifold;
    ManifoldCache<S> cache;  ///< of the manifold choice, or the points of an answer that is kept
    alignas(S::dim == 3 ? 64 : alignof(Real)) PerPoint<Impulse> impulses;  ///< of the last (sub-)step
    PerPoint<Impulse> totals;                                              ///< of all of the last step
    std::uint32_t shapeA = 0, shapeB = 0;                                  ///< dense indices
    std::uint32_t piece = 0xffffffffu;  ///< segment or triangle of the chain, mesh or field; none of others
    std::uint32_t firstRow = 0, blocks = 0;  ///< of this step, while rows are made
    PerPoint<Point> points;
};

/// Where the impulse of a point acts.
/// One point for both bodies, or equal and opposite impulses would make a couple; against a body that takes
/// no momentum the other's own surface, so that its arm does not depend on the overlap.
template <class S>
typename S::Vec impulsePoint(const ManifoldPoint<S>& where, bool movesA, bool movesB) {
    if (!movesB) return where.pointA;
    if (!movesA) return where.pointB;
    return typename S::Real(0.5) * (where.pointA + where.pointB);
}

}  // namespace rigor::engine
