// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of shapes whose boxes overlap, by a broad phase that runs on the boxes or, rarely, on fat AABBs.
//
//                       box margin 0                  box margin > 0
//     near()            the pairs of the boxes        the pairs of the fat AABBs, a superset
//     overlapping()     the same                      those of near() whose boxes overlap; made on demand
//     changed()         by comparing with the pairs   when a fat AABB has been replaced
//                       of the last take()
//
// Invariant: near() contains every pair of overlapping boxes, sorted, each once.
#pragma once

#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/broadphase/fat_aabbs.hpp"
#include "engine/contacts/shape_set.hpp"

namespace rigor::engine {

template <class S>
class PairSearch {
  public:
    using Real = typename S::Real;

    /// Updates the pairs to the current boxes of `shapes`; `boxMargin` is the setting of WorldDef.
    void update(const ShapeSet<S>& shapes, BroadPhase<S>& broadPhase, Real boxMargin, const Tasks& tasks);
    /// Must be called after shapes have changed.
    void reset() {
        fatBoxes_.reset();
        changed_ = true;
    }

    /// True if near() holds the pairs of overlapping boxes and no others.
    bool exact() const { return exact_; }
    const std::vector<ProxyPair>& near() const { return exact_ ? found_ : fatBoxes_.pairs(); }
    /// True if near() may have changed since the last take().
    bool changed() const { return changed_ || (exact_ && taken_ != found_); }
    void take();

    const std::vector<ProxyPair>& overlapping(const ShapeSet<S>& shapes) const;
    std::size_t count() const { return count_; }  ///< number of pairs of overlapping boxes
    /// Lets edit(pairs) change the pairs of the boxes (faults). Without a box margin.
    template <class Edit>
    void edit(const Edit& edit) {
        edit(found_);
        count_ = found_.size();
    }

  private:
    FatAabbs<S> fatBoxes_;
    mutable std::vector<ProxyPair> found_;
    mutable bool foundValid_ = true;
    std::vector<ProxyPair> taken_;
    std::size_t count_ = 0;
    bool exact_ = true, changed_ = true;
};

}  // namespace rigor::engine
