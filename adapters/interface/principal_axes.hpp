// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

struct PrincipalAxes {
    Vec3 moments;  ///< [kg m^2]
    Quat axes;     ///< principal frame to body frame
};

/// Principal moments and axes of a symmetric tensor, by cyclic Jacobi rotations. A tensor that is diagonal
/// already keeps its axes exactly (identity rotation).
PrincipalAxes principalAxes(const Mat3& inertia);

}  // namespace rigor::adapter
