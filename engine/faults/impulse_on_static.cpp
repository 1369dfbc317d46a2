// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: a static body has no infinite mass but that of the body it collides with, and the impulse is
// shared. Effect: with 1/m + 1/m in the effective mass a contact stops half of the approach and passes the
// other half to the floor, which is then pushed away: the floor falls with what stands on it at g/2. Cure:
// inverse mass and inverse inertia of a static body are zero, everywhere.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class ImpulseOnStatic final : public Fault<S> {
  public:
    void contact(ContactRows<S>& contact) const override {
        Block<S>& block = contact.block;
        if (block.invMassA == 0) block.invMassA = block.invMassB;
        if (block.invMassB == 0) block.invMassB = block.invMassA;
        for (Row<S>& row : contact.rows) row.invK = typename S::Real(1) / rowK<S>(row, block);
        if (contact.rows.size() < 2) return;
        const Row<S>&t1 = contact.rows[1], &t2 = contact.rows.back();
        block.k11 = rowCoupling<S>(t1, t1, block);
        if (contact.rows.size() < 3) return;
        block.k12 = rowCoupling<S>(t1, t2, block);
        block.k22 = rowCoupling<S>(t2, t2, block);
    }
    void moved(BodyArrays<S>& bodies, std::span<const typename S::Rot>, typename S::Real h) const override {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (bodies.constants[i].type == BodyType::Static) bodies.pose[i].p += h * bodies.velocity[i].v;
    }
    bool movesStatics() const override { return true; }
};

}  // namespace

RIGOR_FAULT(faultImpulseOnStatic, ImpulseOnStatic);

}  // namespace rigor::engine
