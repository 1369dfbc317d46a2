// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The narrow phase of all candidates, and what it does to the list of contacts. Contacts keep their slot from
// step to step; only those that begin or end cost more than updating their points.
//
//     candidates   c0  c1  c2  c3 | c4  c5 ...     in batches, which threads share
//     outcomes     +   -   .   + ! | ...           + has a contact still, ! a new one, - has one no more
//     counters     2 persisting, 1 ended, 1 begun | ...
//
// With the counters of the batches before it a batch knows the places of its contacts in the new order of the
// list, and writes them there. New contacts wait in `begun_`, in any order, until they have a slot.
//
// Invariant, after run(): the list is sorted by shape pair and piece, and candidate.contact is the slot of the
// candidate's contact.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/contacts/contact_update.hpp"
#include "engine/core/large_vector.hpp"

namespace rigor::engine {

/// Keys of a contact that touched in the last step and has been removed.
struct EndedContact {
    std::uint32_t bodyA, bodyB, shapeA, shapeB, piece;
};

template <class S>
class ContactFinder {
  public:
    /// `exact`: the boxes of all candidates overlap.
    void run(const ContactUpdate<S>& update, bool exact, Candidates<S>& candidates, ContactList<S>& contacts,
             const Tasks& tasks);
    /// Narrow-phase queries of the last step.
    std::size_t queries() const { return queries_; }
    /// Ended contacts in the order of the list.
    const std::vector<EndedContact>& ended() const { return ended_; }

  private:
    /// Result of a candidate in this step, in an array of its own for cache efficiency.
    struct Outcome {
        std::uint32_t contact = kNullIndex;  ///< slot of its contact in the last step
        bool found = false;
    };
    /// Counters of a batch of candidates in this step.
    struct Counters {
        std::uint32_t persisting = 0, ended = 0, begun = 0;  ///< contacts
        std::uint32_t queried = 0;                           ///< narrow-phase queries
        std::uint32_t first = 0;                             ///< index of the batch's first contact
        std::uint32_t found() const { return persisting + begun; }
        void add(bool had, bool has, bool wasQueried) {
            persisting += had && has;
            ended += had && !has;
            begun += !had && has;
            queried += wasQueried;
        }
        void add(const Counters& other) {
            persisting += other.persisting;
            ended += other.ended;
            begun += other.begun;
            queried += other.queried;
        }
    };

    void commit(Candidates<S>& candidates, ContactList<S>& contacts, const Tasks& tasks);
    void changeContacts(SlotList<Candidate<S>>& candidates, ContactList<S>& contacts, std::size_t batch);
    void orderContacts(const SlotList<Candidate<S>>& candidates, ContactList<S>& contacts, std::size_t batch);
    void removeContact(ContactList<S>& contacts, std::uint32_t slot);

    std::vector<Outcome> outcomes_;   ///< outcome of each candidate
    std::vector<Counters> counters_;  ///< counters of each batch of candidates
    LargeScratch<Contact<S>> begun_;  ///< new contacts of this step
    std::vector<EndedContact> ended_;
    std::size_t queries_ = 0;
};

}  // namespace rigor::engine
