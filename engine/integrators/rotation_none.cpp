// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No gyroscopic term: without torque the angular velocity is constant in the world. Right for spheres and in
// 2D; wrong for every other body, whose angular momentum then turns with it. Several engines do so.
#include "engine/integrators/rotation.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Ang keep(const BodyConstants<S>&, const typename S::Rot&, const typename S::Ang& w,
                     typename S::Real) {
    return w;
}

}  // namespace

RotationTraits rotationNoneTraits() {
    return {.order = 0, .keepsEnergy = true, .inBlocks = true};
}

template <class S>
RotationScheme<S> rotationNone() {
    return {&keep<S>, nullptr, false};
}
RIGOR_INSTANTIATE_ROTATION(rotationNone);

}  // namespace rigor::engine
