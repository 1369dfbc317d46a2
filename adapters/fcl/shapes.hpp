// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "adapters/interface/types.hpp"

namespace rigor::fcl_adapter {

/// A shape as FCL has it, and FCL's frame of it in the world.
struct FclShape {
    std::shared_ptr<fcl::CollisionGeometryd> geometry;
    fcl::Transform3d pose;
};

/// The document that shows that FCL has no height fields.
inline constexpr const char* kNoHeightField =
    "fcl/geometry/collision_geometry.h, NODE_TYPE: none is a height field; BVH_model.h: a mesh is triangles "
    "without a side";

fcl::Transform3d transformOf(const adapter::Pose& pose);

/// Throws adapter::Unsupported for segments, chains and height fields.
FclShape toFcl(const adapter::Geometry& geometry, const adapter::Pose& pose);

inline fcl::Vector3d toFcl(const adapter::Vec3& v) {
    return {v.x, v.y, v.z};
}
inline adapter::Vec3 fromFcl(const fcl::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace rigor::fcl_adapter
