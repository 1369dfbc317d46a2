// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The search of wide_tree.cpp: the tree against itself, one box against the eight of a node at a time.
// Comparisons alone, so that every instruction set gives the same result.
#include "engine/broadphase/wide_tree_search.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/broadphase/wide_tree_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigor::engine {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit mask of the eight boxes of `node` that overlap child i of `other`.
template <int dim>
HWY_INLINE std::uint32_t overlapBits(const WideNode<dim>& node, const WideNode<dim>& other, std::size_t i) {
    const hn::CappedTag<float, WideNode<dim>::kChildren> lanes;
    std::uint32_t bits = 0;
    for (std::size_t c = 0; c < WideNode<dim>::kChildren; c += hn::Lanes(lanes)) {
        auto both = hn::And(hn::Le(hn::Load(lanes, node.lo[0] + c), hn::Set(lanes, other.hi[0][i])),
                            hn::Le(hn::Set(lanes, other.lo[0][i]), hn::Load(lanes, node.hi[0] + c)));
        for (int k = 1; k < dim; ++k) {
            both = hn::And(both, hn::Le(hn::Load(lanes, node.lo[k] + c), hn::Set(lanes, other.hi[k][i])));
            both = hn::And(both, hn::Le(hn::Set(lanes, other.lo[k][i]), hn::Load(lanes, node.hi[k] + c)));
        }
        std::uint8_t some[8] = {};
        hn::StoreMaskBits(lanes, both, some);
        bits |= static_cast<std::uint32_t>(some[0]) << c;
    }
    return bits;
}

HWY_INLINE std::size_t lowestBit(std::uint32_t bits) {
    return static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
}

template <int dim>
class Search {
  public:
    Search(const WideTreeView<dim>& tree, bool changedOnly, std::vector<LeafPair>& pairs)
        : tree_(tree), unitLevel_(tree.unitLevel()), changedOnly_(changedOnly), pairs_(pairs) {}

    WideSearchCost run(std::size_t begin, std::size_t end) {
        for (std::size_t unit = begin; unit < end; ++unit) {
            within(unitLevel_, unit);
            if (unitLevel_ < tree_.top) withLater(unit, tree_.top, 0);
        }
        return cost_;
    }

  private:
    static constexpr std::uint32_t kAll = (1u << WideNode<dim>::kChildren) - 1;

    /// The children of a node with these marks that may form a pair with a leaf below another.
    std::uint32_t wanted(bool otherMovable, bool otherChanged, WideMarks marks) const {
        return (otherMovable ? kAll : marks.movable) & (otherChanged || !changedOnly_ ? kAll : marks.changed);
    }
    std::uint32_t test(const WideNode<dim>& node, const WideNode<dim>& other, std::size_t i) {
        cost_.tests += WideNode<dim>::kChildren;
        return overlapBits<dim>(node, other, i);
    }
    void add(std::size_t leafA, std::size_t leafB) {
        pairs_.push_back({static_cast<std::uint32_t>(leafA), static_cast<std::uint32_t>(leafB)});
    }

    /// Pairs of leaves below one node.
    void within(std::size_t level, std::size_t g) {
        const WideNode<dim>& node = tree_.levels[level].nodes[g];
        const WideMarks marks = tree_.levels[level].marks[g];
        if (!marks.movable || (changedOnly_ && !marks.changed)) return;
        const std::size_t below = level > 0 ? tree_.levels[level - 1].count : 0;
        for (std::size_t i = 0; i < WideNode<dim>::kChildren; ++i) {
            const std::size_t child = 8 * g + i;
            if (level > 0) {
                if (child >= below) return;
                within(level - 1, child);
            }
            const std::uint32_t later = kAll & ~((2u << i) - 1);
            std::uint32_t hits = later & wanted(marks.movable >> i & 1, marks.changed >> i & 1, marks);
            if (hits) hits &= test(node, node, i);
            for (; hits; hits &= hits - 1)
                level > 0 ? between(level - 1, child, 8 * g + lowestBit(hits))
                          : add(child, 8 * g + lowestBit(hits));
        }
    }

    /// Pairs of a leaf below node g and one below node h of the same level, whose boxes overlap.
    void between(std::size_t level, std::size_t g, std::size_t h) {
        const WideNode<dim>&nodeG = tree_.levels[level].nodes[g], &nodeH = tree_.levels[level].nodes[h];
        const WideNode<dim>* above = tree_.levels[level + 1].nodes;
        const WideMarks marksG = tree_.levels[level].marks[g], marksH = tree_.levels[level].marks[h];
        if (level == 0) ++cost_.visits;
        std::uint32_t inG = wanted(marksH.movable != 0, marksH.changed != 0, marksG);
        inG &= test(nodeG, above[h / 8], h % 8);
        if (!inG) return;
        const std::uint32_t inH = test(nodeH, above[g / 8], g % 8);
        if (!inH) return;
        for (; inG; inG &= inG - 1) {
            const std::size_t i = lowestBit(inG);
            std::uint32_t hits = inH & wanted(marksG.movable >> i & 1, marksG.changed >> i & 1, marksH);
            if (hits) hits &= test(nodeH, nodeG, i);
            for (; hits; hits &= hits - 1)
                level > 0 ? between(level - 1, 8 * g + i, 8 * h + lowestBit(hits))
                          : add(8 * g + i, 8 * h + lowestBit(hits));
        }
    }

    /// Pairs of a leaf below unit g and one below a later unit: down from node k of a level above the units.
    void withLater(std::size_t g, std::size_t level, std::size_t k) {
        const WideNode<dim>& bounds = tree_.levels[unitLevel_ + 1].nodes[g / 8];
        const WideMarks marks = tree_.levels[unitLevel_].marks[g];
        std::uint32_t hits = wanted(marks.movable != 0, marks.changed != 0, tree_.levels[level].marks[k]);
        if (hits) hits &= test(tree_.levels[level].nodes[k], bounds, g % 8);
        for (; hits; hits &= hits - 1) {
            const std::size_t child = 8 * k + lowestBit(hits);
            const std::size_t lastUnit = ((child + 1) << 3 * (level - 1 - unitLevel_)) - 1;
            if (lastUnit <= g) continue;
            level - 1 == unitLevel_ ? between(unitLevel_, g, child) : withLater(g, level - 1, child);
        }
    }

    const WideTreeView<dim>& tree_;
    std::size_t unitLevel_;
    bool changedOnly_;
    std::vector<LeafPair>& pairs_;
    WideSearchCost cost_;
};

WideSearchCost search2(const WideTreeView<2>& tree, bool changedOnly, std::size_t begin, std::size_t end,
                       std::vector<LeafPair>& pairs) {
    return Search<2>(tree, changedOnly, pairs).run(begin, end);
}
WideSearchCost search3(const WideTreeView<3>& tree, bool changedOnly, std::size_t begin, std::size_t end,
                       std::vector<LeafPair>& pairs) {
    return Search<3>(tree, changedOnly, pairs).run(begin, end);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rigor::engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

HWY_EXPORT(search2);
HWY_EXPORT(search3);

WideSearchCost searchWideTree(const WideTreeView<2>& tree, bool changedOnly, std::size_t begin,
                              std::size_t end, std::vector<LeafPair>& pairs) {
    return HWY_DYNAMIC_DISPATCH(search2)(tree, changedOnly, begin, end, pairs);
}
WideSearchCost searchWideTree(const WideTreeView<3>& tree, bool changedOnly, std::size_t begin,
                              std::size_t end, std::vector<LeafPair>& pairs) {
    return HWY_DYNAMIC_DISPATCH(search3)(tree, changedOnly, begin, end, pairs);
}

}  // namespace rigor::engine
#endif  // HWY_ONCE
