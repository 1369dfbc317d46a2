// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No gyroscopic term: without torque the angular velocity is constant in the world. Right for spheres and in
// the plane; wrong for every other body, whose angular momentum then turns with it. What several engines do.
#include "engine/integrators/integrator.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Ang keep(const BodyConstants<S>&, const typename S::Rot&, const typename S::Ang& w,
                     typename S::Real) {
    return w;
}

}  // namespace

template <class S>
RotationScheme<S> rotationNone() {
    return {&keep<S>, nullptr, false};
}
template RotationScheme<Space2f> rotationNone<Space2f>();
template RotationScheme<Space2d> rotationNone<Space2d>();
template RotationScheme<Space3f> rotationNone<Space3f>();
template RotationScheme<Space3d> rotationNone<Space3d>();

}  // namespace rigor::engine
