// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations by an implicit step in the body frame [Catto2015], [Lacoursiere2006]:
//     f(w') = I (w' - w) + h w' x I w' = 0
// solved by Newton's iteration from w with the Jacobian I + h ([w']x I - [I w']x). Order 1; never gains
// energy. Deviation from [Catto2015]: iterated to convergence instead of one step.
#include <limits>

#include "engine/integrators/integrator.hpp"

namespace rigor::engine {
namespace {

template <class V>
Eigen::Matrix<typename V::Scalar, 3, 3> skew(const V& a) {
    Eigen::Matrix<typename V::Scalar, 3, 3> m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
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
        const Vec start = rotateInverse(q, w);
        const typename S::Mat& I = body.inertia;
        Vec x = start;
        constexpr int kMaxNewton = 8;  // quadratic: 4 suffice up to h |w| = 1
        for (int i = 0; i < kMaxNewton; ++i) {
            const Vec Ix = I * x;
            const Vec f = I * (x - start) + h * x.cross(Ix);
            const typename S::Mat J = I + h * (skew(x) * I - skew(Ix));
            const Vec step = J.inverse() * f;
            if (!step.allFinite()) break;
            x -= step;
            if (step.squaredNorm() <= Real(4) * std::numeric_limits<Real>::epsilon() *
                                          std::numeric_limits<Real>::epsilon() * x.squaredNorm())
                break;
        }
        return rotate(q, x);
    }
}

}  // namespace

template <class S>
RotationScheme<S> rotationImplicit() {
    return {&predict<S>, nullptr};
}
template RotationScheme<Space2f> rotationImplicit<Space2f>();
template RotationScheme<Space2d> rotationImplicit<Space2d>();
template RotationScheme<Space3f> rotationImplicit<Space3f>();
template RotationScheme<Space3d> rotationImplicit<Space3d>();

}  // namespace rigor::engine
