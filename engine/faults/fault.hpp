// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fault injection: typical mistakes of a first engine, switched on by name, so that a symptom can be compared
// with the correct result. A fault changes the data between two phases of a step; it has no state. `none` is
// no fault and costs a null pointer test per phase.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/constraints/row.hpp"
#include "engine/core/table.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// The rows of one contact point, made and not yet solved.
template <class S>
struct ContactRows {
    Block<S>& block;
    std::span<Row<S>> rows;            ///< [0] the normal, then friction
    typename S::Real restitution = 0;  ///< coefficient of the pair of surfaces
    typename S::Real approach = 0;    ///< n . (relative velocity) with this step's forces [m/s], < 0: closing
    typename S::Real separation = 0;  ///< [m], < 0: overlap
};

template <class S>
class Fault {
  public:
    using Real = typename S::Real;
    virtual ~Fault() = default;

    /// Called after the broad phase: `movable` by proxy, `pairs` for the narrow phase, sorted.
    virtual void pairs(std::span<const std::uint8_t> /*movable*/, std::vector<ProxyPair>& /*pairs*/) const {}
    /// Called after the narrow phase for every manifold. `step` counts from 0.
    virtual void manifold(const Shape<S>& /*a*/, const Pose<S>& /*Xa*/, const Shape<S>& /*b*/,
                          const Pose<S>& /*Xb*/, std::uint64_t /*step*/, Manifold<S>& /*manifold*/) const {}
    /// Called after forces have acted on the velocities and before impulses do, for every contact point with
    /// rows.
    virtual void contact(ContactRows<S>& /*rows*/) const {}
    /// Called after the velocity solver.
    virtual void solved(BodyArrays<S>& /*bodies*/, const ConstraintRows<S>& /*rows*/) const {}
    /// Called after bodies have moved over h [s]; `start` are the orientations before, by dense index.
    virtual void moved(BodyArrays<S>& /*bodies*/, std::span<const typename S::Rot> /*start*/,
                       Real /*h*/) const {}
    /// Bodies that are at rest for all other bodies move: what is kept of them must be found again.
    virtual bool movesStatics() const { return false; }
};

/// The one object of a fault; null for `none`.
template <class S>
using FaultOf = const Fault<S>* (*)();
template <class S>
std::span<const AlgorithmEntry<FaultOf<S>>> faultTable();

}  // namespace rigor::engine

/// Defines and instantiates `make` for the class template `Type`.
#define RIGOR_FAULT(make, Type)                     \
    template <class S>                              \
    const Fault<S>* make() {                        \
        static const Type<S> fault;                 \
        return &fault;                              \
    }                                               \
    template const Fault<Space2f>* make<Space2f>(); \
    template const Fault<Space2d>* make<Space2d>(); \
    template const Fault<Space3f>* make<Space3f>(); \
    template const Fault<Space3d>* make<Space3d>()
