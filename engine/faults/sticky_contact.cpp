// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: the impulse that makes the relative velocity zero is applied without a test of its sign.
// Effect: contacts pull as well as push; what touches once sticks: a body can be stopped but not lifted off.
// Cure: lambda_n >= 0, on the accumulated impulse.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class StickyContact final : public Fault<S> {
  public:
    using Real = typename S::Real;
    void solved(BodyArrays<S>& bodies, const ConstraintRows<S>& rows) const override {
        for (const Block<S>& block : rows.blocks) {
            if (block.kind != BlockKind::Contact) continue;
            const Row<S>& normal = rows.rows[block.first];
            Velocity<S>&a = bodies.velocity[block.a], &b = bodies.velocity[block.b];
            const Real apart = rowVelocity<S>(normal, a, b);
            if (apart > 0) applyRowImpulse<S>(normal, block, -apart * normal.invK, a, b);
        }
    }
};

}  // namespace

RIGOR_FAULT(faultStickyContact, StickyContact);

}  // namespace rigor::engine
