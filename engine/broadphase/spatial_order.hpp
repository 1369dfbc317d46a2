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

/// Puts boxes in an order whose every eight consecutive ones (0..7, 8..15, ...) lie close together, and every
/// eight such groups, and so on. First by size class, then by the place of their centres on the Morton curve
/// [Morton1966]; then each 4096 of these are cut in half along their longest axis, and the halves again, down
/// to eight ([Bentley1975]): half as many groups overlap as with the curve alone. Size classes: up to 8 times
/// the median edge, up to 64 times, larger, and those without bounds; so that a floor is not between the
/// boxes on it. A function of the boxes alone. No allocation once their number has stopped growing.
template <class S>
class SpatialOrder {
  public:
    /// `group`: where the cutting ends, a power of two up to 4096.
    explicit SpatialOrder(std::size_t group = 8) : group_(group) {}

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
    int classOf(const Entry& entry) const { return static_cast<int>(entry.key >> S::dim * bits_); }
    void sortEntries();
    void radixSort();

    struct Center {
        float at[S::dim];  ///< relative to the middle [m]
        std::uint32_t box;
    };
    void halve(Center* begin, Center* end) const;

    std::size_t group_;

    typename S::Vec middle_ = S::Vec::Zero(), low_ = S::Vec::Zero();
    Real median_ = 0, perCell_ = 1;  ///< edge [m]; cells per metre
    int bits_ = 0;                   ///< bits of a cell's number along an axis
    std::vector<Entry> entries_, spare_;
    std::vector<Center> centers_;
    std::vector<std::size_t> blocks_;  ///< first element of each block, and the end of the last
    std::vector<Real> edges_;
};

}  // namespace rigor::engine
