// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bullet and MuJoCo keep a body's inertia as three moments along the axes of a frame of its own, so a full tensor has to
// be turned into the principal frame first.
//
// Cyclic Jacobi method [Golub & Van Loan, Matrix Computations, 4th ed., section 8.5]: each rotation
//   t = sgn(theta) / (|theta| + sqrt(theta^2 + 1)),  theta = (a_qq - a_pp) / (2 a_pq)
// annihilates a_pq; a 3x3 matrix is diagonal to rounding after a handful of sweeps.
#include "adapters/interface/principal_axes.hpp"

#include <cmath>

namespace rigor::adapter {

namespace {

/// Annihilates a(p,q) and applies the same rotation to the quaternion of the axes.
void rotateOut(Mat3& a, Quat& axes, int p, int q) {
    if (a(p, q) == 0.0) return;
    const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    // A' = J^T A J with J a rotation by `angle` from axis p towards axis q, reversed.
    const double angle = -std::atan(t);
    const int r = 3 - p - q;
    const bool cyclic = (p + 1) % 3 == q;
    Vec3 axis;
    (r == 0 ? axis.x : r == 1 ? axis.y : axis.z) = cyclic ? 1.0 : -1.0;
    const Quat turn = scenario::fromAxisAngle(axis, angle);
    const Mat3 J = toMatrix(turn);
    a = transpose(J) * a * J;
    a(p, q) = a(q, p) = 0.0;
    axes = normalized(axes * turn);
}

}  // namespace

PrincipalAxes principalAxes(const Mat3& inertia) {
    Mat3 a = inertia;
    Quat axes;
    const double scale = a(0, 0) + a(1, 1) + a(2, 2);
    const auto offDiagonal = [&] { return std::abs(a(0, 1)) + std::abs(a(0, 2)) + std::abs(a(1, 2)); };
    for (int sweep = 0; sweep < 30 && offDiagonal() > 1e-15 * scale; ++sweep) {
        rotateOut(a, axes, 0, 1);
        rotateOut(a, axes, 1, 2);
        rotateOut(a, axes, 0, 2);
    }
    return {{a(0, 0), a(1, 1), a(2, 2)}, axes};
}

}  // namespace rigor::adapter
