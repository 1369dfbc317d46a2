// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions on boxes that several broad phases use.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

/// Longest edge of a box [m].
template <class S>
typename S::Real longestEdge(const Aabb<S>& box) {
    return (box.max - box.min).maxCoeff();
}

/// The pair of two different proxies, a < b.
inline ProxyPair orderedPair(std::uint32_t i, std::uint32_t j) {
    return i < j ? ProxyPair{i, j} : ProxyPair{j, i};
}

/// The edge length that a fraction q, in [0, 1), of the bounded boxes stays below [m]; 0 when there are none.
template <class S>
typename S::Real quantileOfEdges(std::span<const Aabb<S>> boxes, double q,
                                 std::vector<typename S::Real>& scratch) {
    scratch.clear();
    scratch.reserve(boxes.size());
    for (const Aabb<S>& box : boxes)
        if (!BroadPhase<S>::unbounded(box)) scratch.push_back(longestEdge<S>(box));
    if (scratch.empty()) return 0;
    const auto place = scratch.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(scratch.size()));
    std::nth_element(scratch.begin(), place, scratch.end());
    return *place;
}

/// The smallest box around all bounded ones; a point at the origin when there are none.
template <class S>
Aabb<S> boundsOfBounded(std::span<const Aabb<S>> boxes) {
    Aabb<S> all{S::Vec::Zero(), S::Vec::Zero()};
    bool first = true;
    for (const Aabb<S>& box : boxes) {
        if (BroadPhase<S>::unbounded(box)) continue;
        all.min = first ? box.min : typename S::Vec(all.min.cwiseMin(box.min));
        all.max = first ? box.max : typename S::Vec(all.max.cwiseMax(box.max));
        first = false;
    }
    return all;
}

/// The axis along which the centres of the bounded boxes vary most; `current` is kept unless another axis has
/// half as much again, since a change costs a sort from scratch.
template <class S>
int axisOfLargestVariance(std::span<const Aabb<S>> boxes, int current) {
    using Real = typename S::Real;
    typename S::Vec mean = S::Vec::Zero(), variance = S::Vec::Zero();
    Real n = 0;
    // Welford's update: no cancellation far from the origin.
    for (const Aabb<S>& box : boxes) {
        if (BroadPhase<S>::unbounded(box)) continue;
        n += 1;
        const typename S::Vec center = Real(0.5) * box.min + Real(0.5) * box.max;
        const typename S::Vec d = center - mean;
        mean += d / n;
        variance += d.cwiseProduct(center - mean);
    }
    int best = current;
    for (int k = 0; k < S::dim; ++k)
        if (variance[k] > Real(1.5) * variance[current] && variance[k] > variance[best]) best = k;
    return best;
}

}  // namespace rigor::engine
