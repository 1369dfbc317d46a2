// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::bullet {

/// How a coordinate of a joint changes with the velocities of its bodies: u = lin.(vB - vA) + angB.wB +
/// angA.wA, vectors in the world frame.
struct CoordinateRow {
    adapter::Vec3 lin, angA, angB;
};
/// Travel of B's anchor along t, and turn of B against A about n; anchors coincide at `anchor` (world).
CoordinateRow travelRow(const adapter::Vec3& t, const adapter::Vec3& anchor, const adapter::Vec3& centerA,
                        const adapter::Vec3& centerB);
CoordinateRow turnRow(const adapter::Vec3& n);

/// Inverse mass and inertia (world frame) of one side; zero for what does not move.
struct InverseInertia {
    double mass = 0.0;
    adapter::Mat3 inertia;
    InverseInertia() = default;
    explicit InverseInertia(const scenario::Body& body);
};

/// Effective mass [kg] or [kg m^2] of a coordinate while the rows of `held` do not move:
///     1 / (j W j^T),  W = M^-1 - M^-1 H^T (H M^-1 H^T)^-1 H M^-1
/// by Gram-Schmidt in the product of M^-1. Redundant held rows are dropped. Zero where nothing can move.
double effectiveMass(const CoordinateRow& coordinate, const std::vector<CoordinateRow>& held,
                     const InverseInertia& a, const InverseInertia& b);

}  // namespace rigor::bullet
