// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact of an ellipsoid with any bounded solid or half-space. Private to this folder.
#pragma once

#include "validation/oracle/core.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::validation::oracle {

/// As exactContact; a or b is an ellipsoid.
std::optional<OracleAnswer> ellipsoidContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                             const scenario::Geometry& b, const scenario::Pose& poseB,
                                             double tie);

/// Support of a posed ellipsoid along the unit vector n, relative to `origin`.
Real ellipsoidReach(const scenario::Ellipsoid& ellipsoid, const scenario::Pose& pose, scenario::Vec3 origin,
                    Vec n);

}  // namespace rigor::validation::oracle
