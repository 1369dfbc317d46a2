// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: n = (xA - xB) / |xA - xB| where the solver expects A to B.
// Effect: the approach speed n . u changes sign, so that closing contacts look separating and get no
// impulse, and position correction pulls bodies together instead of pushing them apart: with a bias velocity
// beta s / h the overlap grows like (1 + beta)^k and the body leaves through the floor, ever faster. Cure:
// one convention, stated once, and a test of each pair against it.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class FlippedNormal final : public Fault<S> {
  public:
    void manifold(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, std::uint64_t,
                  Manifold<S>& manifold) const override {
        manifold.normal = -manifold.normal;
    }
};

}  // namespace

RIGOR_FAULT(faultFlippedNormal, FlippedNormal);

}  // namespace rigor::engine
