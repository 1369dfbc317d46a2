// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sweep and prune along one axis.
//
// Two boxes overlap only if their intervals [lo, hi] on a chosen axis do. With the boxes sorted by lo, the
// partners of box i on that axis are the ones that follow it until the first with lo > hi_i; each of them is
// tested on the remaining axes ([Baraff1992] section 7.2, [Ericson2005] section 7.5.2). The axis is the one
// along which the centres vary most. The order is kept between updates: boxes that moved a little are nearly
// sorted already and insertion sort puts them right in O(n + inversions).
//
// Deviation: when insertion sort has moved more than 16 n log2 n entries (a scene that jumped), it gives way
// to a sort from scratch, so an update never costs O(n^2) for the order alone.
//
// Cost per update: O(n + inversions + pairs that overlap on the axis), and sorting the pairs found. Limit:
// boxes stacked along the other axes all overlap on this one: a cube of n boxes has O(n^(5/3)) candidates.
#include <algorithm>
#include <bit>
#include <limits>

#include "engine/broadphase/box_tools.hpp"
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

template <class S>
class SweepAndPrune final : public BroadPhase<S> {
  public:
    using Real = typename S::Real;
    using Box = Aabb<S>;

    std::unique_ptr<BroadPhase<S>> clone() const override { return std::make_unique<SweepAndPrune>(*this); }
    void reset() override {
        intervals_.clear();
        axis_ = 0;
    }

    void update(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks&) override {
        const int axis = axisOfLargestVariance<S>(boxes, axis_);
        const bool afresh = intervals_.size() != boxes.size() || axis != axis_;
        axis_ = axis;
        if (intervals_.size() != boxes.size()) {
            intervals_.resize(boxes.size());
            for (std::uint32_t i = 0; i < boxes.size(); ++i) intervals_[i].proxy = i;
        }
        for (Interval& interval : intervals_) read(boxes[interval.proxy], interval);
        if (afresh || !insertionSort()) std::sort(intervals_.begin(), intervals_.end(), before);
        sweep(boxes, movable, pairs);
    }

  private:
    struct Interval {
        Real lo = 0, hi = 0;
        std::uint32_t proxy = 0;
    };
    static bool before(const Interval& a, const Interval& b) {
        return a.lo < b.lo || (a.lo == b.lo && a.proxy < b.proxy);
    }
    void read(const Box& box, Interval& interval) const {
        interval.lo = box.min[axis_];
        interval.hi = box.max[axis_];
        // A box with a NaN overlaps nothing; it is kept at the end, where it does not break the order.
        if (!(interval.lo <= interval.hi)) {
            interval.lo = std::numeric_limits<Real>::infinity();
            interval.hi = -interval.lo;
        }
    }

    /// False: too far from sorted; some order is left.
    bool insertionSort() {
        const std::size_t n = intervals_.size();
        const std::size_t budget = 16 * n * std::bit_width(n);
        std::size_t moves = 0;
        for (std::size_t i = 1; i < n; ++i) {
            const Interval interval = intervals_[i];
            std::size_t j = i;
            for (; j > 0 && before(interval, intervals_[j - 1]); --j) intervals_[j] = intervals_[j - 1];
            intervals_[j] = interval;
            moves += i - j;
            if (moves > budget) return false;
        }
        return true;
    }

    void sweep(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
               std::vector<ProxyPair>& pairs) const {
        pairs.clear();
        for (std::size_t k = 0; k < intervals_.size(); ++k) {
            const auto [lo, hi, i] = intervals_[k];
            const Box& box = boxes[i];
            for (std::size_t l = k + 1; l < intervals_.size() && intervals_[l].lo <= hi; ++l) {
                const std::uint32_t j = intervals_[l].proxy;
                if ((movable[i] || movable[j]) && this->overlap(box, boxes[j]))
                    pairs.push_back(orderedPair(i, j));
            }
        }
        std::sort(pairs.begin(), pairs.end());
    }

    int axis_ = 0;
    std::vector<Interval> intervals_;  ///< sorted in the order of the last update
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeSweepAndPrune() {
    return std::make_unique<SweepAndPrune<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSweepAndPrune, BroadPhase);

}  // namespace rigor::engine
