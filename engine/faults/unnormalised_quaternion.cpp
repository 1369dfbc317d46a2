// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: q := q + h/2 (0, w) q and nothing after it.
// Effect: each step multiplies |q| by sqrt(1 + (h |w| / 2)^2) (2D, cosine and sine: sqrt(1 + (h w)^2));
// the matrix of q is no rotation any more, shapes are distorted and inertia tensors with them, and a spinning
// body gains energy at every contact. Cure: the exponential map, or at least q / |q| after every step.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class UnnormalisedQuaternion final : public Fault<S> {
  public:
    using Real = typename S::Real;
    void moved(BodyArrays<S>& bodies, std::span<const typename S::Rot> start,
               typename S::Real h) const override {
        for (std::size_t i = 0; i < bodies.size() && i < start.size(); ++i) {
            if (bodies.constants[i].type != BodyType::Dynamic) continue;
            const typename S::Rot& q = start[i];
            const typename S::Ang& w = bodies.velocity[i].w;
            if constexpr (S::dim == 2) {
                bodies.pose[i].q = {q.c - h * w * q.s, q.s + h * w * q.c};
            } else {
                const typename S::Rot rate(Real(0), w.x(), w.y(), w.z());
                bodies.pose[i].q.coeffs() = q.coeffs() + Real(0.5) * h * (rate * q).coeffs();
            }
        }
    }
};

}  // namespace

RIGOR_FAULT(faultUnnormalisedQuaternion, UnnormalisedQuaternion);

}  // namespace rigor::engine
