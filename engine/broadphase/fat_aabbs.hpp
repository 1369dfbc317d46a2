// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fat AABBs: boxes with a margin, so that the broad phase runs rarely.
//
//     +-----------------+
//     |   fat AABB      |    The fat AABB of a movable proxy is its box grown by a margin. It is replaced
//     |   +-----+       |    only when the box has left it, and only then does the broad phase run, on the
//     |   | box |->     |    fat AABBs: while bodies rest, an update is one pass over the boxes.
//     |   +-----+       |
//     +-----------------+
//
// The pairs are a superset of the pairs of the boxes. A caller that tests the boxes of each pair gets exactly
// the pairs that the broad phase would have found with the boxes, whatever the margin and earlier updates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

template <class S>
class FatAabbs {
  public:
    using Real = typename S::Real;

    /// Updates the fat AABBs and, if one was replaced, the pairs; true when the pairs have changed. `margin`
    /// >= 0: how much larger a new fat AABB is on each side, relative to the longest edge of the box. Boxes
    /// that are not movable or unbounded have no margin. A different number of boxes resets everything. Until
    /// reset() every call must have the same `broadPhase`, which must have no other user.
    bool update(BroadPhase<S>& broadPhase, std::span<const Aabb<S>> boxes,
                std::span<const std::uint8_t> movable, Real margin, const Tasks& tasks = Tasks::one());

    /// Sorted pairs of overlapping fat AABBs, without those of two proxies that are not movable.
    const std::vector<ProxyPair>& pairs() const { return pairs_; }
    const std::vector<Aabb<S>>& boxes() const { return fat_; }
    /// Fat AABBs replaced by the last update; 0: the broad phase did not run.
    std::size_t replaced() const { return replaced_; }

    /// Removes all boxes and pairs.
    void reset();

  private:
    std::vector<Aabb<S>> fat_;
    std::vector<std::uint8_t> movable_;
    std::vector<ProxyPair> pairs_, found_;
    std::size_t replaced_ = 0;
};

}  // namespace rigor::engine
