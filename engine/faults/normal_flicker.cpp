// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: of two separating axes that are nearly as good, the one that wins by rounding is taken, and
// another one in the next step. Here every normal is tipped by 0.1 rad to one side in even steps and to the
// other in odd ones. Effect: the impulse that carries a resting body gets a sideways part of a tenth of
// m g h that changes its sign from step to step; where friction does not hold it the body shakes, and the
// impulses kept for warm starting belong to another normal. Cure: an axis is left only for one that is better
// by more than a tolerance.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class NormalFlicker final : public Fault<S> {
  public:
    using Real = typename S::Real;
    void manifold(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, std::uint64_t step,
                  Manifold<S>& manifold) const override {
        typename S::Vec& n = manifold.normal;
        typename S::Vec side;
        if constexpr (S::dim == 2)
            side = {-n.y(), n.x()};
        else
            side = (std::abs(n.x()) < Real(0.7) ? S::Vec::Unit(0) : S::Vec::Unit(1)).cross(n).normalized();
        n = (n + (step % 2 == 0 ? Real(0.1) : Real(-0.1)) * side).normalized();
    }
};

}  // namespace

RIGOR_FAULT(faultNormalFlicker, NormalFlicker);

}  // namespace rigor::engine
