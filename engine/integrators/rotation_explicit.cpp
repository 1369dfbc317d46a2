// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations by an explicit step in the body frame: w' = w - h I^-1 (w x I w). Order 1; gains energy
// and blows up for fast bodies.
#include "engine/integrators/rotation.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

struct Explicit {
    template <class R>
    static bool turn(const Eigen::Matrix<R, 3, 3>& I, const Eigen::Matrix<R, 3, 1>& w, R h,
                     Eigen::Matrix<R, 3, 1>& next) {
        using Vec = Eigen::Matrix<R, 3, 1>;
        const Vec torque = w.cross(Vec(I * w));
        const Vec change = inverseInertia<Space<R, 3>>(I) * torque;
        next = w - h * change;
        return true;
    }
};

}  // namespace

RotationTraits rotationExplicitTraits() {
    return {.order = 1};
}

template <class S>
RotationScheme<S> rotationExplicit() {
    return {&predictInBodyFrame<S, Explicit>, nullptr};
}
RIGOR_INSTANTIATE_ROTATION(rotationExplicit);

}  // namespace rigor::engine
