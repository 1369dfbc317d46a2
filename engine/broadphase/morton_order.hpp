// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes in the order of a space-filling curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

/// Sorts boxes by size class, then by the place of their centres on the Morton curve [Morton1966], then by
/// index: neighbours in the order are mostly neighbours in space. Size classes: up to 8 times the median
/// edge, up to 64 times, larger, and those without bounds; so that a floor does not stand among the boxes on
/// it. A function of the boxes alone. No allocation once their number has stopped growing.
template <class S>
class MortonOrder {
  public:
    /// Replaces `order` by the indices of the boxes.
    void sort(std::span<const Aabb<S>> boxes, std::vector<std::uint32_t>& order, const Tasks& tasks);

    /// The middle of the boxes that have bounds, in the last sort [m].
    const typename S::Vec& middle() const { return middle_; }

  private:
    using Real = typename S::Real;
    struct Entry {
        std::uint64_t key;
        std::uint32_t box;
    };
    void chooseGrid(std::span<const Aabb<S>> boxes);
    std::uint64_t keyOf(const Aabb<S>& box) const;
    void radixSort();

    typename S::Vec middle_ = S::Vec::Zero(), low_ = S::Vec::Zero();
    Real median_ = 0, perCell_ = 1;  ///< edge [m]; cells per metre
    int bits_ = 0;                   ///< of a cell's number along an axis
    std::vector<Entry> entries_, spare_;
    std::vector<Real> edges_;
};

}  // namespace rigor::engine
