// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of enlarged boxes: what changes rarely.
//
// Each movable proxy has an enlarged box, its own box grown by a margin when it was last made. It is made
// anew only when the proxy's box has left it, and only then is a broad phase asked, with the enlarged boxes:
// while bodies rest, an update is one pass over the boxes. The pairs are a superset of those of the boxes
// themselves; who tests the boxes of each pair has exactly the pairs that the broad phase would have found
// with them, whatever the margin and the updates before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

template <class S>
class EnlargedBoxes {
  public:
    using Real = typename S::Real;

    /// Takes in where the boxes are. `margin` >= 0: by how much a new enlarged box is larger on each side, as
    /// a share of the longest edge; boxes that are not movable, and those without bounds, stay as they are.
    /// Another count of boxes starts afresh. True when pairs() are not what they were before. The same
    /// `broadPhase` in every call, and in no other use, until reset().
    bool update(BroadPhase<S>& broadPhase, std::span<const Aabb<S>> boxes,
                std::span<const std::uint8_t> movable, Real margin, const Tasks& tasks = Tasks::one());

    /// Pairs of enlarged boxes that overlap, sorted, without those of two proxies that are not movable.
    const std::vector<ProxyPair>& pairs() const { return pairs_; }
    const std::vector<Aabb<S>>& boxes() const { return enlarged_; }
    /// Enlarged boxes made in the last update: 0 means that the broad phase was not asked.
    std::size_t made() const { return made_; }

    /// Forgets everything; pairs() are empty.
    void reset();

  private:
    std::vector<Aabb<S>> enlarged_;
    std::vector<std::uint8_t> movable_;
    std::vector<ProxyPair> pairs_, found_;
    std::size_t made_ = 0;
};

}  // namespace rigor::engine
