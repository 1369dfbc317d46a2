// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: collisions are resolved, resting is not: a contact that closes slower than 0.5 m/s "is no
// collision". Effect: gravity is never balanced. A body at rest falls into the floor until it is fast
// enough to collide, is stopped, and falls on: it sinks at about half of the threshold, and without position
// correction does not come back. Cure: a contact constraint is a constraint at every speed; thresholds are
// for restitution.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class NoRestingContact final : public Fault<S> {
  public:
    void contact(ContactRows<S>& contact) const override {
        if (contact.approach < typename S::Real(-0.5)) return;
        for (Row<S>& row : contact.rows) {
            row.invK = 0;
            row.impulse = 0;
            row.bias = row.relaxedBias = 0;
        }
        contact.block.friction = 0;
    }
};

}  // namespace

RIGOR_FAULT(faultNoRestingContact, NoRestingContact);

}  // namespace rigor::engine
