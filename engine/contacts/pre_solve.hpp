// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A program's own say in a contact before a step solves it: it may refuse the contact for this step (a platform
// that is solid from above only), change its coefficients (ice where it rains), or let a surface move over its body
// (a conveyor that starts and stops).
//
// The callback is called by the thread that steps the world, once per step for each contact of two shapes that
// touch or nearly do, in the order of World::manifolds(), when all contacts have been found and before any body has
// moved. Contacts with a chain, mesh or height field are one for each piece. It is not called for contacts of
// bodies that all sleep or stand still; they keep what they had. Continuous collision calls it for the impacts that it
// finds by itself, in the order of their times.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "engine/contacts/shape_record.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/state/body_arrays.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
struct PreSolveContact {
    BodyId bodyA, bodyB;  ///< A is the body of lower dense index
    ShapeId shapeA, shapeB;
    std::uint32_t piece = kNullIndex;          ///< segment or triangle of a surface; of an impact: none
    typename S::Vec normal = S::Vec::Zero();   ///< unit, A to B, world frame
    std::span<const ManifoldPoint<S>> points;  ///< world frame, with their separations [m]; < 0: overlap
    typename S::Vec velocity =
        S::Vec::Zero();  ///< velocity of B relative to A in the middle of the points [m/s]

    // --- what the callback may change, for this step
    PairCoefficients<S> coefficients;  ///< at first the coefficients of the two materials
    /// Added to the velocity of B's surface over A's at all points of the contact [m/s], world frame; the part along
    /// the normal has no effect. Velocities of the shapes' own surfaces (ShapeDef::surfaceVelocity) stay.
    typename S::Vec surfaceVelocity = S::Vec::Zero();
    bool veto = false;  ///< true: the two do not touch
};

template <class S>
using PreSolve = std::function<void(PreSolveContact<S>&)>;

/// The law of a contact that a callback did not refuse.
template <class S>
struct PreSolveAnswer {
    PairCoefficients<S> coefficients;
    typename S::Vec surfaceVelocity = S::Vec::Zero();  ///< as PreSolveContact::surfaceVelocity
};

/// The callback of a world; false: none is set.
template <class S>
class PreSolveCall {
  public:
    PreSolveCall() = default;
    explicit PreSolveCall(PreSolve<S> callback) : callback_(std::move(callback)) {}

    explicit operator bool() const { return callback_ != nullptr; }
    /// Calls the callback for the contact of two shapes whose bodies' centres of mass are at pA and pB. Nothing: a veto.
    /// Throws EngineError "pre_solve" where its coefficients or velocity are out of range.
    std::optional<PreSolveAnswer<S>> operator()(const BodyArrays<S>& bodies, const ShapeRecord<S>& a,
                                                const ShapeRecord<S>& b, std::uint32_t piece,
                                                const Manifold<S>& manifold, const typename S::Vec& pA,
                                                const typename S::Vec& pB,
                                                const PairCoefficients<S>& coefficients) const;

  private:
    PreSolve<S> callback_;
};

}  // namespace rigor::engine
