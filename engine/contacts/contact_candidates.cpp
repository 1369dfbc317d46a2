// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Candidates: the pairs of shapes that may touch, made from the pairs of the broad phase.
//
//     broad phase pairs  (2,5)      (2,9)   (4,5)              sorted by pairKey
//     old candidates     (2,5)      (3,7)   (4,5)#0 (4,5)#3    sorted by pairKey, then by piece
//     new candidates     (2,5)kept  (2,9)   (4,5)#0 (4,5)#4    a merge; (3,7) and (4,5)#3 are removed
//
// Invariant: candidates are sorted as contacts are; a candidate that persists keeps its slot, its contact and
// its cached manifold. The candidates of chains, meshes and height fields are per piece and found anew in
// every step.
#include <algorithm>
#include <utility>

#include "engine/contacts/contact_set.hpp"
#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {

/// Merges the sorted pairs with the sorted candidates of the last step.
template <class S>
void ContactSet<S>::findCandidates(const BodyArrays<S>& bodies, const Tasks& tasks) {
    std::vector<std::uint32_t>& order = candidates_.order();
    std::swap(order, oldOrder_);
    std::swap(keys_, oldKeys_);
    const std::vector<ProxyPair>& pairs = pairsNear();
    order.clear();
    keys_.clear();
    const bool hadPieces = std::exchange(candidatesHavePieces_, false);
    std::size_t old = 0;
    const auto oldPiece = [&] { return hadPieces ? candidates_.at(oldOrder_[old]).piece : kNullIndex; };
    const auto removeOld = [&] {
        const std::uint32_t slot = oldOrder_[old++];
        if (const std::uint32_t contact = candidates_.at(slot).contact; contact != kNullIndex)
            removed_.push_back(contact);
        candidates_.remove(slot);
    };
    const auto put = [&](std::uint64_t key, std::uint32_t slot) {
        keys_.push_back(key);
        order.push_back(slot);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
        const std::uint64_t key = pairKey(a, b);
        const auto before = [&] { return std::pair(oldKeys_[old], oldPiece()) < std::pair(key, piece); };
        while (old < oldKeys_.size() && before()) removeOld();
        if (old < oldKeys_.size() && oldKeys_[old] == key && oldPiece() == piece)
            return put(key, oldOrder_[old++]);
        const std::uint32_t slot = candidates_.add();
        candidates_.at(slot) = makeCandidate(a, b, piece);
        put(key, slot);
    };
    // Keeps the longest run of pairs, from `first` on, that are the old candidates in the same order.
    const auto keepRun = [&](std::size_t first) {
        const std::size_t most = std::min(pairs.size() - first, oldKeys_.size() - old);
        std::size_t run = 0;
        while (run < most && oldKeys_[old + run] == pairKey(pairs[first + run].a, pairs[first + run].b))
            ++run;
        const auto from = static_cast<std::ptrdiff_t>(old), to = static_cast<std::ptrdiff_t>(old + run);
        keys_.insert(keys_.end(), oldKeys_.begin() + from, oldKeys_.begin() + to);
        order.insert(order.end(), oldOrder_.begin() + from, oldOrder_.begin() + to);
        old += run;
        return run;
    };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (mayCollideHolds_ && !hadPieces) k += keepRun(k);
        if (k == pairs.size()) break;
        const ProxyPair& p = pairs[k];
        const std::uint64_t key = pairKey(p.a, p.b);
        while (old < oldKeys_.size() && oldKeys_[old] < key) removeOld();
        if (mayCollideHolds_ && old < oldKeys_.size() && oldKeys_[old] == key && oldPiece() == kNullIndex) {
            put(key, oldOrder_[old++]);
            continue;
        }
        if (!mayCollide(bodies, shapes_[p.a].body, shapes_[p.b].body)) continue;
        const bool ordered = shapes_[p.a].body < shapes_[p.b].body;
        const std::uint32_t a = ordered ? p.a : p.b, b = ordered ? p.b : p.a;
        const bool surfaceA = isComposite<S>(shapes_[a].shape);
        if (!surfaceA && !isComposite<S>(shapes_[b].shape)) {
            add(a, b, kNullIndex);
            continue;
        }
        candidatesHavePieces_ = true;
        if (!boxes_[a].overlaps(boxes_[b])) continue;
        const std::uint32_t surface = surfaceA ? a : b, other = surfaceA ? b : a;
        findPieces(surface, other);
        const Vec middle = toWorld<S>(shapePoses_[other], shapes_[other].middle);
        const bool ridge =
            facesDiffer<S>(shapes_[surface].shape, pieces_, toLocal<S>(shapePoses_[surface], middle));
        for (const std::uint32_t piece : pieces_) {
            add(a, b, piece);
            candidates_.at(order.back()).ridge = ridge;
        }
    }
    while (old < oldKeys_.size()) removeOld();
    if (candidates_.fragmented()) candidates_.defragment(tasks);
    rememberPairs();
    candidatesValid_ = mayCollideHolds_ = true;
}

/// Pieces of a chain, mesh or height field near another shape, in ascending order.
template <class S>
void ContactSet<S>::findPieces(std::uint32_t surface, std::uint32_t other) {
    pieces_.clear();
    const Aabb<S> box = boxOnSurface<S>(shapePoses_[surface], shapes_[other].shape, shapePoses_[other],
                                        search_.speculativeDistance + search_.cacheTolerance);
    withSurface<S>(shapes_[surface].shape, [&](const auto& data) {
        data.query(box, [&](std::uint32_t piece) { pieces_.push_back(piece); });
    });
    std::sort(pieces_.begin(), pieces_.end());
}

/// Remembers the pairs of boxes without a margin, to be compared with those of the next step. Those of fat
/// AABBs report changes themselves (findPairs): an invalid pair stands for them.
template <class S>
void ContactSet<S>::rememberPairs() {
    if (search_.boxMargin == 0)
        candidatePairs_.assign(proxyPairs_.begin(), proxyPairs_.end());
    else
        candidatePairs_.assign(1, ProxyPair{});
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
