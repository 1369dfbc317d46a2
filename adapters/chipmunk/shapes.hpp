// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <vector>

#include "adapters/chipmunk/convert.hpp"

namespace rigor::chipmunk {

/// Extent of the rectangle in place of a half-plane [m].
struct HalfPlane {
    Vec3 center;            ///< point of the world over which it is centred
    double reach = 1000.0;  ///< half of its length
    double depth = 100.0;   ///< half of its depth
};

/// Chipmunk shapes that together are one of the scenario's, on `body` and in no space. `inBody` is the shape's pose in
/// the body frame, `bodyPose` the body's. Throws Unsupported.
std::vector<Owned<cpShape>> buildShapes(cpBody* body, const adapter::Geometry& geometry, const Pose& inBody,
                                        const Pose& bodyPose, const HalfPlane& halfPlane);

}  // namespace rigor::chipmunk
