// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Energy- and momentum-conserving rotation [SimoWong1991]. With Pi the angular momentum in the body frame,
// the body turns by exp(h W) where
//     I W = (Pi_0 + Pi_1) / 2,     Pi_1 = exp(-h W) Pi_0.
// Pi_1 is Pi_0 seen from the turned body, so the angular momentum in the world is kept exactly; exp(-h W)
// keeps the component along W, so W . (Pi_1 - Pi_0) = 0, which is the change of kinetic energy: kept exactly
// as well. Order 2, symmetric.
//
// In a step with constraints: torques have changed the angular momentum first; W is the velocity that the
// constraints act on and that moves the body; what they change is added to the angular momentum, and the end
// velocity is that of the angular momentum in the new orientation.
//
// Solved by Newton's iteration with the Jacobian I - h/2 [Pi_1]x (exp's derivative taken as that at zero,
// hence linear convergence with a factor of order (h |W|)^2).
#include <limits>

#include "engine/integrators/angular_momentum.hpp"

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
        using Real = typename S::Real;
        constexpr Real eps = std::numeric_limits<Real>::epsilon();
        const typename S::Mat& I = body.inertia;
        const Vec start = rotateInverse(q, w);
        const Vec Pi0 = I * start;
        // Parallel to the angular momentum (a sphere, a principal axis): nothing to solve, no rounding added.
        if (start.cross(Pi0).norm() <= Real(4) * eps * start.norm() * Pi0.norm()) return w;
        Vec W = start;
        Real last = std::numeric_limits<Real>::max();
        constexpr int kMaxNewton = 30;  // 5 at h |w| = 0.1, 12 at 0.8
        for (int i = 0; i < kMaxNewton; ++i) {
            const Vec Pi1 = rotate(expMap(Vec(-h * W)), Pi0);
            const Vec f = I * W - Real(0.5) * (Pi0 + Pi1);
            typename S::Mat J = I;
            const Vec p = Real(0.5) * h * Pi1;
            J(0, 1) += p.z(), J(0, 2) -= p.y();
            J(1, 0) -= p.z(), J(1, 2) += p.x();
            J(2, 0) += p.y(), J(2, 1) -= p.x();
            const Vec step = J.inverse() * f;
            const Real size = step.squaredNorm();
            if (!(size < last)) break;  // rounding reached, or no convergence
            last = size;
            W -= step;
            if (size <= eps * eps * W.squaredNorm()) break;
        }
        return rotate(q, W);
    }
}

}  // namespace

template <class S>
RotationScheme<S> rotationLieMidpoint() {
    return {&predict<S>, &keepAngularMomentum<S>};
}
template RotationScheme<Space2f> rotationLieMidpoint<Space2f>();
template RotationScheme<Space2d> rotationLieMidpoint<Space2d>();
template RotationScheme<Space3f> rotationLieMidpoint<Space3f>();
template RotationScheme<Space3d> rotationLieMidpoint<Space3d>();

}  // namespace rigor::engine
