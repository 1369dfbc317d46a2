// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: v' = -e v at every touching contact, however slow, with a v that already holds this step's
// gravity. Effect: a resting body is thrown up with e g h in every step; it never comes to rest, stacks
// rattle apart. Cure: the approach speed from before this step's forces, and a threshold below which nothing
// bounces.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class RestitutionAtRest final : public Fault<S> {
  public:
    void contact(ContactRows<S>& contact) const override {
        // 5e-4 m: as near as the engine calls touching by default (WorldDef::gapSlop).
        const bool apart = contact.separation > typename S::Real(5e-4);
        if (contact.restitution <= 0 || contact.approach >= 0 || apart) return;
        contact.rows[0].bias = contact.rows[0].relaxedBias = contact.restitution * contact.approach;
    }
};

}  // namespace

RIGOR_FAULT(faultRestitutionAtRest, RestitutionAtRest);

}  // namespace rigor::engine
