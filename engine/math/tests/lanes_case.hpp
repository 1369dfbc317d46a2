// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Computations of lanes_test.cpp, in eight lanes side by side and for one of them.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/math/lanes.hpp"
#include "engine/math/rotation.hpp"

namespace rigor::engine {

inline constexpr std::size_t kLaneAlignment = 64;

template <class S>
struct alignas(kLaneAlignment) LanesInput {
    using Number = Lanes<typename S::Real>;
    static constexpr int angular = S::dim == 3 ? 3 : 1;
    alignas(kLaneAlignment) Number a[S::dim];
    alignas(kLaneAlignment) Number b[S::dim];
    alignas(kLaneAlignment) Number w[angular];
    alignas(kLaneAlignment) Number u[angular];
    alignas(kLaneAlignment) Number matrix[S::dim == 3 ? 6 : 1];  ///< symmetric: the upper triangle
    alignas(kLaneAlignment) Number x;
};

template <class S>
struct alignas(kLaneAlignment) LanesOutput {
    using Number = Lanes<typename S::Real>;
    static constexpr int angular = S::dim == 3 ? 3 : 1;
    alignas(kLaneAlignment) Number dot;
    alignas(kLaneAlignment) Number minus[S::dim];
    alignas(kLaneAlignment) Number add[S::dim];       ///< a + x b
    alignas(kLaneAlignment) Number subtract[S::dim];  ///< a - x b
    alignas(kLaneAlignment) Number moment[angular];   ///< a x b
    alignas(kLaneAlignment) Number turning[S::dim];   ///< w x a
    alignas(kLaneAlignment) Number times[angular];    ///< matrix u
    alignas(kLaneAlignment) Number inverse;           ///< inverse of x
    LanesOutput() { std::fill_n(reinterpret_cast<unsigned char*>(this), sizeof *this, 0); }
};

/// Computed by Eigen and the functions of space.hpp.
template <class S>
void computeScalar(const LanesInput<S>& in, std::size_t lane, LanesOutput<S>& out) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    Vec a, b;
    for (int k = 0; k < S::dim; ++k) {
        a[k] = in.a[k][lane];
        b[k] = in.b[k][lane];
    }
    const Real x = in.x[lane];
    const Vec minus = a - b, add = a + x * b, subtract = a - x * b;
    Vec turning;
    if constexpr (S::dim == 2) {
        out.moment[0][lane] = cross(a, b);
        turning = cross(in.w[0][lane], a);
        out.times[0][lane] = in.matrix[0][lane] * in.u[0][lane];
    } else {
        const auto& m = in.matrix;
        typename S::Mat matrix;
        matrix << m[0][lane], m[1][lane], m[2][lane], m[1][lane], m[3][lane], m[4][lane], m[2][lane],
            m[4][lane], m[5][lane];
        const Vec u(in.u[0][lane], in.u[1][lane], in.u[2][lane]);
        const Vec w(in.w[0][lane], in.w[1][lane], in.w[2][lane]);
        const Vec moment = cross(a, b);
        turning = cross(w, a);
        for (int k = 0; k < 3; ++k) {
            out.moment[k][lane] = moment[k];
            out.times[k][lane] = matrix(k, 0) * u[0] + matrix(k, 1) * u[1] + matrix(k, 2) * u[2];
        }
    }
    Real dot = a[0] * b[0];
    for (int k = 1; k < S::dim; ++k) dot += a[k] * b[k];
    out.dot[lane] = dot;
    for (int k = 0; k < S::dim; ++k) {
        out.minus[k][lane] = minus[k];
        out.add[k][lane] = add[k];
        out.subtract[k][lane] = subtract[k];
        out.turning[k][lane] = turning[k];
    }
    out.inverse[lane] = x > 4 * std::numeric_limits<Real>::min() ? 1 / x : Real(0);
}

}  // namespace rigor::engine
