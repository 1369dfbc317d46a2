// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/pair_search.hpp"

#include <algorithm>
#include <atomic>

namespace rigor::engine {
namespace {

constexpr std::size_t kPairGrain = 256;  ///< least number of pairs for a task: some microseconds of work

}  // namespace

template <class S>
void PairSearch<S>::update(const ShapeSet<S>& shapes, BroadPhase<S>& broadPhase, Real boxMargin,
                           const Tasks& tasks) {
    exact_ = boxMargin == 0;
    foundValid_ = exact_;
    if (exact_) {
        broadPhase.update(shapes.boxes(), shapes.movable(), found_, tasks);
        count_ = found_.size();
        return;
    }
    if (fatBoxes_.update(broadPhase, shapes.boxes(), shapes.movable(), boxMargin, tasks)) changed_ = true;
    std::atomic<std::size_t> count = 0;
    tasks.forRanges(fatBoxes_.pairs().size(), kPairGrain, [&](std::size_t first, std::size_t last) {
        const auto pair = fatBoxes_.pairs().begin();
        const std::vector<Aabb<S>>& boxes = shapes.boxes();
        count += static_cast<std::size_t>(
            std::count_if(pair + static_cast<std::ptrdiff_t>(first), pair + static_cast<std::ptrdiff_t>(last),
                          [&boxes](const ProxyPair& p) { return boxes[p.a].overlaps(boxes[p.b]); }));
    });
    count_ = count;
}

/// Remembers the pairs of boxes without a margin, to be compared with those of the next step. Fat AABBs
/// report changes themselves: an invalid pair replaces theirs.
template <class S>
void PairSearch<S>::take() {
    changed_ = false;
    if (exact_)
        taken_.assign(found_.begin(), found_.end());
    else
        taken_.assign(1, ProxyPair{});
}

template <class S>
const std::vector<ProxyPair>& PairSearch<S>::overlapping(const ShapeSet<S>& shapes) const {
    if (!foundValid_) {
        found_.clear();
        for (const ProxyPair& pair : fatBoxes_.pairs())
            if (shapes.box(pair.a).overlaps(shapes.box(pair.b))) found_.push_back(pair);
        foundValid_ = true;
    }
    return found_;
}

RIGOR_INSTANTIATE_CLASS(PairSearch)

}  // namespace rigor::engine
