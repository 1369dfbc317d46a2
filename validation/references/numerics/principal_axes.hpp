// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Principal axes of a symmetric 3 x 3 matrix and quaternions of rotation matrices, by Eigen in the types of
// the scenario model.
#pragma once

#include "scenarios/model/math.hpp"

namespace rigor::validation::numerics {

struct PrincipalAxes {
    scenario::Vec3 values;  ///< eigenvalues in the order of the axes
    scenario::Mat3 axes;    ///< columns: right-handed orthonormal eigenvectors
};
/// Eigenvalues and a right-handed frame of eigenvectors, ascending eigenvalues. Accurate to rounding.
PrincipalAxes principalAxes(const scenario::Mat3& symmetric);

/// The unit quaternion of a rotation matrix (columns right-handed orthonormal).
scenario::Quat toQuaternion(const scenario::Mat3& rotation);

}  // namespace rigor::validation::numerics
