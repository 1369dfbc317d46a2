// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See principal_axes.hpp. It is computed in extended precision and rounded at the end.
#include "validation/references/numerics/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {
namespace {

using AxesMatrix = Eigen::Matrix<Real, 3, 3>;

AxesMatrix matrixOf(const scenario::Mat3& m) {
    AxesMatrix result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = m(i, j);
    return result;
}

}  // namespace

PrincipalAxes principalAxes(const scenario::Mat3& symmetric) {
    const AxesMatrix m = matrixOf(symmetric);
    const Eigen::SelfAdjointEigenSolver<AxesMatrix> solver((m + m.transpose()) / 2);
    AxesMatrix axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    PrincipalAxes result;
    const Eigen::Vector3d values = solver.eigenvalues().cast<double>();
    result.values = {values[0], values[1], values[2]};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.axes(i, j) = static_cast<double>(axes(i, j));
    return result;
}

scenario::Quat toQuaternion(const scenario::Mat3& rotation) {
    const Eigen::Quaterniond q = Eigen::Quaternion<Real>(matrixOf(rotation)).normalized().cast<double>();
    return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace rigor::validation::numerics
