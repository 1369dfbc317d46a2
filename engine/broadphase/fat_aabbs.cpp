// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/broadphase/fat_aabbs.hpp"

#include <atomic>

#include "engine/broadphase/box_tools.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBoxGrain = 128;  ///< least number of boxes for a task: some microseconds of work

template <class S>
Aabb<S> fatAabb(const Aabb<S>& box, bool movable, typename S::Real margin) {
    if (!movable || BroadPhase<S>::unbounded(box)) return box;
    const typename S::Vec m = S::Vec::Constant(margin * longestEdge<S>(box));
    return {box.min - m, box.max + m};
}

}  // namespace

template <class S>
bool FatAabbs<S>::update(BroadPhase<S>& broadPhase, std::span<const Aabb<S>> boxes,
                         std::span<const std::uint8_t> movable, Real margin, const Tasks& tasks) {
    const bool resized = boxes.size() != fat_.size();
    if (resized) {
        fat_.resize(boxes.size());
        movable_.assign(movable.begin(), movable.end());
    }
    std::atomic<std::size_t> replaced = 0;
    tasks.forRanges(boxes.size(), kBoxGrain, [&](std::size_t first, std::size_t last) {
        std::size_t here = 0;
        for (std::size_t i = first; i < last; ++i) {
            // If the margin is far below the rounding of the box's coordinates, the test holds by equality. A
            // box with a NaN is in no box and is replaced in every update.
            if (!resized && movable[i] == movable_[i] && fat_[i].contains(boxes[i])) continue;
            fat_[i] = fatAabb<S>(boxes[i], movable[i] != 0, margin);
            movable_[i] = movable[i];
            ++here;
        }
        replaced += here;
    });
    replaced_ = replaced;
    if (replaced_ == 0) return false;
    broadPhase.update(fat_, movable_, found_, tasks);
    if (found_ == pairs_) return false;
    std::swap(pairs_, found_);
    return true;
}

template <class S>
void FatAabbs<S>::reset() {
    fat_.clear();
    movable_.clear();
    pairs_.clear();
    replaced_ = 0;
}

RIGOR_INSTANTIATE_CLASS(FatAabbs)

}  // namespace rigor::engine
