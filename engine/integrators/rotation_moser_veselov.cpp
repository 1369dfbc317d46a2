// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The discrete Moser-Veselov rigid body [MoserVeselov1991], [McLachlanZanna2005]. With Pi the angular
// momentum in the body frame, J the inertia and D = tr(J)/2 - J, a step turns the body by F (R_1 = R_0 F):
//     h [Pi_0]x = F D - D F^T,     Pi_1 = F^T Pi_0
// It comes from a discrete action, is integrable as the continuous body is, and keeps energy and angular
// momentum: its points lie on the exact trajectory of Pi, run through at a speed that is off by the order 2.
//
// With F = cay(a), a = tan(angle / 2) axis, the matrix equation is (see [LeeLeokMcClamroch2007] for the
// exponential form)
//     g = h Pi_0 / 2 = (J a + a x J a) / (1 + |a|^2),     that is     J a - g - (a . g) a - g x a = 0
// (because (1 + [a]x)^-1 (1 + |a|^2) = 1 + a a^T - [a]x), quadratic in a, solved by Newton's iteration from
// a = J^-1 g with the Jacobian J - (a . g) - a g^T - [g]x. Of its roots the one that goes to zero with h is
// meant: it turns by less than a right angle, |a| < 1. About a principal axis sin(angle) = h |w|, so there is
// no solution for h |w| > 1: then the step is made of 2, 4, ... equal ones; a body too fast for 64 turns
// without gyroscopic term.
//
// Deviation: where velocity and momentum are parallel (spheres, principal axes) the body turns by h w
// exactly. There Moser-Veselov would turn by asin(h |w|), and a sphere that rolls would seem to slip.
//
// In a step with constraints as lie_midpoint. Cost: one to five Newton steps (h |w| = 0.01 .. 0.8).
#include "engine/integrators/angular_momentum.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

/// a with J a - g - (a . g) a - g x a = 0 and |a| < 1; false if none was found.
template <class R>
bool solveCayley(const Eigen::Matrix<R, 3, 3>& J, const Eigen::Matrix<R, 3, 1>& g,
                 Eigen::Matrix<R, 3, 1>& a) {
    using Vec = Eigen::Matrix<R, 3, 1>;
    constexpr R eps = std::numeric_limits<R>::epsilon();
    const R size = J.cwiseAbs().maxCoeff();
    a = J.inverse() * g;
    constexpr int kMaxNewton = 20;  // quadratic from the first on where |a| < 0.4; 6 at the bound
    for (int i = 0; i < kMaxNewton; ++i) {
        const R ag = a.dot(g);
        const Vec f = J * a - g - ag * a - g.cross(a);
        Eigen::Matrix<R, 3, 3> K = J - a * g.transpose() - skew<R>(g);
        K.diagonal().array() -= ag;
        const Vec step = K.inverse() * f;
        if (!step.allFinite()) return false;
        a -= step;
        // f is a difference of terms of the size of J a: beyond its rounding no step makes it better.
        if (step.norm() <= R(4) * eps * a.norm() || f.norm() <= R(2) * eps * size * a.norm())
            return a.squaredNorm() < R(1);
    }
    return false;
}

/// F of `steps` steps of h / steps; false where a step has no solution.
template <class R>
bool turnInSteps(const Eigen::Matrix<R, 3, 3>& J, Eigen::Matrix<R, 3, 1> Pi, R h, int steps,
                 Eigen::Quaternion<R>& F) {
    using Vec = Eigen::Matrix<R, 3, 1>;
    F = Eigen::Quaternion<R>::Identity();
    for (int i = 0; i < steps; ++i) {
        Vec a;
        if (!solveCayley<R>(J, Vec(R(0.5) * h / R(steps) * Pi), a)) return false;
        const Eigen::Quaternion<R> f = normalizedRot(Eigen::Quaternion<R>(R(1), a.x(), a.y(), a.z()));
        F = normalizedRot(compose(F, f));
        Pi = rotateInverse(f, Pi);
    }
    return true;
}

struct MoserVeselov {
    template <class R>
    static bool turn(const Eigen::Matrix<R, 3, 3>& J, const Eigen::Matrix<R, 3, 1>& w, R h,
                     Eigen::Matrix<R, 3, 1>& next) {
        const Eigen::Matrix<R, 3, 1> Pi = J * w;
        if (turnsAboutItself<R>(w, Pi)) return false;
        constexpr int kMostSteps = 64;
        Eigen::Quaternion<R> F;
        for (int steps = 1; steps <= kMostSteps; steps *= 2)
            if (turnInSteps<R>(J, Pi, h, steps, F)) {
                next = rotationVector(F) / h;
                return true;
            }
        return false;
    }
};

}  // namespace

RotationTraits rotationMoserVeselovTraits() {
    return {.order = 2, .keepsMomentum = true, .keepsEnergy = true};
}

template <class S>
RotationScheme<S> rotationMoserVeselov() {
    return {&predictInBodyFrame<S, MoserVeselov>, &keepAngularMomentum<S>};
}
RIGOR_INSTANTIATE_ROTATION(rotationMoserVeselov);

}  // namespace rigor::engine
