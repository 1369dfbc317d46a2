// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations by an explicit step in the body frame: w' = w - h I^-1 (w x I w). Order 1; gains energy
// and blows up for fast bodies.
#include "engine/integrators/integrator.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Ang predict(const BodyConstants<S>& body, const typename S::Rot& q, const typename S::Ang& w,
                        typename S::Real h) {
    if constexpr (S::dim == 2) {
        (void)body, (void)q, (void)h;
        return w;
    } else {
        using Vec = typename S::Vec;
        const Vec local = rotateInverse(q, w);
        const Vec torque = local.cross(Vec(body.inertia * local));
        const Vec change = inverseInertia<S>(body.inertia) * torque;
        return rotate(q, Vec(local - h * change));
    }
}

}  // namespace

template <class S>
RotationScheme<S> rotationExplicit() {
    return {&predict<S>, nullptr};
}
template RotationScheme<Space2f> rotationExplicit<Space2f>();
template RotationScheme<Space2d> rotationExplicit<Space2d>();
template RotationScheme<Space3f> rotationExplicit<Space3f>();
template RotationScheme<Space3d> rotationExplicit<Space3d>();

}  // namespace rigor::engine
