// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/broadphase/enlarged_boxes.hpp"

#include <atomic>

#include "engine/broadphase/box_tools.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBoxGrain = 128;  ///< worth sharing: some microseconds of work

template <class S>
Aabb<S> enlarged(const Aabb<S>& box, bool movable, typename S::Real margin) {
    if (!movable || BroadPhase<S>::unbounded(box)) return box;
    const typename S::Vec m = S::Vec::Constant(margin * longestEdge<S>(box));
    return {box.min - m, box.max + m};
}

}  // namespace

template <class S>
bool EnlargedBoxes<S>::update(BroadPhase<S>& broadPhase, std::span<const Aabb<S>> boxes,
                              std::span<const std::uint8_t> movable, Real margin, const Tasks& tasks) {
    const bool afresh = boxes.size() != enlarged_.size();
    if (afresh) {
        enlarged_.resize(boxes.size());
        movable_.assign(movable.begin(), movable.end());
    }
    std::atomic<std::size_t> made = 0;
    tasks.forRanges(boxes.size(), kBoxGrain, [&](std::size_t first, std::size_t last) {
        std::size_t here = 0;
        for (std::size_t i = first; i < last; ++i) {
            // With a margin far below the box's rounding the test holds by equality. What is not a number is
            // in no box and made anew in every update.
            if (!afresh && movable[i] == movable_[i] && enlarged_[i].contains(boxes[i])) continue;
            enlarged_[i] = enlarged<S>(boxes[i], movable[i] != 0, margin);
            movable_[i] = movable[i];
            ++here;
        }
        made += here;
    });
    made_ = made;
    if (made_ == 0) return false;
    broadPhase.update(enlarged_, movable_, found_, tasks);
    if (found_ == pairs_) return false;
    std::swap(pairs_, found_);
    return true;
}

template <class S>
void EnlargedBoxes<S>::reset() {
    enlarged_.clear();
    movable_.clear();
    pairs_.clear();
    made_ = 0;
}

RIGOR_INSTANTIATE_CLASS(EnlargedBoxes)

}  // namespace rigor::engine
