// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cyclic Jacobi: annihilate the off-diagonal entries in turn; quadratic convergence, five sweeps suffice.
#include "validation/references/numerics/eigen_symmetric.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigor::validation::numerics {
namespace {

using Matrix = std::array<std::array<long double, 3>, 3>;

void rotatePair(Matrix& a, Matrix& v, std::size_t p, std::size_t q) {
    if (a[p][q] == 0) return;
    const long double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const long double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const long double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const long double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const long double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const long double vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
    }
}

}  // namespace

PrincipalAxes principalAxes(const scenario::Mat3& symmetric) {
    Matrix a{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
        v[i][i] = 1;
        for (std::size_t j = 0; j < 3; ++j) a[i][j] = (symmetric.m[i][j] + symmetric.m[j][i]) / 2.0L;
    }
    for (int sweep = 0; sweep < 12; ++sweep) {
        rotatePair(a, v, 0, 1);
        rotatePair(a, v, 0, 2);
        rotatePair(a, v, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return a[i][i] < a[j][j]; });
    PrincipalAxes result;
    std::array<double, 3> values{};
    for (std::size_t j = 0; j < 3; ++j) {
        values[j] = static_cast<double>(a[order[j]][order[j]]);
        for (std::size_t i = 0; i < 3; ++i) result.axes.m[i][j] = static_cast<double>(v[i][order[j]]);
    }
    result.values = {values[0], values[1], values[2]};
    const auto column = [&](int j) {
        return scenario::Vec3{result.axes(0, j), result.axes(1, j), result.axes(2, j)};
    };
    if (dot(cross(column(0), column(1)), column(2)) < 0)
        for (int i = 0; i < 3; ++i) result.axes(i, 2) = -result.axes(i, 2);
    return result;
}

scenario::Quat toQuaternion(const scenario::Mat3& r) {
    // The largest of the four squares first (Shepperd 1978): no cancellation for any rotation.
    const double trace = r(0, 0) + r(1, 1) + r(2, 2);
    scenario::Quat q;
    if (trace >= r(0, 0) && trace >= r(1, 1) && trace >= r(2, 2)) {
        q = {1 + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
    } else if (r(0, 0) >= r(1, 1) && r(0, 0) >= r(2, 2)) {
        q = {r(2, 1) - r(1, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2), r(0, 1) + r(1, 0), r(0, 2) + r(2, 0)};
    } else if (r(1, 1) >= r(2, 2)) {
        q = {r(0, 2) - r(2, 0), r(0, 1) + r(1, 0), 1 + r(1, 1) - r(0, 0) - r(2, 2), r(1, 2) + r(2, 1)};
    } else {
        q = {r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), 1 + r(2, 2) - r(0, 0) - r(1, 1)};
    }
    return scenario::normalized(q);
}

}  // namespace rigor::validation::numerics
