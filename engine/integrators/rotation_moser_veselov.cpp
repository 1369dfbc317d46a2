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
// exactly. There Moser-Veselov would turn by asin(h |w|), and a ball that rolls would seem to slip.
//
// In a step with constraints as lie_midpoint. Cost: one to five Newton steps (h |w| = 0.01 .. 0.8).
#include <limits>

#include "engine/integrators/angular_momentum.hpp"

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
        Eigen::Matrix<R, 3, 3> K = J - a * g.transpose();
        K.diagonal().array() -= ag;
        K(0, 1) += g.z(), K(0, 2) -= g.y();
        K(1, 0) -= g.z(), K(1, 2) += g.x();
        K(2, 0) += g.y(), K(2, 1) -= g.x();
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
bool turn(const Eigen::Matrix<R, 3, 3>& J, Eigen::Matrix<R, 3, 1> Pi, R h, int steps,
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

template <class S>
typename S::Ang predict(const BodyConstants<S>& body, const typename S::Rot& q, const typename S::Ang& w,
                        typename S::Real h) {
    if constexpr (S::dim == 2) {
        (void)body, (void)q, (void)h;
        return w;
    } else {
        using Vec = typename S::Vec;
        using Real = typename S::Real;
        const typename S::Mat& J = body.inertia;
        const Vec start = rotateInverse(q, w);
        const Vec Pi = J * start;
        const Real parallel = Real(4) * std::numeric_limits<Real>::epsilon() * start.norm() * Pi.norm();
        if (!(start.cross(Pi).norm() > parallel)) return w;
        constexpr int kMostSteps = 64;
        typename S::Rot F;
        for (int steps = 1; steps <= kMostSteps; steps *= 2)
            if (turn<Real>(J, Pi, h, steps, F)) return rotate(q, Vec(rotationVector(F) / h));
        return w;
    }
}

}  // namespace

template <class S>
RotationScheme<S> rotationMoserVeselov() {
    return {&predict<S>, &keepAngularMomentum<S>};
}
template RotationScheme<Space2f> rotationMoserVeselov<Space2f>();
template RotationScheme<Space2d> rotationMoserVeselov<Space2d>();
template RotationScheme<Space3f> rotationMoserVeselov<Space3f>();
template RotationScheme<Space3d> rotationMoserVeselov<Space3d>();

}  // namespace rigor::engine
