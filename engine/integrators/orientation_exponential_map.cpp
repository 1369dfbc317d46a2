// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// q := exp(v) q, the rotation by |v| about v: exact where the angular velocity is constant during the step
// [HairerLubichWanner2006, section IV.8]. Without libm, see math/rotation.hpp. About 40 flops more than
// first_order.
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Rot turnByExponential(const typename S::Rot& q, const typename S::Ang& v) {
    return rotatedBy(q, v);
}

}  // namespace

OrientationTraits orientationExponentialMapTraits() {
    return {.exact = true, .inBlocks = true};
}

template <class S>
TurnRotation<S> orientationExponentialMap() {
    return &turnByExponential<S>;
}
#define RIGOR_INSTANTIATE(S) template TurnRotation<S> orientationExponentialMap<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
