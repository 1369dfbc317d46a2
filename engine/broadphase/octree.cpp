// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Loose octree (2D: loose quadtree).
//
// A cell of half edge h has 2^dim children of half edge h / 2. In a plain octree a small box that crosses a
// middle plane is stuck in a large cell; here the bounds of a cell are loose, twice as wide as the cell
// itself ([Ulrich2000], looseness k = 2), so that a box goes to the depth its size allows, at every position:
// to a cell with
//     h / 2 < longest edge / 2 <= h,    the cell that holds its centre.
// A box stays in its cell while the loose bounds hold it and its size suits, so proxies that move a little
// cost nothing; cells without boxes below them are freed. The root doubles towards a box that it does not
// hold. To find the pairs, each box queries the tree from the root down to its own depth: partners in larger
// cells, and partners in cells of the same depth with a higher index. Each pair is found once. Deviation: the
// search prunes by the bounds of the boxes really there, renewed from the leaves up in every update, not by
// the loose bounds (a third of the time: neighbouring loose bounds overlap, what is in them mostly does not).
//
// Where the loose bounds of a child do not hold the box after rounding, the box stays one level up. No cell
// is smaller than 1/16 of the median box, nor than the resolution of positions at its distance from the
// origin. Unbounded boxes stay outside and are tested against all others.
//
// Cost per update: O(n + cells + moved boxes times depth + n times the cells met). Limits: a box may meet
// several cells per level; one box far away deepens the whole tree by log2 of its distance.
#include <algorithm>
#include <array>

#include "engine/broadphase/box_tools.hpp"
#include "engine/broadphase/broad_phase.hpp"
#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Octree final : public BroadPhase<S> {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Box = Aabb<S>;

    std::unique_ptr<BroadPhase<S>> clone() const override { return std::make_unique<Octree>(*this); }
    void reset() override { proxies_.clear(); }

    void update(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks&) override {
        if (boxes.size() != proxies_.size()) restart(boxes);
        outside_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const bool unbounded = BroadPhase<S>::unbounded(boxes[i]);
            if (unbounded) outside_.push_back(i);
            if (proxies_[i].cell != kNullIndex && !unbounded && suits(proxies_[i].cell, boxes[i])) continue;
            if (proxies_[i].cell != kNullIndex) remove(i);
            if (!unbounded) insert(i, boxes[i]);
        }
        if (!boxes.empty()) renewContent(root_, boxes);
        pairs.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (proxies_[i].cell != kNullIndex) findPairs(i, boxes, movable, pairs);
        addOutside(boxes, movable, pairs);
        std::sort(pairs.begin(), pairs.end());
    }

  private:
    static constexpr std::size_t kChildren = std::size_t(1) << S::dim;
    struct Cell {
        Box content;  ///< bounds of the boxes in it and below
        Vec center = Vec::Zero();
        Real half = 0;                      ///< half an edge of the cell [m]; of its loose bounds: twice that
        std::uint32_t parent = kNullIndex;  ///< parent; for a free cell the next free one
        std::uint32_t below = 0;            ///< boxes in it and its descendants
        std::uint32_t first = kNullIndex;   ///< its boxes, linked through Proxy
        std::int32_t level = 0;             ///< half = 2^-level of the first root's
        std::array<std::uint32_t, kChildren> child;
        Cell() { child.fill(kNullIndex); }
    };
    struct Proxy {
        std::uint32_t cell = kNullIndex, next = kNullIndex, previous = kNullIndex;
    };

    static Box looseBounds(const Vec& center, Real half) {
        const Vec reach = Vec::Constant(2 * half);
        return {center - reach, center + reach};
    }
    static Vec centerOf(const Box& box) { return Real(0.5) * box.min + Real(0.5) * box.max; }
    /// A cell this small is as deep as this box should go.
    bool sizeSuits(Real half, const Box& box) const {
        return half <= smallestHalf_ || longestEdge<S>(box) > half;
    }
    bool suits(std::uint32_t cell, const Box& box) const {
        return sizeSuits(cells_[cell].half, box) &&
               looseBounds(cells_[cell].center, cells_[cell].half).contains(box);
    }

    void restart(std::span<const Box> boxes) {
        proxies_.assign(boxes.size(), {});
        outside_.reserve(boxes.size());
        cells_.clear();
        free_ = kNullIndex;
        const Box all = boundsOfBounded<S>(boxes);
        // A power of two: halves and sums of them are exact. A single point could be of any size: 1 m.
        Real half = longestEdge<S>(all) / 2;
        half = half > 0 ? std::exp2(std::ceil(std::log2(half))) : Real(1);
        smallestHalf_ = quantileOfEdges<S>(boxes, 0.5, scratch_) / 32;
        if (!(smallestHalf_ > 0))  // points: as many cells as boxes, if they were spread evenly
            smallestHalf_ = half / static_cast<Real>(std::pow(double(boxes.size() + 1), 1.0 / S::dim));
        root_ = takeCell();
        cells_[root_].center = centerOf(all);
        cells_[root_].half = half;
    }

    std::uint32_t takeCell() {
        if (free_ == kNullIndex) {
            cells_.emplace_back();
            return static_cast<std::uint32_t>(cells_.size() - 1);
        }
        const std::uint32_t i = free_;
        free_ = cells_[i].parent;
        cells_[i] = Cell();
        return i;
    }

    static std::size_t octant(const Vec& center, const Vec& x) {
        std::size_t o = 0;
        for (int k = 0; k < S::dim; ++k) o |= std::size_t(x[k] >= center[k]) << k;
        return o;
    }

    /// Doubles the root until its loose bounds hold the box.
    void growRoot(const Box& box) {
        while (!looseBounds(cells_[root_].center, cells_[root_].half).contains(box)) {
            const std::uint32_t old = root_;
            const Vec target = centerOf(box);
            const Real half = cells_[old].half;
            Vec center = cells_[old].center;
            for (int k = 0; k < S::dim; ++k) center[k] += target[k] >= center[k] ? half : -half;
            root_ = takeCell();
            Cell& root = cells_[root_];
            root.center = center;
            root.half = 2 * half;
            root.below = cells_[old].below;
            root.level = cells_[old].level - 1;
            root.child[octant(center, cells_[old].center)] = old;
            cells_[old].parent = root_;
        }
    }

    void insert(std::uint32_t i, const Box& box) {
        growRoot(box);
        const Vec target = centerOf(box);
        std::uint32_t cell = root_;
        while (!sizeSuits(cells_[cell].half, box)) {
            const std::size_t o = octant(cells_[cell].center, target);
            std::uint32_t child = cells_[cell].child[o];
            if (child == kNullIndex) {
                const Real half = cells_[cell].half / 2;
                Vec center = cells_[cell].center;
                for (int k = 0; k < S::dim; ++k) center[k] += o >> k & 1 ? half : -half;
                if (!looseBounds(center, half).contains(box)) break;
                child = takeCell();
                cells_[child].center = center;
                cells_[child].half = half;
                cells_[child].parent = cell;
                cells_[child].level = cells_[cell].level + 1;
                cells_[cell].child[o] = child;
            } else if (!looseBounds(cells_[child].center, cells_[child].half).contains(box)) {
                break;
            }
            cell = child;
        }
        const std::uint32_t head = cells_[cell].first;
        proxies_[i] = {cell, head, kNullIndex};
        if (head != kNullIndex) proxies_[head].previous = i;
        cells_[cell].first = i;
        for (; cell != kNullIndex; cell = cells_[cell].parent) ++cells_[cell].below;
    }

    void remove(std::uint32_t i) {
        const Proxy proxy = proxies_[i];
        proxies_[i] = {};
        if (proxy.next != kNullIndex) proxies_[proxy.next].previous = proxy.previous;
        if (proxy.previous != kNullIndex)
            proxies_[proxy.previous].next = proxy.next;
        else
            cells_[proxy.cell].first = proxy.next;
        for (std::uint32_t cell = proxy.cell; cell != kNullIndex;) {
            const std::uint32_t parent = cells_[cell].parent;
            if (--cells_[cell].below == 0 && parent != kNullIndex) {
                auto& siblings = cells_[parent].child;
                *std::find(siblings.begin(), siblings.end(), cell) = kNullIndex;
                cells_[cell].parent = free_;
                free_ = cell;
            }
            cell = parent;
        }
    }

    void renewContent(std::uint32_t i, std::span<const Box> boxes) {
        Cell& cell = cells_[i];
        cell.content.min.setConstant(std::numeric_limits<Real>::infinity());
        cell.content.max.setConstant(-std::numeric_limits<Real>::infinity());
        const auto include = [&](const Box& box) {
            cell.content = {cell.content.min.cwiseMin(box.min), cell.content.max.cwiseMax(box.max)};
        };
        for (std::uint32_t j = cell.first; j != kNullIndex; j = proxies_[j].next) include(boxes[j]);
        for (const std::uint32_t child : cell.child)
            if (child != kNullIndex) {
                renewContent(child, boxes);
                include(cells_[child].content);
            }
    }

    void findPairs(std::uint32_t i, std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                   std::vector<ProxyPair>& pairs) {
        const Box& box = boxes[i];
        const std::int32_t depth = cells_[proxies_[i].cell].level;
        stack_.clear();
        stack_.push_back(root_);
        while (!stack_.empty()) {
            const Cell& cell = cells_[stack_.back()];
            stack_.pop_back();
            for (std::uint32_t j = cell.first; j != kNullIndex; j = proxies_[j].next)
                if ((cell.level < depth || j > i) && (movable[i] || movable[j]) &&
                    this->overlap(box, boxes[j]))
                    pairs.push_back(orderedPair(i, j));
            if (cell.level == depth) continue;
            for (const std::uint32_t child : cell.child)
                if (child != kNullIndex && this->overlap(cells_[child].content, box)) stack_.push_back(child);
        }
    }

    void addOutside(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                    std::vector<ProxyPair>& pairs) const {
        for (const std::uint32_t i : outside_)
            for (std::uint32_t j = 0; j < boxes.size(); ++j) {
                const bool twice = proxies_[j].cell == kNullIndex && j <= i;
                if (!twice && (movable[i] || movable[j]) && this->overlap(boxes[i], boxes[j]))
                    pairs.push_back(orderedPair(i, j));
            }
    }

    std::vector<Cell> cells_;
    std::vector<Proxy> proxies_;
    std::uint32_t root_ = kNullIndex, free_ = kNullIndex;
    Real smallestHalf_ = 0;
    std::vector<std::uint32_t> outside_, stack_;
    std::vector<Real> scratch_;
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeOctree() {
    return std::make_unique<Octree<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeOctree, BroadPhase);

}  // namespace rigor::engine
