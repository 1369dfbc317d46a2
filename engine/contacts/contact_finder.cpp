// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_finder.hpp"

#include <algorithm>
#include <atomic>

#include "engine/core/prefetch.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kBatch = 32;  ///< candidates

/// End of a batch of n candidates.
constexpr std::size_t endOf(std::size_t batch, std::size_t n) {
    return std::min(kBatch * (batch + 1), n);
}

}  // namespace

template <class S>
void ContactFinder<S>::run(const ContactUpdate<S>& update, bool exact, Candidates<S>& candidates,
                           ContactList<S>& contacts, const Tasks& tasks) {
    SlotList<Candidate<S>>& list = candidates.list();
    // Each new contact takes the next element of begun_.
    std::atomic<std::uint32_t> taken = 0;
    const Tasks& those = update.narrowPhase.manyThreads() ? tasks : Tasks::one();
    const bool looksAhead = update.ahead.looksAhead();
    const auto beginContact = [&](Candidate<S>& candidate) {
        if (const std::optional<Contact<S>> contact = update.find(candidate)) {
            candidate.found = true;
            candidate.begun = taken.fetch_add(1, std::memory_order_relaxed);
            begun_.put(candidate.begun, *contact);
        }
    };
    const auto updateAgain = [&](Candidate<S>& candidate) {
        candidate.queried = false;
        candidate.found = candidate.contact != kNullIndex;
        if (candidate.found)
            update.refresh(candidate, contacts.at(candidate.contact));
        else if (update.mayBegin(candidate))
            beginContact(candidate);
    };
    const auto updateCandidate = [&](Candidate<S>& candidate) {
        if (update.isSecond()) return updateAgain(candidate);
        candidate.found = candidate.queried = false;
        if (!exact && !update.shapes.box(candidate.a).overlaps(update.shapes.box(candidate.b))) {
            candidate.cached = false;  // treated like pairs that the broad phase does not list
            return;
        }
        if (candidate.contact != kNullIndex) {
            candidate.found = update.update(candidate, contacts.at(candidate.contact));
            return;
        }
        if (update.cache.isValid(candidate) && !looksAhead) return;
        beginContact(candidate);
    };
    outcomes_.resize(list.size());
    begun_.require(list.size());
    counters_.resize((list.size() + kBatch - 1) / kBatch);
    those.forEach(counters_.size(), 1, [&](std::size_t c) {
        Counters counters;
        for (std::size_t k = kBatch * c; k < endOf(c, list.size()); ++k) {
            constexpr std::size_t kPrefetch = 4;
            if (k + kPrefetch < list.size() && list[k + kPrefetch].contact != kNullIndex) {
                const Contact<S>& next = contacts.at(list[k + kPrefetch].contact);
                prefetch(&next, &next.impulses);
            }
            Candidate<S>& candidate = list[k];
            updateCandidate(candidate);
            outcomes_[k] = {candidate.contact, candidate.found};
            counters.add(candidate.contact != kNullIndex, candidate.found, candidate.queried);
        }
        counters_[c] = counters;
    });
    if (!update.isSecond()) {
        ended_.clear();
        queries_ = 0;
    }
    commit(candidates, contacts, tasks);
}

/// Removes the contacts that have ended and inserts the new ones.
template <class S>
void ContactFinder<S>::commit(Candidates<S>& candidates, ContactList<S>& contacts, const Tasks& tasks) {
    SlotList<Candidate<S>>& list = candidates.list();
    Counters all;
    for (Counters& counters : counters_) {
        counters.first = all.found();
        all.add(counters);
    }
    queries_ += all.queried;
    if (all.persisting == contacts.size() && all.begun == 0) return;

    contacts.reserve(all.begun);
    for (const std::uint32_t slot : candidates.orphans()) removeContact(contacts, slot);
    candidates.orphans().clear();
    for (std::size_t c = 0; c < counters_.size(); ++c)
        if (counters_[c].ended + counters_[c].begun > 0) changeContacts(list, contacts, c);
    std::sort(ended_.begin(), ended_.end(), [](const EndedContact& c, const EndedContact& d) {
        return std::pair(pairKey(c.shapeA, c.shapeB), c.piece) <
               std::pair(pairKey(d.shapeA, d.shapeB), d.piece);
    });
    contacts.order().resize(all.found());
    tasks.forEach(counters_.size(), 1, [&](std::size_t c) { orderContacts(list, contacts, c); });
    if (!contacts.fragmented()) return;
    contacts.defragment(tasks);
    tasks.forEach(counters_.size(), 1, [&](std::size_t c) {
        std::uint32_t place = counters_[c].first;
        for (std::size_t k = kBatch * c; k < endOf(c, list.size()); ++k)
            if (list[k].contact != kNullIndex) list[k].contact = place++;
    });
}

/// Frees the slots of ended contacts of a batch of candidates, and takes slots for new ones.
template <class S>
void ContactFinder<S>::changeContacts(SlotList<Candidate<S>>& candidates, ContactList<S>& contacts,
                                      std::size_t batch) {
    for (std::size_t k = kBatch * batch; k < endOf(batch, candidates.size()); ++k) {
        const Outcome& outcome = outcomes_[k];
        if ((outcome.contact != kNullIndex) == outcome.found) continue;
        if (outcome.found) {
            candidates[k].contact = contacts.add();  // orderContacts copies it there from begun_
            continue;
        }
        removeContact(contacts, outcome.contact);
        candidates[k].contact = kNullIndex;
    }
}

/// Writes the slots of a batch's contacts in the order of candidates, and the new contacts to their slots.
template <class S>
void ContactFinder<S>::orderContacts(const SlotList<Candidate<S>>& candidates, ContactList<S>& contacts,
                                     std::size_t batch) {
    std::uint32_t* order = contacts.order().data() + counters_[batch].first;
    for (std::size_t k = kBatch * batch; k < endOf(batch, candidates.size()); ++k) {
        if (!outcomes_[k].found) continue;
        const std::uint32_t had = outcomes_[k].contact;
        *order++ = had != kNullIndex ? had : candidates[k].contact;
        if (had == kNullIndex) contacts.at(candidates[k].contact) = begun_[candidates[k].begun];
    }
}

template <class S>
void ContactFinder<S>::removeContact(ContactList<S>& contacts, std::uint32_t slot) {
    const Contact<S>& c = contacts.at(slot);
    if (c.touching) ended_.push_back({c.bodyA, c.bodyB, c.shapeA, c.shapeB, c.piece});
    contacts.remove(slot);
}

RIGOR_INSTANTIATE_CLASS(ContactFinder)

}  // namespace rigor::engine
