// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/candidates.hpp"

#include <algorithm>
#include <utility>

#include "engine/contacts/contact_cache.hpp"
#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {
namespace {

/// The merge of sorted pairs with the sorted candidates of the last step: old candidates are passed in order,
/// and each is kept or removed.
template <class S>
class Merge {
  public:
    Merge(SlotList<Candidate<S>>& list, std::vector<std::uint64_t>& keys,
          const std::vector<std::uint32_t>& oldOrder, const std::vector<std::uint64_t>& oldKeys,
          std::vector<std::uint32_t>& orphans, bool hadPieces)
        : list_(list),
          order_(list.order()),
          keys_(keys),
          oldOrder_(oldOrder),
          oldKeys_(oldKeys),
          orphans_(orphans),
          hadPieces_(hadPieces) {}

    /// Removes the old candidates before a pair.
    void passBefore(std::uint64_t key) {
        while (old_ < oldKeys_.size() && oldKeys_[old_] < key) removeOld();
    }
    void passAll() {
        while (old_ < oldKeys_.size()) removeOld();
    }
    /// Keeps the next old candidate if it is this one.
    bool keep(std::uint64_t key, std::uint32_t piece) {
        if (old_ == oldKeys_.size() || oldKeys_[old_] != key || oldPiece() != piece) return false;
        put(key, oldOrder_[old_++]);
        return true;
    }
    /// Keeps the longest run of pairs, from `first` on, that are the old candidates in the same order, and
    /// returns its length.
    std::size_t keepRun(const std::vector<ProxyPair>& pairs, std::size_t first) {
        const std::size_t most = std::min(pairs.size() - first, oldKeys_.size() - old_);
        std::size_t run = 0;
        while (run < most && oldKeys_[old_ + run] == pairKey(pairs[first + run].a, pairs[first + run].b))
            ++run;
        const auto from = static_cast<std::ptrdiff_t>(old_), to = static_cast<std::ptrdiff_t>(old_ + run);
        keys_.insert(keys_.end(), oldKeys_.begin() + from, oldKeys_.begin() + to);
        order_.insert(order_.end(), oldOrder_.begin() + from, oldOrder_.begin() + to);
        old_ += run;
        return run;
    }
    /// The candidate of two shapes and a piece, old or new; those before it are removed.
    Candidate<S>& add(const ShapeSet<S>& shapes, std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
        const std::uint64_t key = pairKey(a, b);
        while (old_ < oldKeys_.size() && std::pair(oldKeys_[old_], oldPiece()) < std::pair(key, piece))
            removeOld();
        if (!keep(key, piece)) {
            const std::uint32_t slot = list_.add();
            list_.at(slot) = makeCandidate<S>(shapes, a, b, piece);
            put(key, slot);
        }
        return list_.at(order_.back());
    }

  private:
    std::uint32_t oldPiece() const { return hadPieces_ ? list_.at(oldOrder_[old_]).piece : kNullIndex; }
    void put(std::uint64_t key, std::uint32_t slot) {
        keys_.push_back(key);
        order_.push_back(slot);
    }
    void removeOld() {
        const std::uint32_t slot = oldOrder_[old_++];
        if (const std::uint32_t contact = list_.at(slot).contact; contact != kNullIndex)
            orphans_.push_back(contact);
        list_.remove(slot);
    }

    SlotList<Candidate<S>>& list_;
    std::vector<std::uint32_t>& order_;
    std::vector<std::uint64_t>& keys_;
    const std::vector<std::uint32_t>& oldOrder_;
    const std::vector<std::uint64_t>& oldKeys_;
    std::vector<std::uint32_t>& orphans_;
    const bool hadPieces_;
    std::size_t old_ = 0;  ///< the first of the old candidates that has not been passed
};

}  // namespace

template <class S>
void Candidates<S>::update(const BodyArrays<S>& bodies, const ShapeSet<S>& shapes,
                           const CollisionFilter<S>& filter, PairSearch<S>& pairs,
                           const ContactSearch<S>& search, const Tasks& tasks) {
    if (!valid_ || havePieces_ || pairs.changed()) {
        merge(bodies, shapes, filter, pairs.near(), search.speculativeDistance);
        if (list_.fragmented()) list_.defragment(tasks);
        pairs.take();
        valid_ = mayCollideHolds_ = true;
    }
    // A snapshot may come from a world with other settings.
    if (cachedSearch_.speculativeDistance != search.speculativeDistance ||
        cachedSearch_.cacheTolerance != search.cacheTolerance ||
        cachedSearch_.largeCacheTolerance != search.largeCacheTolerance)
        for (Candidate<S>& candidate : list_) candidate.cached = false;
    cachedSearch_ = search;
}

/// A piece of a surface is a candidate up to the distance that the narrow phase is queried with.
template <class S>
void Candidates<S>::merge(const BodyArrays<S>& bodies, const ShapeSet<S>& shapes,
                          const CollisionFilter<S>& filter, const std::vector<ProxyPair>& pairs,
                          Real speculativeDistance) {
    std::swap(list_.order(), oldOrder_);
    std::swap(keys_, oldKeys_);
    list_.order().clear();
    keys_.clear();
    const bool hadPieces = std::exchange(havePieces_, false);
    if (pairs.size() > oldKeys_.size()) list_.reserve(pairs.size() - oldKeys_.size());
    Merge<S> merge(list_, keys_, oldOrder_, oldKeys_, orphans_, hadPieces);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (mayCollideHolds_ && !hadPieces) k += merge.keepRun(pairs, k);
        if (k == pairs.size()) break;
        const ProxyPair& p = pairs[k];
        const std::uint64_t key = pairKey(p.a, p.b);
        merge.passBefore(key);
        if (mayCollideHolds_ && merge.keep(key, kNullIndex)) continue;
        if (!filter.mayCollide(bodies, shapes[p.a], shapes[p.b])) continue;
        const bool ordered = shapes[p.a].body < shapes[p.b].body;
        const std::uint32_t a = ordered ? p.a : p.b, b = ordered ? p.b : p.a;
        const bool surfaceA = isComposite<S>(shapes[a].shape);
        if (!surfaceA && !isComposite<S>(shapes[b].shape)) {
            merge.add(shapes, a, b, kNullIndex);
            continue;
        }
        havePieces_ = true;
        if (!shapes.box(a).overlaps(shapes.box(b))) continue;
        const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
        findPieces(
            shapes, surface, other,
            speculativeDistance + std::max(shapes.tolerance(a), shapes.tolerance(b)) + shapes.motion(a, b));
        const typename S::Vec middle = toWorld<S>(shapes.pose(other), shapes[other].middle);
        const bool ridge =
            facesDiffer<S>(shapes[surface].shape, pieces_, toLocal<S>(shapes.pose(surface), middle));
        for (const std::uint32_t piece : pieces_) merge.add(shapes, a, b, piece).ridge = ridge;
    }
    merge.passAll();
}

/// Names of the contacts that a chain, mesh or height field may have with a shape, in ascending order.
template <class S>
void Candidates<S>::findPieces(const ShapeSet<S>& shapes, std::uint32_t surface, std::uint32_t other,
                               Real distance) {
    pieces_.clear();
    const Aabb<S> box =
        boxOnSurface<S>(shapes.pose(surface), shapes[other].shape, shapes.pose(other), distance);
    addFacetNames<S>(shapes[surface].shape, box, pieces_);
}

template <class S>
void Candidates<S>::renumber(std::span<const std::uint32_t> newIndex) {
    std::vector<std::uint32_t>& order = list_.order();
    keys_.clear();
    std::size_t kept = 0;
    for (const std::uint32_t slot : order) {
        Candidate<S>& c = list_.at(slot);
        c.a = newIndex[c.a];
        c.b = newIndex[c.b];
        if (c.a == kNullIndex || c.b == kNullIndex) {
            list_.remove(slot);
            continue;
        }
        order[kept++] = slot;
        keys_.push_back(pairKey(c.a, c.b));
    }
    order.resize(kept);
    invalidate();
}

template <class S>
void Candidates<S>::orderBodies(const ShapeSet<S>& shapes) {
    for (Candidate<S>& c : list_) {
        if (shapes[c.a].body < shapes[c.b].body) continue;
        std::swap(c.a, c.b);
        c.byA = makeCandidate<S>(shapes, c.a, c.b, c.piece).byA;
        c.cached = false;
    }
}

template <class S>
void Candidates<S>::forgetCached(const ShapeSet<S>& shapes, std::uint32_t body) {
    for (Candidate<S>& c : list_)
        if (shapes[c.a].body == body || shapes[c.b].body == body) c.cached = false;
}

template <class S>
bool Candidates<S>::completeRestored(const ShapeSet<S>& shapes) {
    havePieces_ = false;
    keys_.clear();
    for (std::size_t k = 0; k < list_.size(); ++k) {
        Candidate<S>& c = list_[k];
        if (c.a >= shapes.size() || c.b >= shapes.size() || c.a == c.b) return false;
        const auto key = [](const Candidate<S>& x) { return std::pair(pairKey(x.a, x.b), x.piece); };
        if (k > 0 && key(list_[k - 1]) >= key(c)) return false;
        keys_.push_back(pairKey(c.a, c.b));
        havePieces_ = havePieces_ || c.piece != kNullIndex;
        const Candidate<S> made = makeCandidate<S>(shapes, c.a, c.b, c.piece);
        c.byA = made.byA;
        c.radius = made.radius;
    }
    return true;
}

RIGOR_INSTANTIATE_CLASS(Candidates)

}  // namespace rigor::engine
