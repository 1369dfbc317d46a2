// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random vectors, rotations and poses of a space, the same ones in every run and in both precisions.
#pragma once

#include <random>

#include "engine/math/rotation.hpp"

namespace rigor::engine {

template <class S>
class RandomValues {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    /// Uniform random number in [-size, size].
    Real uniform(double size) {
        return static_cast<Real>(std::uniform_real_distribution<double>(-size, size)(random_));
    }
    Vec vector(double size) {
        Vec v;
        for (int i = 0; i < S::dim; ++i) v[i] = uniform(size);
        return v;
    }
    typename S::Ang angular(double size) {
        if constexpr (S::dim == 2)
            return uniform(size);
        else
            return vector(size);
    }
    Vec direction() {
        Vec v = vector(1);
        while (v.norm() < Real(0.1) || v.norm() > Real(1)) v = vector(1);
        return v.normalized();
    }
    /// Uniform over all rotations.
    typename S::Rot rotation() {
        if constexpr (S::dim == 2) {
            return Rot2<Real>::fromAngle(uniform(3.141592653589793));
        } else {
            std::normal_distribution<double> normal;
            Eigen::Quaterniond q;
            for (int i = 0; i < 4; ++i) q.coeffs()[i] = normal(random_);
            return normalizedRot(Eigen::Quaternion<Real>(q.normalized().cast<Real>()));
        }
    }
    Pose<S> pose(double size) { return {vector(size), rotation()}; }
    /// Symmetric and positive definite, with principal moments in [0.5, 2] [kg m^2].
    typename S::Inertia inertia() {
        if constexpr (S::dim == 2) {
            return Real(1.25) + uniform(0.75);
        } else {
            const Vec moments = Vec::Constant(Real(1.25)) + vector(0.75);
            const typename S::Mat R = toMatrix(rotation());
            const typename S::Mat I = R * moments.asDiagonal() * R.transpose();
            return Real(0.5) * (I + I.transpose());
        }
    }

  private:
    std::mt19937 random_{11};
};

}  // namespace rigor::engine
