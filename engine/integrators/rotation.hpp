// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions shared by the files of the family `rotation`. A law of free rotation is written in the body
// frame, and for 3D alone; in 2D there is nothing to do.
#pragma once

#include <limits>

#include "engine/integrators/integrator.hpp"

namespace rigor::engine {

/// [a]x: skew(a) b = a x b.
template <class R>
Eigen::Matrix<R, 3, 3> skew(const Eigen::Matrix<R, 3, 1>& a) {
    Eigen::Matrix<R, 3, 3> m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

/// True if the velocity w and its angular momentum Pi are parallel up to rounding (a sphere, a principal
/// axis): the velocity stays, nothing is to be solved, and no rounding added.
template <class R>
bool turnsAboutItself(const Eigen::Matrix<R, 3, 1>& w, const Eigen::Matrix<R, 3, 1>& Pi) {
    constexpr R bound = R(4) * std::numeric_limits<R>::epsilon();
    return w.cross(Pi).squaredNorm() <= bound * bound * (w.squaredNorm() * Pi.squaredNorm());
}

/// RotationScheme::predict by a law of free rotation
///     bool Law::turn(I, w, h, next)
/// from the angular velocity w to `next`, both in the body frame of the start; false: the body keeps its own.
template <class S, class Law>
typename S::Ang predictInBodyFrame(const BodyConstants<S>& body, const typename S::Rot& q,
                                   const typename S::Ang& w, typename S::Real h) {
    if constexpr (S::dim == 2) {
        (void)body;
        (void)q;
        (void)h;
        return w;
    } else {
        using Vec = typename S::Vec;
        Vec next;
        if (!Law::template turn<typename S::Real>(body.inertia, Vec(rotateInverse(q, w)), h, next)) return w;
        return rotate(q, next);
    }
}

}  // namespace rigor::engine

/// Explicit instantiation of a factory `template <class S> RotationScheme<S> make();`.
#define RIGOR_INSTANTIATE_ROTATION(make)              \
    template RotationScheme<Space2f> make<Space2f>(); \
    template RotationScheme<Space2d> make<Space2d>(); \
    template RotationScheme<Space3f> make<Space3f>(); \
    template RotationScheme<Space3d> make<Space3d>()
