// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of a step for rotation schemes that keep the angular momentum in the world.
#pragma once

#include "engine/integrators/rotation.hpp"

namespace rigor::engine {

/// Turns vectors by q and its inverse, at their own length also where |q|^2 is 1 + eps: normalising leaves such a
/// bias (about 1e-16 in f64), which rotate() passes on to the length and a million steps would add up.
template <class R>
struct TurnAtLength {
    using Vec = Eigen::Matrix<R, 3, 1>;
    Vec u;
    R w, twice;

    explicit TurnAtLength(const Eigen::Quaternion<R>& q)
        : u(q.vec()), w(q.w()), twice(R(2) / q.squaredNorm()) {}
    Vec turn(const Vec& v) const {
        const Vec t = u.cross(v);
        return v + twice * (w * t + u.cross(t));
    }
    Vec turnBack(const Vec& v) const {
        const Vec t = u.cross(v);
        return v + twice * (u.cross(t) - w * t);
    }
};

/// RotationScheme::finish: what the constraints changed is added to the angular momentum L of the start, and
/// the end velocity is I(q1)^-1 L.
template <class S>
typename S::Ang keepAngularMomentum(const BodyConstants<S>& body, const typename S::Rot& q0,
                                    const typename S::Rot& q1, const typename S::Ang& w,
                                    const typename S::Ang& predicted, const typename S::Ang& solved) {
    if constexpr (S::dim == 2) {
        (void)body;
        (void)q0;
        (void)q1;
        (void)w;
        (void)predicted;
        return solved;
    } else {
        using Vec = typename S::Vec;
        using Real = typename S::Real;
        // L = I(q0) (w + what the constraints changed)
        const TurnAtLength<Real> start(q0), end(q1);
        const Vec kept = start.turnBack(w + (solved - predicted));
        const Vec Pi = body.inertia * kept;
        if (turnsAboutItself<Real>(kept, Pi)) return w + (solved - predicted);
        const Vec L = start.turn(Pi);
        // One refinement: the rounding of the inverse is the same in every step and would add up.
        const auto inverse = inverseInertia<S>(body.inertia);
        const Vec Pi1 = end.turnBack(L);
        Vec local = inverse * Pi1;
        local += inverse * Vec(Pi1 - body.inertia * local);
        return end.turn(local);
    }
}

}  // namespace rigor::engine
