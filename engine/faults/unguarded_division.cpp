// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: the normal of two spheres is d / |d| with d = xB - xA, without a test for d = 0.
// Effect: coincident centres (a spawner that puts two bodies in one place) give 0 / 0; the NaN is in
// the impulse, the velocities and, a step later, in the whole scene. Cure: below rounding any unit vector is
// as good as any other; take one.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class UnguardedDivision final : public Fault<S> {
  public:
    void manifold(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb, std::uint64_t,
                  Manifold<S>& manifold) const override {
        const auto *A = std::get_if<Sphere<S>>(&a), *B = std::get_if<Sphere<S>>(&b);
        if (A == nullptr || B == nullptr) return;
        const typename S::Vec d = Xb.p - Xa.p;
        manifold.normal = d / d.norm();
        manifold.points[0].pointA = Xa.p + A->radius * manifold.normal;
        manifold.points[0].pointB = Xb.p - B->radius * manifold.normal;
    }
};

}  // namespace

RIGOR_FAULT(faultUnguardedDivision, UnguardedDivision);

}  // namespace rigor::engine
