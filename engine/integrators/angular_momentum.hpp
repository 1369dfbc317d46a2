// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of a step for rotation schemes that keep the angular momentum in the world.
#pragma once

#include "engine/integrators/rotation.hpp"

namespace rigor::engine {

/// RotationScheme::finish: what the constraints changed is added to the angular momentum L of the start, and
/// the end velocity is I(q1)^-1 L.
template <class S>
typename S::Ang keepAngularMomentum(const BodyConstants<S>& body, const typename S::Rot& q0,
                                    const typename S::Rot& q1, const typename S::Ang& w,
                                    const typename S::Ang& predicted, const typename S::Ang& solved) {
    if constexpr (S::dim == 2) {
        (void)body, (void)q0, (void)q1, (void)w, (void)predicted;
        return solved;
    } else {
        using Vec = typename S::Vec;
        using Real = typename S::Real;
        // L = I(q0) (w + what the constraints changed)
        const Vec kept = rotateInverse(q0, Vec(w + (solved - predicted)));
        const Vec Pi = body.inertia * kept;
        if (turnsAboutItself<Real>(kept, Pi)) return w + (solved - predicted);
        const Vec L = rotate(q0, Pi);
        const Vec local = inverseInertia<S>(body.inertia) * rotateInverse(q1, L);
        return rotate(q1, local);
    }
}

}  // namespace rigor::engine
