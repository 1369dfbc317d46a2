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
typename S::Rot turn(const typename S::Rot& q, const typename S::Ang& v) {
    return rotatedBy(q, v);
}

}  // namespace

OrientationTraits orientationExponentialMapTraits() {
    return {.exact = true, .inBlocks = true};
}

template <class S>
TurnRotation<S> orientationExponentialMap() {
    return &turn<S>;
}
template TurnRotation<Space2f> orientationExponentialMap<Space2f>();
template TurnRotation<Space2d> orientationExponentialMap<Space2d>();
template TurnRotation<Space3f> orientationExponentialMap<Space3f>();
template TurnRotation<Space3d> orientationExponentialMap<Space3d>();

}  // namespace rigor::engine
