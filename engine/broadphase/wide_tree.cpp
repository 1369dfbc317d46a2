// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wide tree: eight boxes per node, searched against itself.
//
// The boxes are in an order that keeps neighbours together (spatial_order.hpp); every eight form a node,
// every eight nodes one of the next level, up to the root: a bounding volume hierarchy in the manner of
// [Lauterbach2009], with wide nodes stored level by level, without pointers ([Wald2008] has wide nodes and
// why they suit vector instructions: one box is tested against the eight of a node at once). All pairs come
// from one descent of the tree against itself: a pair of nodes whose boxes overlap is opened at both ends, so
// that the upper levels are looked at once and not once per box ([Gottschalk1996] has the simultaneous
// descent of two trees; FCL's dynamic tree does the same with a binary tree).
//
// Between updates the order stays and the boxes of the nodes that hold a changed box are made anew, from the
// leaves up. Changed is what differs from the copy of the last update: while few boxes changed, only what
// overlaps them is searched, and the pairs of the others are kept. The boxes are sorted anew when the nodes
// have grown by a quarter on average, or a search visited half as many pairs of nodes more than the first one
// after the sort.
//
// Deviation: the tree holds boxes in single precision, relative to the middle of the scene. Rounding keeps
// order (x <= y implies fl(x) <= fl(y)), so that no overlap is lost; in double precision the pairs found are
// tested again with the boxes themselves. A box that is not a number overlaps nothing. Boxes without bounds
// are leaves like others, last in the order.
//
// Threads share the units of the search and the nodes of a level; the assignment of the work to threads does
// not matter, since the pairs are sorted at the end (pair_sort.hpp) and sums are of integers.
//
// Cost per update: O(n + changed log n + pairs). Limits: in double precision a scene wider than 10^7 of its
// boxes is searched coarsely.
#include <algorithm>
#include <bit>
#include <limits>

#include "engine/broadphase/box_tools.hpp"
#include "engine/broadphase/broad_phase.hpp"
#include "engine/broadphase/pair_sort.hpp"
#include "engine/broadphase/spatial_order.hpp"
#include "engine/broadphase/wide_tree_search.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kChildren = 8;
constexpr std::size_t kNodeGrain = 32;          ///< nodes: some microseconds of work
constexpr std::uint64_t kGrown = 320;           ///< mean growth of nodes that triggers a sort; 256 is none
constexpr std::size_t kUnitsWorthSharing = 16;  ///< units of 64 boxes each

template <class S>
class WideTree final : public BroadPhase<S> {
  public:
    using Real = typename S::Real;
    using Box = Aabb<S>;

    std::unique_ptr<BroadPhase<S>> clone() const override { return std::make_unique<WideTree>(*this); }
    void reset() override {
        kept_.clear();
        pairs_.clear();
    }

    void update(std::span<const Box> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks& tasks) override {
        if (boxes.empty())
            reset();
        else
            tasks.withWorkers([&] { updateSome(boxes, movable, tasks); });
        hold(pairs, pairs_.size());
        pairs = pairs_;
    }

  private:
    static constexpr int kDim = S::dim;
    static constexpr bool kExact = std::is_same_v<Real, float>;  ///< the tree has the boxes themselves
    using Node = WideNode<kDim>;
    struct Level {
        std::vector<Node> nodes;
        std::vector<WideMarks> marks;
    };

    /// Room for `count` pairs, and if there is none, for some more.
    static void hold(std::vector<ProxyPair>& list, std::size_t count) {
        if (list.capacity() < count) list.reserve(count + count / 2);
    }

    void updateSome(std::span<const Box> boxes, std::span<const std::uint8_t> movable, const Tasks& tasks) {
        const bool afresh = boxes.size() != kept_.size();
        if (afresh) sort(boxes, tasks);
        std::size_t changed = refit(boxes, movable, tasks);
        if (!afresh && changed > 0 && (isWorn_ || isGrown())) {
            sort(boxes, tasks);
            changed = refit(boxes, movable, tasks);
        }
        if (changed * 4 > boxes.size())
            findAll(tasks);
        else if (changed > 0)
            findChanged(tasks);
    }

    /// A new order and levels of the right size; every leaf counts as changed.
    void sort(std::span<const Box> boxes, const Tasks& tasks) {
        order_.sort(boxes, proxies_, tasks);
        if constexpr (!kExact) origin_ = order_.middle();
        Node none;
        for (int k = 0; k < kDim; ++k)
            for (std::size_t j = 0; j < kChildren; ++j)
                none.lo[k][j] = none.hi[k][j] = std::numeric_limits<float>::quiet_NaN();
        top_ = 0;
        for (std::size_t count = boxes.size();; ++top_) {
            count = (count + kChildren - 1) / kChildren;
            if (levels_.size() <= top_) levels_.emplace_back();
            levels_[top_].nodes.assign(count, none);
            levels_[top_].marks.assign(count, {});
            if (count == 1) break;
        }
        kept_.resize(boxes.size());
        keptMovable_.resize(boxes.size());
        size_.assign(levels_[0].nodes.size(), 0.0f);
        growth_.assign(levels_[0].nodes.size(), 0);
        isChanged_.resize(boxes.size());
        isNew_ = true;
        isWorn_ = false;
        firstVisits_ = 0;
    }

    /// Takes in the boxes; returns how many have changed.
    std::size_t refit(std::span<const Box> boxes, std::span<const std::uint8_t> movable, const Tasks& tasks) {
        tasks.forEach(levels_[0].nodes.size(), kNodeGrain,
                      [&](std::size_t g) { refitLeaves(g, boxes, movable); });
        for (std::size_t l = 1; l <= top_; ++l)
            tasks.forEach(levels_[l].nodes.size(), kNodeGrain, [&](std::size_t g) { refitNode(l, g); });
        std::size_t changed = 0;
        for (const WideMarks marks : levels_[0].marks)
            changed += static_cast<std::size_t>(std::popcount(marks.changed));
        isNew_ = false;
        return changed;
    }

    void refitLeaves(std::size_t g, std::span<const Box> boxes, std::span<const std::uint8_t> movable) {
        Node& node = levels_[0].nodes[g];
        WideMarks& marks = levels_[0].marks[g];
        marks.changed = 0;
        const std::size_t first = g * kChildren, count = std::min(kChildren, proxies_.size() - first);
        for (std::size_t j = 0; j < count; ++j) {
            const std::uint32_t i = proxies_[first + j];
            const Box& box = boxes[i];
            Box& kept = kept_[first + j];
            if (!isNew_ && box.min == kept.min && box.max == kept.max && movable[i] == keptMovable_[i])
                continue;
            kept = box;
            keptMovable_[i] = movable[i];
            const auto bit = static_cast<std::uint8_t>(1u << j);
            marks.changed |= bit;
            marks.movable =
                static_cast<std::uint8_t>(movable[i] ? marks.movable | bit : marks.movable & ~bit);
            for (int k = 0; k < kDim; ++k) {
                node.lo[k][j] = near(box.min, k);
                node.hi[k][j] = near(box.max, k);
            }
        }
        if (!marks.changed) return;
        const float size = top_ > 0 ? bound(node, levels_[1].nodes[g / kChildren], g % kChildren) : 1.0f;
        if (isNew_) size_[g] = size;
        // The quotient is NaN for boxes without size or bounds: they count as not grown.
        const float growth = size / size_[g];
        growth_[g] = growth < 8 ? static_cast<std::uint16_t>(growth * 256) : growth >= 8 ? 2048 : 256;
    }
    float near(const typename S::Vec& x, int k) const {
        if constexpr (kExact)
            return x[k];
        else
            return static_cast<float>(x[k] - origin_[k]);
    }

    void refitNode(std::size_t level, std::size_t g) {
        WideMarks& marks = levels_[level].marks[g];
        const auto& below = levels_[level - 1].marks;
        marks = {};
        for (std::size_t j = 0; j < kChildren && g * kChildren + j < below.size(); ++j) {
            const WideMarks child = below[g * kChildren + j];
            marks.movable |= static_cast<std::uint8_t>((child.movable != 0) << j);
            marks.changed |= static_cast<std::uint8_t>((child.changed != 0) << j);
        }
        if (marks.changed && level < top_)
            bound(levels_[level].nodes[g], levels_[level + 1].nodes[g / kChildren], g % kChildren);
    }

    /// The bounds of a node become child j of the one above; returns the sum of their edges [m]. NaNs are
    /// skipped.
    static float bound(const Node& node, Node& above, std::size_t j) {
        float sum = 0;
        for (int k = 0; k < kDim; ++k) {
            float lo = std::numeric_limits<float>::infinity(), hi = -lo;
            for (std::size_t i = 0; i < kChildren; ++i) {
                lo = node.lo[k][i] < lo ? node.lo[k][i] : lo;
                hi = node.hi[k][i] > hi ? node.hi[k][i] : hi;
            }
            above.lo[k][j] = lo;
            above.hi[k][j] = hi;
            sum += hi - lo;
        }
        return sum;
    }

    bool isGrown() const {
        std::uint64_t sum = 0;
        for (const std::uint16_t growth : growth_) sum += growth;
        return sum > kGrown * growth_.size();
    }

    WideTreeView<kDim> view() const {
        WideTreeView<kDim> tree;
        for (std::size_t l = 0; l <= top_; ++l)
            tree.levels[l] = {levels_[l].nodes.data(), levels_[l].marks.data(), levels_[l].nodes.size()};
        tree.top = top_;
        return tree;
    }

    /// Replaces `pairs` by the proxies of these leaves, where the boxes themselves overlap.
    void nameProxies(const std::vector<LeafPair>& leaves, std::vector<ProxyPair>& pairs) const {
        pairs.clear();
        for (const auto& [a, b] : leaves)
            if (kExact || kept_[a].overlaps(kept_[b])) pairs.push_back(orderedPair(proxies_[a], proxies_[b]));
    }

    /// pairParts_: the pairs found by each part of the search.
    WideSearchCost search(bool changedOnly, const Tasks& tasks) {
        const WideTreeView<kDim> tree = view();
        const std::size_t units = tree.units();
        const bool shared = tasks.threads() > 1 && units >= kUnitsWorthSharing;
        const std::size_t parts = shared ? std::min(units, 8 * static_cast<std::size_t>(tasks.threads())) : 1;
        parts_.resize(std::max(parts_.size(), parts));
        for (Part& part : parts_) {
            part.leaves.clear();
            part.cost = {};
        }
        pairParts_.resize(parts_.size());
        tasks.forEach(parts_.size(), 1, [&](std::size_t p) {
            if (p < parts)
                parts_[p].cost = searchWideTree(tree, changedOnly, units * p / parts, units * (p + 1) / parts,
                                                parts_[p].leaves);
            nameProxies(parts_[p].leaves, pairParts_[p]);
        });
        WideSearchCost all;
        for (const Part& part : parts_) {
            all.tests += part.cost.tests;
            all.visits += part.cost.visits;
        }
        this->tests_ += all.tests;
        return all;
    }

    void findAll(const Tasks& tasks) {
        const std::size_t visits = search(false, tasks).visits;
        if (firstVisits_ == 0) firstVisits_ = visits + 1;
        isWorn_ = 2 * visits > 3 * firstVisits_;
        pairSort_.sort(pairParts_, proxies_.size(), pairs_, tasks);
        // Input of findChanged(), which may be called for the first time long after this.
        const std::size_t count = pairs_.size();
        hold(found_, count);
        hold(pairs_, 2 * count);
        hold(merged_, 2 * count);
    }

    void findChanged(const Tasks& tasks) {
        search(true, tasks);
        pairSort_.sort(pairParts_, proxies_.size(), found_, tasks);
        forChanged([&](std::uint32_t i) { isChanged_[i] = 1; });
        mergeFound();
        forChanged([&](std::uint32_t i) { isChanged_[i] = 0; });
    }
    /// pairs_ without those of changed boxes, and found_.
    void mergeFound() {
        merged_.resize(pairs_.size() + found_.size());
        ProxyPair* to = merged_.data();
        auto found = found_.begin();
        for (const ProxyPair& pair : pairs_) {
            while (found != found_.end() && *found < pair) *to++ = *found++;
            *to = pair;
            to += !(isChanged_[pair.a] | isChanged_[pair.b]);
        }
        to = std::copy(found, found_.end(), to);
        merged_.resize(static_cast<std::size_t>(to - merged_.data()));
        std::swap(pairs_, merged_);
    }
    template <class Visit>
    void forChanged(Visit visit) const {
        for (std::size_t g = 0; g < levels_[0].marks.size(); ++g)
            for (unsigned bits = levels_[0].marks[g].changed; bits; bits &= bits - 1)
                visit(proxies_[g * kChildren + static_cast<std::size_t>(std::countr_zero(bits))]);
    }

    SpatialOrder<S> order_;
    std::vector<std::uint32_t> proxies_;     ///< proxy of each leaf
    std::vector<Box> kept_;                  ///< boxes of the last update, by leaf
    std::vector<std::uint8_t> keptMovable_;  ///< movable flags of the last update, by proxy
    std::vector<Level> levels_;              ///< levels up to top_ are in use
    std::size_t top_ = 0;
    typename S::Vec origin_ = S::Vec::Zero();  ///< origin of the tree's boxes [m]
    bool isNew_ = false;                       ///< sorted since the last refit
    bool isWorn_ = false;                      ///< true if the tree is to be sorted in the next update
    std::vector<float> size_;                  ///< sum of the edges of each node of level 0 when built [m]
    std::vector<std::uint16_t> growth_;        ///< growth since then in 1/256, by node of level 0
    std::size_t firstVisits_ = 0;              ///< nodes visited by the first full search after the sort; 0:
                                               ///< none yet

    struct Part {
        std::vector<LeafPair> leaves;
        WideSearchCost cost;
    };
    std::vector<Part> parts_;
    std::vector<std::vector<ProxyPair>> pairParts_;
    PairSort pairSort_;
    std::vector<ProxyPair> pairs_, found_, merged_;  ///< sorted
    std::vector<std::uint8_t> isChanged_;            ///< flag of each proxy; all 0 between updates
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeWideTree() {
    return std::make_unique<WideTree<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeWideTree, BroadPhase);

}  // namespace rigor::engine
