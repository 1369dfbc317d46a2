// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the scenario as DART's.
#pragma once

#include <dart/collision/CollisionDetector.hpp>
#include <dart/dynamics/Shape.hpp>
#include <string>
#include <vector>

#include "adapters/dart/convert.hpp"

namespace rigor::dart_adapter {

/// The values of the option narrow_phase. DART's own one has boxes and balls alone.
inline constexpr const char* kNarrowPhases[] = {"fcl_mesh", "fcl_primitive", "dart", "ode"};

struct DartShape {
    dart::dynamics::ShapePtr shape;
    Pose frame;  ///< DART's shape frame in the scenario's
    bool surface = false,
         back = false;  ///< a triangle mesh; the same with its triangles reversed (surfaces.hpp)
};

/// Half the side of the box that stands for a half-space where the narrow phase has no planes [m].
inline constexpr double kGroundHalfSide = 100.0;

/// Several where a capsule has to be put together, two for a triangle mesh, else one. Throws Unsupported for geometries that the adapter or this
/// narrow phase does not have.
std::vector<DartShape> makeShapes(const adapter::Geometry& geometry, const std::string& narrowPhase);

dart::collision::CollisionDetectorPtr makeDetector(const std::string& narrowPhase);

}  // namespace rigor::dart_adapter
