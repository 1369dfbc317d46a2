// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>

#include <memory>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::bullet {

/// Bullet's own collision margin [m] (CONVEX_DISTANCE_MARGIN).
inline constexpr double kLibraryMargin = 0.04;
/// Half the thickness of the box that stands for a half-space [m].
inline constexpr double kHalfSpaceDepth = 10.0;

struct ShapeSettings {
    bool polyhedralFeatures = false;         ///< faces and edges for the SAT path of hulls and boxes
    double boxMargin = kLibraryMargin;       ///< margin of boxes; inside the shape [m]
    double cylinderMargin = kLibraryMargin;  ///< margin of cylinders; inside the shape [m]
    double hullMargin = kLibraryMargin;      ///< margin of hulls and cones; grows a hull [m]
    bool halfSpaceAsBox = false;
    double halfSpaceReach = 100.0;  ///< half width of that box [m]
    adapter::Vec3 halfSpaceCenter;  ///< its middle is the projection of this world point
    bool internalEdges = false;     ///< contacts with inner edges of surfaces are given the face's normal
};

/// Numbers that a surface of Bullet reads and does not own.
struct SurfaceData {
    std::vector<btScalar> numbers;  ///< coordinates of vertices, or heights [m]
    std::vector<int> indices;       ///< three of each triangle
    btTriangleIndexVertexArray mesh;
    btTriangleInfoMap edges;
};

/// A shape and where its frame stands in the frame of the scenario's shape.
struct BuiltShape {
    std::unique_ptr<btCollisionShape> shape;
    adapter::Pose offset;
    std::unique_ptr<SurfaceData> surface;  ///< null but for triangle meshes and height fields
};

/// One geometry. `pose` (shape frame to world) matters for half-spaces alone. Throws Unsupported.
BuiltShape buildGeometry(const adapter::Geometry& geometry, const adapter::Pose& pose,
                         const ShapeSettings& settings);

/// The shapes of one body as Bullet's single collision shape, and what owns the parts. The user index of each
/// part is the index of the scenario's shape.
class BodyShape {
  public:
    /// `comFrame` is the frame of the Bullet body in the body frame of the scenario. Bodies without contacts
    /// get an empty shape.
    BodyShape(const scenario::Body& body, const adapter::Pose& comFrame, const ShapeSettings& settings);
    btCollisionShape* get() const { return root_; }

  private:
    std::vector<BuiltShape> parts_;
    std::unique_ptr<btCompoundShape> compound_;
    btCollisionShape* root_ = nullptr;
};

}  // namespace rigor::bullet
