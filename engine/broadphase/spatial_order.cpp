// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Keys: the bits of the cell's numbers along the axes, interleaved, under two bits of size class. Cells are a
// quarter of the median edge, or larger where 2^20 of them would not reach from end to end. Sorted by digits
// of 11 bits, lowest first; a digit that all keys share costs nothing.
#include "engine/broadphase/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/broadphase/box_tools.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::size_t kGrain = 4096;  // keys: some tens of microseconds
constexpr int kMaxBits = 20;          // three axes and two bits of class fit in 64 bits
constexpr std::size_t kDigitBits = 11, kDigits = 6, kBuckets = std::size_t(1) << kDigitBits;

/// Spreads the bits of x out to every second (2D) or third (3D) place.
template <int dim>
std::uint64_t spread(std::uint64_t x) {
    if constexpr (dim == 2) {
        x = (x | x << 16) & 0x0000ffff0000ffffull;
        x = (x | x << 8) & 0x00ff00ff00ff00ffull;
        x = (x | x << 4) & 0x0f0f0f0f0f0f0f0full;
        x = (x | x << 2) & 0x3333333333333333ull;
        return (x | x << 1) & 0x5555555555555555ull;
    } else {
        x = (x | x << 32) & 0x001f00000000ffffull;
        x = (x | x << 16) & 0x001f0000ff0000ffull;
        x = (x | x << 8) & 0x100f00f00f00f00full;
        x = (x | x << 4) & 0x10c30c30c30c30c3ull;
        return (x | x << 2) & 0x1249249249249249ull;
    }
}

}  // namespace

template <class S>
void SpatialOrder<S>::chooseGrid(std::span<const Aabb<S>> boxes) {
    const Aabb<S> all = boundsOfBounded<S>(boxes);
    low_ = all.min;
    middle_ = Real(0.5) * all.min + Real(0.5) * all.max;
    // A sample is enough for a choice of scale.
    constexpr std::size_t kSample = 512;
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / kSample);
    edges_.clear();
    edges_.reserve(2 * kSample);
    for (std::size_t i = 0; i < boxes.size(); i += stride)
        if (!BroadPhase<S>::unbounded(boxes[i])) edges_.push_back(longestEdge<S>(boxes[i]));
    median_ = 0;
    if (!edges_.empty()) {
        const auto place = edges_.begin() + static_cast<std::ptrdiff_t>(edges_.size() / 2);
        std::nth_element(edges_.begin(), place, edges_.end());
        median_ = *place;
    }
    const Real extent = longestEdge<S>(all), least = extent / static_cast<Real>(1 << kMaxBits);
    Real cell = std::max(median_ / 4, least);
    if (!(cell > std::numeric_limits<Real>::min())) cell = 1;
    perCell_ = 1 / cell;
    bits_ = 1;
    while (bits_ < kMaxBits && static_cast<Real>(1 << bits_) < extent * perCell_) ++bits_;
}

template <class S>
std::uint64_t SpatialOrder<S>::keyOf(const Aabb<S>& box) const {
    const int classShift = S::dim * bits_;
    if (BroadPhase<S>::unbounded(box)) return std::uint64_t(3) << classShift;
    const Real edge = longestEdge<S>(box);
    std::uint64_t key = edge > 64 * median_ ? 2 : edge > 8 * median_ ? 1 : 0;
    key <<= classShift;
    const Real last = static_cast<Real>((1 << bits_) - 1);
    for (int k = 0; k < S::dim; ++k) {
        const Real at = (Real(0.5) * box.min[k] + Real(0.5) * box.max[k] - low_[k]) * perCell_;
        key |= spread<S::dim>(static_cast<std::uint64_t>(std::clamp(at, Real(0), last))) << k;
    }
    return key;
}

/// The order is by key, and by index where keys are equal.
template <class S>
void SpatialOrder<S>::sortEntries() {
    // The counters of the radix sort take 50 KiB to clear, which is more than the boxes of a small world cost.
    constexpr std::size_t kFewEntries = 400;
    if (entries_.size() > kFewEntries) return radixSort();
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.key < b.key || (a.key == b.key && a.box < b.box);
    });
}

template <class S>
void SpatialOrder<S>::radixSort() {
    std::array<std::array<std::uint32_t, kBuckets>, kDigits> counts;
    for (auto& digit : counts) digit.fill(0);
    const auto bucketOf = [](std::uint64_t key, std::size_t digit) {
        return static_cast<std::size_t>(key >> digit * kDigitBits) & (kBuckets - 1);
    };
    for (const Entry& entry : entries_)
        for (std::size_t d = 0; d < kDigits; ++d) ++counts[d][bucketOf(entry.key, d)];
    spare_.resize(entries_.size());
    for (std::size_t d = 0; d < kDigits; ++d) {
        auto& starts = counts[d];
        if (entries_.empty() || starts[bucketOf(entries_[0].key, d)] == entries_.size()) continue;
        std::uint32_t sum = 0;
        for (std::uint32_t& count : starts) sum += std::exchange(count, sum);
        for (const Entry& entry : entries_) spare_[starts[bucketOf(entry.key, d)]++] = entry;
        std::swap(entries_, spare_);
    }
}

/// The first half gets a power of two.
template <class S>
void SpatialOrder<S>::halve(Center* begin, Center* end) const {
    const auto count = static_cast<std::size_t>(end - begin);
    if (count <= group_) return;
    std::array<float, S::dim> lo, hi;
    for (std::size_t k = 0; k < S::dim; ++k) {
        lo[k] = hi[k] = begin->at[k];
        for (const Center* c = begin; c < end; ++c) {
            lo[k] = std::min(lo[k], c->at[k]);
            hi[k] = std::max(hi[k], c->at[k]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < S::dim; ++k)
        if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    const std::size_t half = std::bit_ceil(count) / 2;
    std::nth_element(begin, begin + half, end, [axis](const Center& a, const Center& b) {
        return a.at[axis] < b.at[axis] || (a.at[axis] == b.at[axis] && a.box < b.box);
    });
    halve(begin, begin + half);
    halve(begin + half, end);
}

template <class S>
void SpatialOrder<S>::sort(std::span<const Aabb<S>> boxes, std::vector<std::uint32_t>& order,
                           const Tasks& tasks) {
    chooseGrid(boxes);
    const std::size_t n = boxes.size();
    entries_.resize(n);
    tasks.forEach(n, kGrain, [&](std::size_t i) {
        entries_[i] = {keyOf(boxes[i]), static_cast<std::uint32_t>(i)};
    });
    sortEntries();

    // Blocks do not mix classes, but begin where a group does.
    blocks_.clear();
    blocks_.reserve(n / kBlock + 8);
    for (std::size_t i = 0; i < n; i += group_)
        if (blocks_.empty() || i - blocks_.back() >= kBlock ||
            classOf(entries_[i]) != classOf(entries_[blocks_.back()]))
            blocks_.push_back(i);
    blocks_.push_back(n);
    centers_.resize(n);
    order.resize(n);
    tasks.forEach(blocks_.size() - 1, 1, [&](std::size_t b) {
        const std::size_t begin = blocks_[b], end = blocks_[b + 1];
        for (std::size_t i = begin; i < end; ++i) {
            const Aabb<S>& box = boxes[centers_[i].box = entries_[i].box];
            const bool placed = !BroadPhase<S>::unbounded(box);
            for (int k = 0; k < S::dim; ++k)
                centers_[i].at[k] =
                    placed ? static_cast<float>(Real(0.5) * box.min[k] + Real(0.5) * box.max[k] - middle_[k])
                           : 0.0f;
        }
        halve(centers_.data() + begin, centers_.data() + end);
        for (std::size_t i = begin; i < end; ++i) order[i] = centers_[i].box;
    });
}

RIGOR_INSTANTIATE_CLASS(SpatialOrder)

}  // namespace rigor::engine
