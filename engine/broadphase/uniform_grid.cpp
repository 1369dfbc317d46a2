// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Uniform grid, hashed.
//
// Space is cut into cubes (2D: squares) of edge c; cell(x) = floor(x / c) by component. A box is entered in
// every cell that it overlaps, and only boxes of one cell are tested against each other. The grid is
// unbounded: cells live in a hash table that is filled anew in every update by a counting sort
// [Teschner2003], so buckets are contiguous, in the order of the proxies, and nothing needs to be deleted. A
// pair that shares several cells is reported by one of them alone, the cell of the lowest corner of the
// boxes' common part ([Ericson2005] section 7.1.6): no search for duplicates.
//
// Choice of c: the edge length that nine boxes in ten stay below. Boxes longer than 2c would fill many cells;
// they are kept out of the table, and each of them queries the cells that it overlaps, or, when these are
// more than there are small boxes (floors, half-spaces), all boxes directly. Cell numbers are clamped to
// +-2^30: far away boxes share the outermost cells, which costs time and loses no pair, since the clamped
// cell(x) is monotone.
//
// Cost per update: O(n 2^dim + tests in cells + large boxes (their cells or n)). Limits: no use is made of
// the last update; a scene whose sizes vary by orders of magnitude has cells crowded with small boxes or a
// long list of large ones: there a tree or the octree is the better choice.
#include <algorithm>
#include <array>
#include <bit>

#include "engine/broadphase/box_tools.hpp"
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

template <class S>
class UniformGrid final : public BroadPhase<S> {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Box = Aabb<S>;

    std::unique_ptr<BroadPhase<S>> clone() const override { return std::make_unique<UniformGrid>(*this); }
    void reset() override {}

    void update(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks&) override {
        pairs.clear();
        chooseCell(boxes);
        fillTable(boxes);
        for (std::size_t k = 0; k + 1 < bucketStart_.size(); ++k) pairsOfBucket(k, boxes, movable, pairs);
        for (const std::uint32_t i : large_) pairsOfLarge(i, boxes, movable, pairs);
        std::sort(pairs.begin(), pairs.end());
    }

  private:
    using Cell = std::array<std::int32_t, S::dim>;
    struct Entry {
        Cell cell;
        std::uint32_t proxy;
    };

    void chooseCell(std::span<const Box> boxes) {
        edge_ = quantileOfEdges<S>(boxes, 0.9, scratch_);
        if (!(edge_ > 0)) {
            // Points: the mean distance of as many points spread evenly over the same bounds.
            const Box all = boundsOfBounded<S>(boxes);
            const double n = std::max<double>(1, static_cast<double>(boxes.size()));
            edge_ = longestEdge<S>(all) / static_cast<Real>(std::pow(n, 1.0 / S::dim));
        }
        if (!(edge_ > 0)) edge_ = 1;
        // The quotient x / c could overflow for a smaller edge.
        edge_ = std::max(edge_, std::sqrt(std::numeric_limits<Real>::min()));
        perEdge_ = Real(1) / edge_;
    }

    std::int32_t cellOf(Real x) const {
        constexpr Real kLast = Real(1 << 30);
        return static_cast<std::int32_t>(std::floor(std::clamp(x * perEdge_, -kLast, kLast)));
    }
    Cell cellOf(const Vec& x) const {
        Cell cell;
        for (int k = 0; k < S::dim; ++k) cell[k] = cellOf(x[k]);
        return cell;
    }
    std::size_t bucketOf(const Cell& cell) const {
        // Large odd factors per axis, then the high bits folded down (the finalizer of a 64-bit mix).
        std::uint64_t h = 0;
        for (const std::int32_t c : cell) {
            h = (h ^ static_cast<std::uint32_t>(c)) * 0x9e3779b97f4a7c15ull;
            h ^= h >> 29;
        }
        return static_cast<std::size_t>(h) & mask_;
    }

    /// Calls visit(cell) for each cell that the box overlaps, in lexicographic order.
    template <class Visit>
    void forCells(const Box& box, Visit visit) const {
        const Cell lo = cellOf(box.min), hi = cellOf(box.max);
        Cell cell = lo;
        for (;;) {
            visit(cell);
            std::size_t k = 0;
            for (; k < cell.size() && cell[k] == hi[k]; ++k) cell[k] = lo[k];
            if (k == cell.size()) return;
            ++cell[k];
        }
    }
    /// Number of cells that forCells would visit.
    double countCells(const Box& box) const {
        double count = 1;
        for (int k = 0; k < S::dim; ++k)
            count *= 1 + static_cast<double>(cellOf(box.max[k])) - static_cast<double>(cellOf(box.min[k]));
        return count;
    }

    void fillTable(std::span<const Box> boxes) {
        large_.clear();
        unsorted_.clear();
        large_.reserve(boxes.size());
        isLarge_.assign(boxes.size(), 0);
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            if (BroadPhase<S>::unbounded(boxes[i]) || longestEdge<S>(boxes[i]) > 2 * edge_) {
                large_.push_back(i);
                isLarge_[i] = 1;
            } else
                forCells(boxes[i], [&](const Cell& cell) { unsorted_.push_back({cell, i}); });
        }
        // Twice as many buckets as boxes; the size never shrinks, so that it settles.
        mask_ = std::max(mask_, std::bit_ceil(2 * boxes.size() + 1) - 1);
        bucketStart_.assign(mask_ + 2, 0);
        for (const Entry& entry : unsorted_) ++bucketStart_[bucketOf(entry.cell) + 1];
        for (std::size_t k = 0; k <= mask_; ++k) bucketStart_[k + 1] += bucketStart_[k];
        entries_.resize(unsorted_.size());
        // Backwards, so that each bucket's start ends up where it belongs and its entries in their order.
        for (std::size_t e = unsorted_.size(); e-- > 0;)
            entries_[--bucketStart_[bucketOf(unsorted_[e].cell) + 1]] = unsorted_[e];
        for (std::size_t k = 0; k <= mask_; ++k) bucketStart_[k] = bucketStart_[k + 1];
        bucketStart_[mask_ + 1] = static_cast<std::uint32_t>(entries_.size());
    }

    /// True in one of the cells that two overlapping boxes share.
    bool reportsHere(const Box& a, const Box& b, const Cell& cell) const {
        return cellOf(Vec(a.min.cwiseMax(b.min))) == cell;
    }

    void pairsOfBucket(std::size_t bucket, std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                       std::vector<ProxyPair>& pairs) const {
        for (std::uint32_t e = bucketStart_[bucket]; e < bucketStart_[bucket + 1]; ++e) {
            const auto& [cell, i] = entries_[e];
            for (std::uint32_t f = e + 1; f < bucketStart_[bucket + 1]; ++f) {
                const std::uint32_t j = entries_[f].proxy;
                if (this->overlap(boxes[i], boxes[j]) && (movable[i] || movable[j]) &&
                    entries_[f].cell == cell && reportsHere(boxes[i], boxes[j], cell))
                    pairs.push_back(orderedPair(i, j));
            }
        }
    }

    void pairsOfLarge(std::uint32_t i, std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                      std::vector<ProxyPair>& pairs) const {
        const Box& box = boxes[i];
        const auto test = [&](std::uint32_t j) {
            if (j != i && (movable[i] || movable[j]) && this->overlap(box, boxes[j]))
                pairs.push_back(orderedPair(i, j));
        };
        for (const std::uint32_t j : large_)
            if (j > i) test(j);
        const auto small = static_cast<double>(boxes.size() - large_.size());
        if (BroadPhase<S>::unbounded(box) || countCells(box) > small) {
            for (std::uint32_t j = 0; j < boxes.size(); ++j)
                if (!isLarge_[j]) test(j);
            return;
        }
        forCells(box, [&](const Cell& cell) {
            const std::size_t bucket = bucketOf(cell);
            for (std::uint32_t e = bucketStart_[bucket]; e < bucketStart_[bucket + 1]; ++e)
                if (entries_[e].cell == cell && this->overlap(box, boxes[entries_[e].proxy]) &&
                    reportsHere(box, boxes[entries_[e].proxy], cell))
                    test(entries_[e].proxy);
        });
    }

    Real edge_ = 1, perEdge_ = 1;  ///< edge of a cell [m] and its inverse [1/m]
    std::size_t mask_ = 0;         ///< buckets less one, a power of two less one
    std::vector<std::uint32_t> bucketStart_;
    std::vector<Entry> entries_, unsorted_;  ///< entries by bucket; entries by proxy
    std::vector<std::uint32_t> large_;
    std::vector<std::uint8_t> isLarge_;
    std::vector<Real> scratch_;
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeUniformGrid() {
    return std::make_unique<UniformGrid<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeUniformGrid, BroadPhase);

}  // namespace rigor::engine
