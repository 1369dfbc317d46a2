// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Which shapes may touch, and the list of those that do: contacts stay where they are from step to step, and
// only those that are new or gone cost more than finding their points (contact_find.cpp). Rows:
// contact_rows.cpp; events: contact_events.cpp.
#include "engine/pipeline/contact_set.hpp"

#include <algorithm>
#include <atomic>

namespace rigor::engine {
namespace {

/// Of a part of n things that are taken `size` at a time.
constexpr std::size_t endOf(std::size_t part, std::size_t size, std::size_t n) {
    return std::min(size * (part + 1), n);
}

constexpr std::size_t kShapeGrain = 64, kPairGrain = 16;  ///< worth sharing: some microseconds of work

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
    coefficientsHold_ = false;
    return added;
}

template <class S>
void ContactSet<S>::setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients) {
    pairs_[a * materialCount_ + b] = pairs_[b * materialCount_ + a] = coefficients;
    coefficientsHold_ = false;
}

template <class S>
void ContactSet<S>::structureChanged(bool indicesChanged) {
    boxesValid_ = candidatesValid_ = coefficientsHold_ = mayHolds_ = false;
    enlarged_.reset();
    surfaces_.clear();
    for (std::uint32_t i = 0; i < shapes_.size(); ++i)
        if (isComposite<S>(shapes_[i].shape)) surfaces_.push_back(i);
    if (indicesChanged) {
        contacts_.clear();
        candidates_.clear();
        keys_.clear();
        dropped_.clear();
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
    const Vec margin = Vec::Constant(search.speculativeDistance + search.reuseDistance);
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
        proxyPairsHold_ = true;
        return;
    }
    if (enlarged_.update(broadPhase, boxes_, movable_, search.boxMargin, tasks)) candidatesValid_ = false;
    std::atomic<std::size_t> count = 0;
    tasks.forRanges(enlarged_.pairs().size(), kPairGrain * 16, [&](std::size_t first, std::size_t last) {
        const auto pair = enlarged_.pairs().begin();
        count += static_cast<std::size_t>(
            std::count_if(pair + static_cast<std::ptrdiff_t>(first), pair + static_cast<std::ptrdiff_t>(last),
                          [this](const ProxyPair& p) { return boxes_[p.a].overlaps(boxes_[p.b]); }));
    });
    pairCount_ = count;
    proxyPairsHold_ = false;
}

template <class S>
const std::vector<ProxyPair>& ContactSet<S>::proxyPairs() const {
    if (!proxyPairsHold_) {
        proxyPairs_.clear();
        for (const ProxyPair& pair : enlarged_.pairs())
            if (boxes_[pair.a].overlaps(boxes_[pair.b])) proxyPairs_.push_back(pair);
        proxyPairsHold_ = true;
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
    forgetOtherAnswers();
    if (makeManifold == &manifoldClipped<S>) makeManifold = nullptr;
    const Search search{bodies, narrowPhase, makeManifold, ccd};
    // New contacts take the next free place in fresh_; those that it has no room for are found once more.
    std::atomic<std::uint32_t> taken = 0;
    const Tasks& those = narrowPhase.manyThreads() ? tasks : Tasks::one();
    const auto look = [&](Candidate& candidate) {
        candidate.found = candidate.asked = false;
        if (!exact && !boxes_[candidate.a].overlaps(boxes_[candidate.b])) {
            candidate.kept = false;  // as if the pair had not been listed
            return;
        }
        if (candidate.contact != kNullIndex) {
            candidate.found = renewContact(search, candidate, contacts_.at(candidate.contact));
            return;
        }
        if (stillValid(candidate) && !ccd.looksAhead()) return;
        if (const std::optional<Contact<S>> contact = findContact(search, candidate)) {
            candidate.found = true;
            candidate.fresh = taken.fetch_add(1, std::memory_order_relaxed);
            if (candidate.fresh < fresh_.size()) fresh_[candidate.fresh] = *contact;
        }
    };
    outcomes_.resize(candidates_.size());
    tallies_.resize((candidates_.size() + kTally - 1) / kTally);
    those.forEach(tallies_.size(), 1, [&](std::size_t c) {
        Tally tally;
        for (std::size_t k = kTally * c; k < endOf(c, kTally, candidates_.size()); ++k) {
            constexpr std::size_t kAhead = 4;
            if (k + kAhead < candidates_.size() && candidates_[k + kAhead].contact != kNullIndex) {
                const Contact<S>& next = contacts_.at(candidates_[k + kAhead].contact);
                prefetch(&next, &next.impulses);
            }
            Candidate& candidate = candidates_[k];
            look(candidate);
            outcomes_[k] = {candidate.contact, candidate.found};
            tally.add(candidate.contact != kNullIndex, candidate.found, candidate.asked);
        }
        tallies_[c] = tally;
    });
    settle(search, tasks);
    coefficientsHold_ = true;
    if (fresh_.size() < taken) fresh_.resize(taken);
}

/// Contacts that are gone leave, new ones come in.
template <class S>
void ContactSet<S>::settle(const Search& search, const Tasks& tasks) {
    gone_.clear();
    Tally all;
    for (Tally& tally : tallies_) {
        tally.first = all.found();
        all.add(tally);
    }
    asked_ = all.asked;
    if (all.kept == contacts_.size() && all.fresh == 0) return;

    for (const std::uint32_t slot : dropped_) removeContact(slot);
    dropped_.clear();
    for (std::size_t c = 0; c < tallies_.size(); ++c)
        if (tallies_[c].lost + tallies_[c].fresh > 0) changeContacts(search, c);
    std::sort(gone_.begin(), gone_.end(), [](const Gone& c, const Gone& d) {
        return std::pair(pairKey(c.shapeA, c.shapeB), c.piece) <
               std::pair(pairKey(d.shapeA, d.shapeB), d.piece);
    });
    contacts_.order().resize(all.found());
    tasks.forEach(tallies_.size(), 1, [&](std::size_t c) { orderContacts(c); });
    if (!contacts_.untidy()) return;
    contacts_.tidy(tasks);
    tasks.forEach(tallies_.size(), 1, [&](std::size_t c) {
        std::uint32_t place = tallies_[c].first;
        for (std::size_t k = kTally * c; k < endOf(c, kTally, candidates_.size()); ++k)
            if (candidates_[k].contact != kNullIndex) candidates_[k].contact = place++;
    });
}

/// Of a part of the candidates: slots are given back, and taken by those that have none.
template <class S>
void ContactSet<S>::changeContacts(const Search& search, std::size_t part) {
    for (std::size_t k = kTally * part; k < endOf(part, kTally, candidates_.size()); ++k) {
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

/// Of a part of the candidates: the slots of their contacts, in order; those that are new come there.
template <class S>
void ContactSet<S>::orderContacts(std::size_t part) {
    std::uint32_t* order = contacts_.order().data() + tallies_[part].first;
    for (std::size_t k = kTally * part; k < endOf(part, kTally, candidates_.size()); ++k) {
        if (!outcomes_[k].found) continue;
        const std::uint32_t had = outcomes_[k].contact;
        *order++ = had != kNullIndex ? had : candidates_[k].contact;
        if (had == kNullIndex && candidates_[k].fresh < fresh_.size())
            contacts_.at(candidates_[k].contact) = fresh_[candidates_[k].fresh];
    }
}

template <class S>
void ContactSet<S>::removeContact(std::uint32_t slot) {
    const Contact<S>& c = contacts_.at(slot);
    if (c.touching) gone_.push_back({c.bodyA, c.bodyB, c.shapeA, c.shapeB, c.piece});
    contacts_.remove(slot);
}

/// A slot for what was found for a candidate that had none; fresh_ is copied into it later.
template <class S>
void ContactSet<S>::addContact(const Search& search, Candidate& candidate) {
    const std::uint32_t slot = contacts_.add();
    if (candidate.fresh >= fresh_.size()) {
        candidate.kept = false;  // that there is something is kept, not what
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
