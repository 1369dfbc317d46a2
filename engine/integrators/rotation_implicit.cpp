// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations by an implicit step in the body frame [Catto2015], [Lacoursiere2006]:
//     f(w') = I (w' - w) + h w' x I w' = 0
// solved by Newton's iteration from w with the Jacobian I + h ([w']x I - [I w']x). Order 1; never gains
// energy. Deviation from [Catto2015]: iterated to convergence instead of one step.
#include "engine/integrators/rotation.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

struct Implicit {
    template <class R>
    static bool turn(const Eigen::Matrix<R, 3, 3>& I, const Eigen::Matrix<R, 3, 1>& w, R h,
                     Eigen::Matrix<R, 3, 1>& next) {
        using Vec = Eigen::Matrix<R, 3, 1>;
        constexpr R eps = std::numeric_limits<R>::epsilon();
        next = w;
        constexpr int kMaxNewton = 8;  // quadratic: 4 suffice up to h |w| = 1
        for (int i = 0; i < kMaxNewton; ++i) {
            const Vec L = I * next;
            const Vec f = I * (next - w) + h * next.cross(L);
            const Eigen::Matrix<R, 3, 3> J = I + h * (skew<R>(next) * I - skew<R>(L));
            const Vec step = J.inverse() * f;
            if (!step.allFinite()) break;
            next -= step;
            if (step.squaredNorm() <= R(4) * eps * eps * next.squaredNorm()) break;
        }
        return true;
    }
};

}  // namespace

RotationTraits rotationImplicitTraits() {
    return {.order = 1};
}

template <class S>
RotationScheme<S> rotationImplicit() {
    return {&predictInBodyFrame<S, Implicit>, nullptr};
}
RIGOR_INSTANTIATE_ROTATION(rotationImplicit);

}  // namespace rigor::engine
