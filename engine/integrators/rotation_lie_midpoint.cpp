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
// With the turn's half angle x = h |W| / 2, exp(-h W) is the Cayley transform (1 + [g]x)^-1 (1 - [g]x) of
// g = tan(x) W / |W|, so that (Pi_0 + Pi_1) / 2 = (1 + [g]x)^-1 Pi_0, and the equation is
//     f(W) = cos(x) (I W - Pi_0) + h/2 sin(x)/x W x I W = 0,
// solved by Newton's iteration.
#include "engine/integrators/angular_momentum.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

/// cos(x) and sin(x)/x of x2 = x^2; beyond 2^62 turns those of 0.
template <class R>
void cosSincOfAny(R x2, R& cosine, R& sinc) {
    int halvings = 0;
    for (; x2 > R(1.0 / 16) && halvings < 64; ++halvings) x2 *= R(0.25);
    if (!(x2 <= R(1.0 / 16))) {
        x2 = R(0);
        halvings = 0;
    }
    cosSinc(x2, cosine, sinc);
    for (; halvings > 0; --halvings) {
        sinc *= cosine;
        cosine = R(2) * cosine * cosine - R(1);
    }
}

struct LieMidpoint {
    template <class R>
    static bool turn(const Eigen::Matrix<R, 3, 3>& I, const Eigen::Matrix<R, 3, 1>& w, R h,
                     Eigen::Matrix<R, 3, 1>& W) {
        using Vec = Eigen::Matrix<R, 3, 1>;
        using Mat = Eigen::Matrix<R, 3, 3>;
        constexpr R eps = std::numeric_limits<R>::epsilon();
        const Vec Pi0 = I * w;
        if (turnsAboutItself<R>(w, Pi0)) return false;
        W = w;
        const R half = R(0.5) * h;
        R last = std::numeric_limits<R>::max();
        constexpr int kMaxNewton = 30;  // 3 at h |w| = 0.1, 4 at 0.8, 7 at 1.9
        for (int i = 0; i < kMaxNewton; ++i) {
            const R x2 = half * half * W.squaredNorm();
            R c, sinc;
            cosSincOfAny(x2, c, sinc);
            const Vec Pi = I * W, change = Pi - Pi0, across = W.cross(Pi);
            const Vec f = c * change + half * sinc * across;
            // The derivatives of cos(x) and sin(x)/x are -sinc x and, to x^2, -x/3 (1 - x^2/10).
            const R third = half * (R(1) / 3 - x2 / 30);
            const Vec slope = -half * half * Vec(sinc * change + third * across);
            const Mat J = c * I + half * sinc * Mat(skew<R>(W) * I - skew<R>(Pi)) + slope * W.transpose();
            const Vec step = J.inverse() * f;
            const R size = step.squaredNorm();
            if (!(size < last)) break;  // rounding reached, or no convergence
            last = size;
            W -= step;
            // The next step would be of the order of this one's square.
            if (size <= R(1e-2) * eps * W.squaredNorm()) break;
        }
        // W . I W = W . Pi_0 bounds a solution's energy by that of w. Beyond it none was found (h |w| > 2).
        if (W.dot(I * W) > R(1.01) * w.dot(Pi0)) W = w;
        return true;
    }
};

}  // namespace

RotationTraits rotationLieMidpointTraits() {
    return {.order = 2, .keepsMomentum = true, .keepsEnergy = true, .inBlocks = true};
}

template <class S>
RotationScheme<S> rotationLieMidpoint() {
    return {&predictInBodyFrame<S, LieMidpoint>, &keepAngularMomentum<S>};
}
RIGOR_INSTANTIATE_ROTATION(rotationLieMidpoint);

}  // namespace rigor::engine
