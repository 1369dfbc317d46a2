// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Which shapes may touch: from the pairs of the broad phase to candidates, which keep what is known of them.
#include <algorithm>
#include <atomic>

#include "engine/narrowphase/surface_contact.hpp"
#include "engine/pipeline/contact_set.hpp"

namespace rigor::engine {

/// In the order of contacts: by shape pair and piece. What is known of a candidate goes on.
template <class S>
void ContactSet<S>::findCandidates(const BodyArrays<S>& bodies, const Tasks& tasks) {
    if (tasks.threads() > 1 && mayHolds_ && !candidatesHavePieces_ && mergeCandidates(bodies, tasks)) return;
    std::swap(candidates_, oldCandidates_);
    candidates_.clear();
    candidatesHavePieces_ = false;
    auto old = oldCandidates_.begin();
    const auto end = oldCandidates_.end();
    const auto oldPair = [&] { return pairKey(old->a, old->b); };
    const auto drop = [&] {
        if (old->contact != kNone) dropped_.push_back(old->contact);
        ++old;
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
        const auto key = std::pair(pairKey(a, b), piece);
        while (old != end && std::pair(oldPair(), old->piece) < key) drop();
        const bool known = old != end && std::pair(oldPair(), old->piece) == key;
        candidates_.push_back(known ? *old++ : makeCandidate(a, b, piece));
    };
    const std::vector<ProxyPair>& pairs = pairsNear();
    for (const ProxyPair& p : pairs) {
        while (old != end && oldPair() < pairKey(p.a, p.b)) drop();
        if (mayHolds_ && old != end && old->piece == kNone && oldPair() == pairKey(p.a, p.b)) {
            candidates_.push_back(*old++);
            continue;
        }
        if (!mayCollide(bodies, shapes_[p.a].body, shapes_[p.b].body)) continue;
        const bool ordered = shapes_[p.a].body < shapes_[p.b].body;
        const std::uint32_t a = ordered ? p.a : p.b, b = ordered ? p.b : p.a;
        const bool surfaceA = isComposite<S>(shapes_[a].shape);
        if (!surfaceA && !isComposite<S>(shapes_[b].shape)) {
            add(a, b, kNone);
            continue;
        }
        candidatesHavePieces_ = true;
        if (!boxes_[a].overlaps(boxes_[b])) continue;
        findPieces(surfaceA ? a : b, surfaceA ? b : a);
        for (const std::uint32_t piece : pieces_) add(a, b, piece);
    }
    while (old != end) drop();
    rememberPairs();
    candidatesValid_ = mayHolds_ = true;
}

/// Pieces of a chain, mesh or height field near another shape, in ascending order.
template <class S>
void ContactSet<S>::findPieces(std::uint32_t surface, std::uint32_t other) {
    pieces_.clear();
    const Aabb<S> box = boxOnSurface<S>(shapePoses_[surface], shapes_[other].shape, shapePoses_[other],
                                        search_.speculativeDistance + search_.reuseDistance);
    withSurface<S>(shapes_[surface].shape, [&](const auto& data) {
        data.query(box, [&](std::uint32_t piece) { pieces_.push_back(piece); });
    });
    std::sort(pieces_.begin(), pieces_.end());
}

/// What findCandidates() does, by many threads, where no pair has pieces: parts of the pairs are merged with
/// the old candidates side by side, first to know how many candidates come of each, then to put them there.
/// False: there are pieces after all, and nothing has been done.
template <class S>
bool ContactSet<S>::mergeCandidates(const BodyArrays<S>& bodies, const Tasks& tasks) {
    constexpr std::size_t kPart = 512;
    const std::vector<ProxyPair>& pairs = pairsNear();
    const std::size_t parts = (pairs.size() + kPart - 1) / kPart;
    if (parts < 2) return false;
    merges_.resize(parts);
    sources_.resize(pairs.size());
    dropped_.reserve(candidates_.capacity());  // their number goes up and down
    dropped_.resize(candidates_.size());
    std::atomic<bool> pieces = false;
    tasks.forEach(parts, 1, [&](std::size_t c) {
        Merge& merge = merges_[c];
        merge.begin = kPart * c, merge.end = std::min(kPart * (c + 1), pairs.size());
        merge.old = c == 0 ? 0 : oldAt(pairs[merge.begin]);
        merge.oldEnd = c + 1 == parts ? candidates_.size() : oldAt(pairs[merge.end]);
        if (!planMerge(bodies, merge)) pieces = true;
    });
    if (pieces) {
        dropped_.clear();
        return false;
    }
    std::size_t count = 0, dropped = 0;
    for (Merge& merge : merges_) {
        merge.first = count, count += merge.count;
        for (std::size_t k = 0; k < merge.dropped; ++k) dropped_[dropped++] = dropped_[merge.old + k];
    }
    dropped_.resize(dropped);
    std::swap(candidates_, oldCandidates_);
    candidates_.resize(count);
    tasks.forEach(parts, 1, [&](std::size_t c) {
        Candidate* to = candidates_.data() + merges_[c].first;
        for (std::size_t k = merges_[c].begin; k < merges_[c].end; ++k) {
            if (sources_[k] == kNobody) continue;
            *to++ = sources_[k] == kNone ? makeCandidate(pairs[k]) : oldCandidates_[sources_[k]];
        }
    });
    rememberPairs();
    candidatesValid_ = true;
    return true;
}

/// The first old candidate that is not before a pair.
template <class S>
std::size_t ContactSet<S>::oldAt(const ProxyPair& pair) const {
    const auto at = std::lower_bound(candidates_.begin(), candidates_.end(), pairKey(pair.a, pair.b),
                                     [](const Candidate& candidate, std::uint64_t key) {
                                         return pairKey(candidate.a, candidate.b) < key;
                                     });
    return static_cast<std::size_t>(at - candidates_.begin());
}

/// Where the candidates of a part of the pairs come from, how many they are, and whose contacts are dropped:
/// those go to the part's own place in dropped_. False: some have pieces.
template <class S>
bool ContactSet<S>::planMerge(const BodyArrays<S>& bodies, Merge& merge) {
    const std::vector<ProxyPair>& pairs = pairsNear();
    merge.count = merge.dropped = 0;
    std::size_t old = merge.old;
    const auto drop = [&] {
        if (const std::uint32_t slot = candidates_[old++].contact; slot != kNone)
            dropped_[merge.old + merge.dropped++] = slot;
    };
    for (std::size_t k = merge.begin; k < merge.end; ++k) {
        const std::uint64_t key = pairKey(pairs[k].a, pairs[k].b);
        while (old < merge.oldEnd && pairKey(candidates_[old].a, candidates_[old].b) < key) drop();
        if (old < merge.oldEnd && pairKey(candidates_[old].a, candidates_[old].b) == key) {
            sources_[k] = static_cast<std::uint32_t>(old++);
        } else if (mayCollide(bodies, shapes_[pairs[k].a].body, shapes_[pairs[k].b].body)) {
            if (isComposite<S>(shapes_[pairs[k].a].shape) || isComposite<S>(shapes_[pairs[k].b].shape))
                return false;
            sources_[k] = kNone;
        } else {
            sources_[k] = kNobody;
            continue;
        }
        ++merge.count;
    }
    while (old < merge.oldEnd) drop();
    return true;
}

/// Of two shapes without pieces.
template <class S>
typename ContactSet<S>::Candidate ContactSet<S>::makeCandidate(const ProxyPair& pair) const {
    const bool ordered = shapes_[pair.a].body < shapes_[pair.b].body;
    return ordered ? makeCandidate(pair.a, pair.b, kNone) : makeCandidate(pair.b, pair.a, kNone);
}

/// Pairs that were found exactly are compared with the next ones; those of enlarged boxes are known to be the
/// same by themselves (findPairs), and a list of no other pairs stands for them.
template <class S>
void ContactSet<S>::rememberPairs() {
    if (search_.boxMargin == 0)
        candidatePairs_.assign(proxyPairs_.begin(), proxyPairs_.end());
    else
        candidatePairs_.assign(1, ProxyPair{});
}

template class ContactSet<Space2f>;
template class ContactSet<Space2d>;
template class ContactSet<Space3f>;
template class ContactSet<Space3d>;

}  // namespace rigor::engine
