// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a world keeps of a shape, and of two shapes that touch or nearly do.
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/ids.hpp"
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
    typename S::Real reach = 0, inner = 0;  ///< coreReach, innerRadius (ccd/moving_shape.hpp) [m]
    typename S::Real radius = 0;            ///< no point is further from its own origin [m]
};

/// Two shapes that touch or nearly do. A is the body of lower index. What a step reads of every contact comes
/// first, what only some do last.
template <class S>
struct Contact {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    static constexpr std::uint32_t kNoBlock = 0xffffffffu;
    struct Point {
        Vec rA = Vec::Zero(), rB = Vec::Zero();  ///< arms of the impulses, as found: world axes, from the
                                                 ///< centres of mass [m]
        Real separation = 0;     ///< now: found, and what the bodies' motion since has made of it [m]
        Real normalImpulse = 0;  ///< of the last (sub-)step [N s], >= 0
        Vec frictionImpulse = Vec::Zero();  ///< on B, world frame [N s]
        Real normalTotal = 0;               ///< of all sub-steps of the last step [N s]
        Vec frictionTotal = Vec::Zero();
        std::uint32_t block = kNoBlock;  ///< its rows in this step; kNoBlock: let through
        bool impact = false;             ///< hit, rather than rested, in this step
        Real rebound = 0;   ///< bias of the normal row once an impact ahead has taken place, < 0 [m/s]
        Real approach = 0;  ///< normal speed when its rows were planned; < 0: closing [m/s]
    };
    std::uint32_t bodyA = 0, bodyB = 0, shapeA = 0, shapeB = 0;  ///< dense indices
    std::uint32_t piece = 0xffffffffu;  ///< segment or triangle of the chain, mesh or field; none of others
    bool asleep = false;                ///< neither body takes impulses: it stays as it was, without rows
    bool ahead = false;     ///< fast for their sizes: must not be let through, however far apart they are
    bool touching = false;  ///< overlapped when found, or pushed in the step since
    bool touched = false;   ///< at the end of the step before
    PairCoefficients<S> coefficients;
    std::array<Point, S::maxManifoldPoints> points;
    Manifold<S> manifold;
    std::uint32_t firstRow = 0, blocks = 0;  ///< of this step, while rows are made
    ManifoldCache<S> cache;  ///< of the manifold choice, or the points of an answer that is kept
};

}  // namespace rigor::engine
