// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sweep and prune on all axes (three in 3D, two in 2D) with persistent end-point lists.
//
// Each axis keeps the 2n end points (a minimum and a maximum per box) in a sorted list, and the set of
// overlapping pairs is kept too ([CohenLinManochaPonamgi1995] section 3.2, [Ericson2005] section 7.5.1).
// Insertion sort repairs the lists after the boxes have moved, and each exchange of two neighbours is an
// event on that axis:
//     a minimum passes left of a maximum: the intervals begin to overlap; the pair enters the set if the
//                                         boxes overlap on every axis;
//     a maximum passes left of a minimum: the intervals cease to overlap; the pair leaves the set.
// Insertion sort exchanges exactly the inverted end points, each once, and both tests use the new boxes, so a
// pair never enters and leaves in the same update. Minima come before maxima of equal value: touching counts.
// Boxes without bounds need nothing special, they are at the ends of the lists.
//
// Deviations: the set is a sorted array, and the pairs that enter and leave are collected and merged into it
// once per update instead of going through a hash table (same order on every machine). When the lists are far
// from sorted (more than 16 n log2 n exchanges on an axis), they are sorted from scratch and the pairs found
// by one sweep; so too when a proxy changes between movable and fixed, or a box is not a number.
//
// Cost per update: O(n + exchanges + pairs). Nothing moves: O(n + pairs). Limit: in a dense scene one fast
// box exchanges places with O(n) end points per axis, whether or not it comes near their boxes.
#include <algorithm>
#include <bit>
#include <limits>

#include "engine/broadphase/box_tools.hpp"
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

template <class S>
class SweepAndPruneAllAxes final : public BroadPhase<S> {
  public:
    using Real = typename S::Real;
    using Box = Aabb<S>;

    std::unique_ptr<BroadPhase<S>> clone() const override {
        return std::make_unique<SweepAndPruneAllAxes>(*this);
    }
    void reset() override { previous_.clear(); }

    void update(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks&) override {
        if (mustRestart(boxes, movable) || !updateLists(boxes, movable)) restart(boxes, movable);
        previous_.assign(boxes.begin(), boxes.end());
        movable_.assign(movable.begin(), movable.end());
        pairs = overlapping_;
    }

  private:
    struct EndPoint {
        Real value = 0;
        std::uint32_t key = 0;  ///< twice the proxy, plus one for a maximum
        bool isMax() const { return key & 1; }
        std::uint32_t proxy() const { return key >> 1; }
    };
    using List = std::vector<EndPoint>;

    static bool before(const EndPoint& a, const EndPoint& b) {
        return a.value < b.value || (a.value == b.value && a.isMax() < b.isMax());
    }
    static bool isBox(const Box& box) { return (box.min.array() <= box.max.array()).all(); }

    bool mustRestart(std::span<const Box> boxes, std::span<const std::uint8_t> movable) const {
        return previous_.size() != boxes.size() ||
               !std::equal(movable.begin(), movable.end(), movable_.begin()) ||
               !std::all_of(boxes.begin(), boxes.end(), isBox) ||
               !std::all_of(previous_.begin(), previous_.end(), isBox);
    }

    /// Updates the lists and pairs from the last update to this one. False: gave up before the end.
    bool updateLists(std::span<const Box> boxes, std::span<const std::uint8_t> movable) {
        begun_.clear();
        ended_.clear();
        for (int axis = 0; axis < S::dim; ++axis) {
            List& list = lists_[axis];
            for (EndPoint& point : list) {
                const Box& box = boxes[point.proxy()];
                point.value = point.isMax() ? box.max[axis] : box.min[axis];
            }
            if (!insertionSort(list, boxes, movable)) return false;
        }
        mergeChanges();
        return true;
    }

    bool insertionSort(List& list, std::span<const Box> boxes, std::span<const std::uint8_t> movable) {
        const std::size_t budget = 16 * list.size() * std::bit_width(list.size());
        std::size_t exchanges = 0;
        for (std::size_t k = 1; k < list.size(); ++k) {
            const EndPoint point = list[k];
            std::size_t l = k;
            for (; l > 0 && before(point, list[l - 1]); --l) {
                if (point.isMax() != list[l - 1].isMax()) passes(point, list[l - 1], boxes, movable);
                list[l] = list[l - 1];
            }
            list[l] = point;
            exchanges += k - l;
            if (exchanges > budget) return false;
        }
        return true;
    }

    /// `point` goes from the right of `other` to its left.
    void passes(const EndPoint& point, const EndPoint& other, std::span<const Box> boxes,
                std::span<const std::uint8_t> movable) {
        const std::uint32_t i = point.proxy(), j = other.proxy();
        if (!(movable[i] || movable[j])) return;
        if (!point.isMax()) {
            if (this->overlap(boxes[i], boxes[j])) begun_.push_back(orderedPair(i, j));
        } else if (this->overlap(previous_[i], previous_[j])) {
            ended_.push_back(orderedPair(i, j));
        }
    }

    /// overlapping_ = (overlapping_ without ended_) and begun_, all sorted.
    void mergeChanges() {
        for (auto* changes : {&begun_, &ended_}) {  // a pair may begin or end on several axes at once
            std::sort(changes->begin(), changes->end());
            changes->erase(std::unique(changes->begin(), changes->end()), changes->end());
        }
        if (begun_.empty() && ended_.empty()) return;
        merged_.clear();
        auto begin = begun_.begin();
        auto end = ended_.begin();
        for (const ProxyPair& pair : overlapping_) {
            while (begin != begun_.end() && *begin < pair) merged_.push_back(*begin++);
            while (end != ended_.end() && *end < pair) ++end;
            if (end == ended_.end() || *end != pair) merged_.push_back(pair);
        }
        merged_.insert(merged_.end(), begin, begun_.end());
        std::swap(overlapping_, merged_);
    }

    void restart(std::span<const Box> boxes, std::span<const std::uint8_t> movable) {
        const auto n = static_cast<std::uint32_t>(boxes.size());
        for (int axis = 0; axis < S::dim; ++axis) {
            List& list = lists_[axis];
            list.clear();
            list.reserve(2 * boxes.size());
            for (std::uint32_t i = 0; i < n; ++i) {
                // A box with a NaN overlaps nothing; it stays at the far end until the next update.
                const bool valid = isBox(boxes[i]);
                constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
                list.push_back({valid ? boxes[i].min[axis] : kInfinity, 2 * i});
                list.push_back({valid ? boxes[i].max[axis] : kInfinity, 2 * i + 1});
            }
            std::sort(list.begin(), list.end(), [](const EndPoint& a, const EndPoint& b) {
                return before(a, b) || (!before(b, a) && a.key < b.key);
            });
        }
        sweep(lists_[axisOfLargestVariance<S>(boxes, 0)], boxes, movable);
    }

    /// All pairs from one list: open boxes are the ones whose minimum has been passed, not yet their maximum.
    void sweep(const List& list, std::span<const Box> boxes, std::span<const std::uint8_t> movable) {
        overlapping_.clear();
        open_.clear();
        placeInOpen_.resize(boxes.size());
        for (const EndPoint& point : list) {
            const std::uint32_t i = point.proxy();
            if (point.isMax()) {
                placeInOpen_[open_.back()] = placeInOpen_[i];
                open_[placeInOpen_[i]] = open_.back();
                open_.pop_back();
                continue;
            }
            for (const std::uint32_t j : open_)
                if ((movable[i] || movable[j]) && this->overlap(boxes[i], boxes[j]))
                    overlapping_.push_back(orderedPair(i, j));
            placeInOpen_[i] = static_cast<std::uint32_t>(open_.size());
            open_.push_back(i);
        }
        std::sort(overlapping_.begin(), overlapping_.end());
    }

    std::vector<Box> previous_;  ///< boxes of the last update
    std::vector<std::uint8_t> movable_;
    List lists_[S::dim];
    std::vector<ProxyPair> overlapping_, begun_, ended_, merged_;  ///< sorted
    std::vector<std::uint32_t> open_, placeInOpen_;
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeSweepAndPruneAllAxes() {
    return std::make_unique<SweepAndPruneAllAxes<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSweepAndPruneAllAxes, BroadPhase);

}  // namespace rigor::engine
