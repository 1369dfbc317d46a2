// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Materials, the broad phase, and the list of contacts. Contacts keep their slot from step to step; only
// those that begin or end cost more than updating their points (contact_find.cpp). Rows: contact_rows.cpp;
// events: contact_events.cpp.
#include "engine/contacts/contact_set.hpp"

#include <algorithm>
#include <atomic>

namespace rigor::engine {
namespace {

/// End of a batch of n items in batches of `size`.
constexpr std::size_t endOf(std::size_t batch, std::size_t size, std::size_t n) {
    return std::min(size * (batch + 1), n);
}

constexpr std::size_t kShapeGrain = 64, kPairGrain = 16;  ///< worth a task: some microseconds of work

}  // namespace

template <class S>
PairCoefficients<S> ContactSet<S>::combine(const PairCoefficients<S>& a, const PairCoefficients<S>& b) const {
    PairCoefficients<S> both{combineFriction_(a.friction, b.friction),
                             combineRestitution_(a.restitution, b.restitution), Real(0)};
    if (a.staticFriction > 0 || b.staticFriction > 0)
        both.staticFriction = std::max(
            both.friction,
            combineFriction_(std::max(a.friction, a.staticFriction), std::max(b.friction, b.staticFriction)));
    return both;
}

template <class S>
std::uint32_t ContactSet<S>::addMaterial(const PairCoefficients<S>& own) {
    const std::uint32_t added = materialCount_++;
    materials_.push_back(own);
    std::vector<PairCoefficients<S>> table(materialCount_ * materialCount_);
    for (std::uint32_t a = 0; a < materialCount_; ++a)
        for (std::uint32_t b = 0; b < materialCount_; ++b) {
            if (a < added && b < added)
                table[a * materialCount_ + b] = pairs_[a * added + b];
            else
                table[a * materialCount_ + b] = combine(materials_[a], materials_[b]);
        }
    pairs_ = std::move(table);
    coefficientsValid_ = false;
    return added;
}

template <class S>
void ContactSet<S>::setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients) {
    pairs_[a * materialCount_ + b] = pairs_[b * materialCount_ + a] = coefficients;
    coefficientsValid_ = false;
}

template <class S>
void ContactSet<S>::structureChanged(bool indicesChanged) {
    boxesValid_ = candidatesValid_ = coefficientsValid_ = mayCollideHolds_ = false;
    fatBoxes_.reset();
    surfaces_.clear();
    for (std::uint32_t i = 0; i < shapes_.size(); ++i)
        if (isComposite<S>(shapes_[i].shape)) surfaces_.push_back(i);
    if (indicesChanged) {
        contacts_.clear();
        candidates_.clear();
        keys_.clear();
        removed_.clear();
    }
}

template <class S>
bool ContactSet<S>::mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    const BodyConstants<S>&A = bodies.constants[a], &B = bodies.constants[b];
    if (!A.collides || !B.collides) return false;
    if (A.type != BodyType::Dynamic && B.type != BodyType::Dynamic) return false;
    return excluded_.empty() || !std::binary_search(excluded_.begin(), excluded_.end(), pairKey(a, b));
}

template <class S>
void ContactSet<S>::findPairs(const BodyArrays<S>& bodies, BroadPhase<S>& broadPhase,
                              const ContactSearch<S>& search, const ContinuousCollision<S>& ccd,
                              const Tasks& tasks) {
    search_ = search;
    const std::size_t n = shapes_.size();
    shapePoses_.resize(n);
    boxes_.resize(n);
    movable_.resize(n);
    const Vec margin = Vec::Constant(search.speculativeDistance + search.cacheTolerance);
    tasks.forEach(n, kShapeGrain, [&](std::size_t i) {
        const ShapeRecord<S>& record = shapes_[i];
        const bool isStatic = bodies.constants[record.body].type == BodyType::Static;
        if (isStatic && boxesValid_) return;
        shapePoses_[i] = compose<S>(bodies.pose[record.body], record.local);
        boxes_[i] = boundingBox<S>(record.shape, shapePoses_[i]);
        movable_[i] = bodies.constants[record.body].type == BodyType::Dynamic;
        if (movable_[i]) {
            boxes_[i].min -= margin;
            boxes_[i].max += margin;
        }
        if (!isStatic && ccd.looksAhead()) ccd.growBox(static_cast<std::uint32_t>(i), boxes_[i]);
    });
    boxesValid_ = true;
    if (search.boxMargin == 0) {
        broadPhase.update(boxes_, movable_, proxyPairs_, tasks);
        pairCount_ = proxyPairs_.size();
        proxyPairsValid_ = true;
        return;
    }
    if (fatBoxes_.update(broadPhase, boxes_, movable_, search.boxMargin, tasks)) candidatesValid_ = false;
    std::atomic<std::size_t> count = 0;
    tasks.forRanges(fatBoxes_.pairs().size(), kPairGrain * 16, [&](std::size_t first, std::size_t last) {
        const auto pair = fatBoxes_.pairs().begin();
        count += static_cast<std::size_t>(
            std::count_if(pair + static_cast<std::ptrdiff_t>(first), pair + static_cast<std::ptrdiff_t>(last),
                          [this](const ProxyPair& p) { return boxes_[p.a].overlaps(boxes_[p.b]); }));
    });
    pairCount_ = count;
    proxyPairsValid_ = false;
}

template <class S>
const std::vector<ProxyPair>& ContactSet<S>::proxyPairs() const {
    if (!proxyPairsValid_) {
        proxyPairs_.clear();
        for (const ProxyPair& pair : fatBoxes_.pairs())
            if (boxes_[pair.a].overlaps(boxes_[pair.b])) proxyPairs_.push_back(pair);
        proxyPairsValid_ = true;
    }
    return proxyPairs_;
}

template <class S>
void ContactSet<S>::findManifolds(const BodyArrays<S>& bodies, const NarrowPhase<S>& narrowPhase,
                                  ManifoldFunction<S> makeManifold, const ContinuousCollision<S>& ccd,
                                  const Tasks& tasks) {
    const bool exact = search_.boxMargin == 0;
    if (!candidatesValid_ || candidatesHavePieces_ || (exact && candidatePairs_ != proxyPairs_))
        findCandidates(bodies, tasks);
    invalidateCacheOfOtherSearch();
    if (makeManifold == &manifoldClipped<S>) makeManifold = nullptr;
    const Search search{bodies, narrowPhase, makeManifold, ccd};
    // Each new contact takes the next element of begun_; those beyond its size are computed again later.
    std::atomic<std::uint32_t> taken = 0;
    const Tasks& those = narrowPhase.manyThreads() ? tasks : Tasks::one();
    const auto update = [&](Candidate& candidate) {
        candidate.found = candidate.queried = false;
        if (!exact && !boxes_[candidate.a].overlaps(boxes_[candidate.b])) {
            candidate.cached = false;  // as for a pair that the broad phase does not list
            return;
        }
        if (candidate.contact != kNullIndex) {
            candidate.found = updateContact(search, candidate, contacts_.at(candidate.contact));
            return;
        }
        if (isCacheValid(candidate) && !ccd.looksAhead()) return;
        if (const std::optional<Contact<S>> contact = findContact(search, candidate)) {
            candidate.found = true;
            candidate.begun = taken.fetch_add(1, std::memory_order_relaxed);
            if (candidate.begun < begun_.size()) begun_[candidate.begun] = *contact;
        }
    };
    outcomes_.resize(candidates_.size());
    counters_.resize((candidates_.size() + kBatch - 1) / kBatch);
    those.forEach(counters_.size(), 1, [&](std::size_t c) {
        Counters counters;
        for (std::size_t k = kBatch * c; k < endOf(c, kBatch, candidates_.size()); ++k) {
            constexpr std::size_t kPrefetch = 4;
            if (k + kPrefetch < candidates_.size() && candidates_[k + kPrefetch].contact != kNullIndex) {
                const Contact<S>& next = contacts_.at(candidates_[k + kPrefetch].contact);
                prefetch(&next, &next.impulses);
            }
            Candidate& candidate = candidates_[k];
            update(candidate);
            outcomes_[k] = {candidate.contact, candidate.found};
            counters.add(candidate.contact != kNullIndex, candidate.found, candidate.queried);
        }
        counters_[c] = counters;
    });
    commitContacts(search, tasks);
    coefficientsValid_ = true;
    if (begun_.size() < taken) begun_.resize(taken);
}

/// Removes the contacts that have ended and inserts the new ones.
template <class S>
void ContactSet<S>::commitContacts(const Search& search, const Tasks& tasks) {
    ended_.clear();
    Counters all;
    for (Counters& counters : counters_) {
        counters.first = all.found();
        all.add(counters);
    }
    queries_ = all.queried;
    if (all.persisting == contacts_.size() && all.begun == 0) return;

    for (const std::uint32_t slot : removed_) removeContact(slot);
    removed_.clear();
    for (std::size_t c = 0; c < counters_.size(); ++c)
        if (counters_[c].ended + counters_[c].begun > 0) changeContacts(search, c);
    std::sort(ended_.begin(), ended_.end(), [](const EndedContact& c, const EndedContact& d) {
        return std::pair(pairKey(c.shapeA, c.shapeB), c.piece) <
               std::pair(pairKey(d.shapeA, d.shapeB), d.piece);
    });
    contacts_.order().resize(all.found());
    tasks.forEach(counters_.size(), 1, [&](std::size_t c) { orderContacts(c); });
    if (!contacts_.fragmented()) return;
    contacts_.defragment(tasks);
    tasks.forEach(counters_.size(), 1, [&](std::size_t c) {
        std::uint32_t place = counters_[c].first;
        for (std::size_t k = kBatch * c; k < endOf(c, kBatch, candidates_.size()); ++k)
            if (candidates_[k].contact != kNullIndex) candidates_[k].contact = place++;
    });
}

/// In a batch of candidates: frees the slots of ended contacts and takes slots for new ones.
template <class S>
void ContactSet<S>::changeContacts(const Search& search, std::size_t batch) {
    for (std::size_t k = kBatch * batch; k < endOf(batch, kBatch, candidates_.size()); ++k) {
        const Outcome& outcome = outcomes_[k];
        if ((outcome.contact != kNullIndex) == outcome.found) continue;
        if (outcome.found) {
            addContact(search, candidates_[k]);
            continue;
        }
        removeContact(outcome.contact);
        candidates_[k].contact = kNullIndex;
    }
}

/// For a batch of candidates: writes the slots of their contacts in order, and the new contacts to their
/// slots.
template <class S>
void ContactSet<S>::orderContacts(std::size_t batch) {
    std::uint32_t* order = contacts_.order().data() + counters_[batch].first;
    for (std::size_t k = kBatch * batch; k < endOf(batch, kBatch, candidates_.size()); ++k) {
        if (!outcomes_[k].found) continue;
        const std::uint32_t had = outcomes_[k].contact;
        *order++ = had != kNullIndex ? had : candidates_[k].contact;
        if (had == kNullIndex && candidates_[k].begun < begun_.size())
            contacts_.at(candidates_[k].contact) = begun_[candidates_[k].begun];
    }
}

template <class S>
void ContactSet<S>::removeContact(std::uint32_t slot) {
    const Contact<S>& c = contacts_.at(slot);
    if (c.touching) ended_.push_back({c.bodyA, c.bodyB, c.shapeA, c.shapeB, c.piece});
    contacts_.remove(slot);
}

/// Takes a slot for a new contact; orderContacts copies it there from begun_.
template <class S>
void ContactSet<S>::addContact(const Search& search, Candidate& candidate) {
    const std::uint32_t slot = contacts_.add();
    if (candidate.begun >= begun_.size()) {
        candidate.cached = false;  // the manifold itself was not stored
        contacts_.at(slot) = findContact(search, candidate).value();
    }
    candidate.contact = slot;
}

template <class S>
bool ContactSet<S>::hasRows(std::uint32_t shapeA, std::uint32_t shapeB) const {
    const std::uint64_t key = pairKey(shapeA, shapeB);
    const std::vector<std::uint32_t>& order = contacts_.order();
    const auto first =
        std::lower_bound(order.begin(), order.end(), key, [&](std::uint32_t slot, std::uint64_t k) {
            return pairKey(contacts_.at(slot).shapeA, contacts_.at(slot).shapeB) < k;
        });
    if (first == order.end()) return false;
    const Contact<S>& found = contacts_.at(*first);
    if (pairKey(found.shapeA, found.shapeB) != key) return false;
    return std::any_of(found.block.begin(), found.block.begin() + found.manifold.count,
                       [](std::uint32_t block) { return block != kNullIndex; });
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
