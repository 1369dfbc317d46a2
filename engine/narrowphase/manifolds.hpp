// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Treatment of the points that the narrow phase found: the family "manifold" (manifolds.def).
#pragma once

#include <span>
#include <string>

#include "engine/core/table.hpp"
#include "engine/narrowphase/manifold.hpp"

namespace rigor::engine {

/// Points kept from step to step; part of the world's state. Only "persistent" fills it.
template <class S>
struct ManifoldCache {
    struct Point {
        /// points in the frames of the shapes [m]
        typename S::Vec onA = S::Vec::Zero(), onB = S::Vec::Zero();
        std::uint32_t name = 0;  ///< stable while the point is kept
    };
    int count = 0;
    std::array<Point, S::maxManifoldPoints> points;
};

/// A touching pair in one step.
template <class S>
struct ManifoldPair {
    const Pose<S>& Xa;
    const Pose<S>& Xb;
    typename S::Real size;                 ///< size of the smaller of the two shapes [m]
    typename S::Real speculativeDistance;  ///< query distance of the narrow phase [m]
};

/// Turns what the narrow phase found (count >= 1) into what the solver gets; `cache` comes from the last
/// step, empty for a new contact.
template <class S>
using ManifoldFunction = void (*)(const ManifoldPair<S>& pair, ManifoldCache<S>& cache,
                                  Manifold<S>& manifold);

template <class S>
std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable();

#define ALGORITHM(name, function, summary) \
    template <class S>                     \
    void function(const ManifoldPair<S>& pair, ManifoldCache<S>& cache, Manifold<S>& manifold);
#include "engine/narrowphase/manifolds.def"

/// Explicit instantiation of a manifold function.
#define RIGOR_INSTANTIATE_MANIFOLD(function)                                                           \
    template void function(const ManifoldPair<Space2f>&, ManifoldCache<Space2f>&, Manifold<Space2f>&); \
    template void function(const ManifoldPair<Space2d>&, ManifoldCache<Space2d>&, Manifold<Space2d>&); \
    template void function(const ManifoldPair<Space3f>&, ManifoldCache<Space3f>&, Manifold<Space3f>&); \
    template void function(const ManifoldPair<Space3d>&, ManifoldCache<Space3d>&, Manifold<Space3d>&)

}  // namespace rigor::engine
