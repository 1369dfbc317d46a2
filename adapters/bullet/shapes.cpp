// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Geometries of the scenario format as Bullet shapes. Bullet's capsule, cylinder and cone lie along local y
// like the format's; its lengths are full, the format's are halves.
#include "adapters/bullet/shapes.hpp"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <string>

#include "adapters/bullet/convert.hpp"

namespace rigor::bullet {
namespace {

/// The shortest rotation that takes +y to the unit vector n.
Quat fromYTo(const Vec3& n) {
    if (n.y < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
    const Vec3 axis = cross(Vec3{0.0, 1.0, 0.0}, n);
    return normalized(Quat{1.0 + n.y, axis.x, axis.y, axis.z});
}

/// Two-sided triangles. Bullet's margin of a mesh is 0 unless it is set.
BuiltShape buildMesh(const scenario::TriangleMesh& mesh, const ShapeSettings& settings) {
    auto data = std::make_unique<SurfaceData>();
    for (const Vec3& v : mesh.vertices)
        for (const double x : {v.x, v.y, v.z}) data->numbers.push_back(static_cast<btScalar>(x));
    for (const auto& triangle : mesh.triangles)
        data->indices.insert(data->indices.end(), triangle.begin(), triangle.end());
    btIndexedMesh part;
    part.m_numTriangles = mesh.triangles.size();
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(data->indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = mesh.vertices.size();
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(data->numbers.data());
    part.m_vertexStride = 3 * sizeof(btScalar);
    part.m_vertexType = sizeof(btScalar) == sizeof(double) ? PHY_DOUBLE : PHY_FLOAT;
    data->mesh.addIndexedMesh(part, PHY_INTEGER);
    auto shape = std::make_unique<btBvhTriangleMeshShape>(&data->mesh, true);
    if (settings.internalEdges) btGenerateInternalEdgeInfo(shape.get(), &data->edges);
    return {std::move(shape), {}, std::move(data)};
}

/// Bullet's grid is centred like the format's in x and z, and on the middle of its range of heights; its
/// cells are split along the same diagonal. It is a surface: what is under it is not solid.
BuiltShape buildHeightField(const scenario::HeightField& field, const ShapeSettings& settings) {
    auto data = std::make_unique<SurfaceData>();
    for (const double h : field.heights) data->numbers.push_back(static_cast<btScalar>(h));
    const auto [least, most] = std::minmax_element(data->numbers.begin(), data->numbers.end());
    auto shape = std::make_unique<btHeightfieldTerrainShape>(field.columns, field.rows, data->numbers.data(),
                                                             *least, *most, 1, false);
    shape->setLocalScaling(toBullet(Vec3{field.spacingX, 1.0, field.spacingZ}));
    if (settings.internalEdges) btGenerateInternalEdgeInfo(shape.get(), &data->edges);
    const double middle = 0.5 * (static_cast<double>(*least) + static_cast<double>(*most));
    return {std::move(shape), {{0.0, middle, 0.0}, {}}, std::move(data)};
}

struct Builder {
    const Pose& pose;
    const ShapeSettings& settings;

    BuiltShape operator()(const scenario::Sphere& s) const {
        return {std::make_unique<btSphereShape>(static_cast<btScalar>(s.radius)), {}, nullptr};
    }
    BuiltShape operator()(const scenario::Box& b) const {
        auto box = std::make_unique<btBoxShape>(toBullet(b.halfExtents));
        const double least = std::min({b.halfExtents.x, b.halfExtents.y, b.halfExtents.z});
        applyInnerMargin(*box, settings.boxMargin, least);
        if (settings.polyhedralFeatures) box->initializePolyhedralFeatures();
        return {std::move(box), {}, nullptr};
    }
    BuiltShape operator()(const scenario::Capsule& c) const {
        return {std::make_unique<btCapsuleShape>(static_cast<btScalar>(c.radius),
                                                 static_cast<btScalar>(2.0 * c.halfLength)),
                {},
                nullptr};
    }
    BuiltShape operator()(const scenario::Cylinder& c) const {
        auto cylinder = std::make_unique<btCylinderShape>(toBullet(Vec3{c.radius, c.halfLength, c.radius}));
        applyInnerMargin(*cylinder, settings.cylinderMargin, std::min(c.radius, c.halfLength));
        return {std::move(cylinder), {}, nullptr};
    }
    BuiltShape operator()(const scenario::Cone& c) const {
        auto cone = std::make_unique<btConeShape>(static_cast<btScalar>(c.radius),
                                                  static_cast<btScalar>(2.0 * c.halfLength));
        cone->setMargin(static_cast<btScalar>(settings.hullMargin));
        return {std::move(cone), {}, nullptr};
    }
    BuiltShape operator()(const scenario::ConvexHull& h) const {
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Vec3& v : h.vertices) hull->addPoint(toBullet(v), false);
        hull->setMargin(static_cast<btScalar>(settings.hullMargin));
        hull->recalcLocalAabb();
        if (settings.polyhedralFeatures) hull->initializePolyhedralFeatures();
        return {std::move(hull), {}, nullptr};
    }
    BuiltShape operator()(const scenario::HalfSpace& h) const {
        if (!settings.halfSpaceAsBox)
            return {std::make_unique<btStaticPlaneShape>(toBullet(h.normal), static_cast<btScalar>(h.offset)),
                    {},
                    nullptr};
        const double reach = settings.halfSpaceReach;
        auto box = std::make_unique<btBoxShape>(toBullet(Vec3{reach, kHalfSpaceDepth, reach}));
        applyInnerMargin(*box, settings.boxMargin, kHalfSpaceDepth);
        if (settings.polyhedralFeatures) box->initializePolyhedralFeatures();
        const Vec3 center = inverse(pose) * settings.halfSpaceCenter;
        const Vec3 onPlane = center + (h.offset - dot(h.normal, center)) * h.normal;
        return {std::move(box), {onPlane - kHalfSpaceDepth * h.normal, fromYTo(h.normal)}, nullptr};
    }
    BuiltShape operator()(const scenario::TriangleMesh& mesh) const { return buildMesh(mesh, settings); }
    BuiltShape operator()(const scenario::HeightField& field) const {
        return buildHeightField(field, settings);
    }
    template <class Other>
    BuiltShape operator()(const Other& other) const {
        throw adapter::notInAdapter("bullet",
                                    std::string("shape '") + scenario::geometryName(other, 3) + "'");
    }

  private:
    /// Boxes and cylinders keep their outer size; the margin rounds their edges in the GJK path only. Never
    /// larger than Bullet's own "safe margin", a tenth of the smallest half extent.
    template <class Shape>
    static void applyInnerMargin(Shape& shape, double margin, double leastHalfExtent) {
        if (margin == kLibraryMargin) return;
        shape.setMargin(static_cast<btScalar>(std::min(margin, 0.1 * leastHalfExtent)));
    }
};

}  // namespace

BuiltShape buildGeometry(const adapter::Geometry& geometry, const Pose& pose, const ShapeSettings& settings) {
    return std::visit(Builder{pose, settings}, geometry);
}

BodyShape::BodyShape(const scenario::Body& body, const Pose& comFrame, const ShapeSettings& settings) {
    if (!body.collides || body.shapes.empty()) {
        parts_.push_back({std::make_unique<btEmptyShape>(), {}, nullptr});
        root_ = parts_.back().shape.get();
        return;
    }
    const Pose toCom = inverse(comFrame);
    for (std::size_t i = 0; i < body.shapes.size(); ++i) {
        BuiltShape built = buildGeometry(body.shapes[i].geometry, body.pose * body.shapes[i].pose, settings);
        const Pose local = toCom * body.shapes[i].pose * built.offset;
        built.shape->setUserIndex(i);
        built.shape->setUserPointer(const_cast<scenario::ContactFilter*>(&body.shapes[i].filter));
        parts_.push_back(std::move(built));
        if (body.shapes.size() == 1 && local == Pose{}) {
            root_ = parts_.back().shape.get();
            return;
        }
        if (!compound_) compound_ = std::make_unique<btCompoundShape>();
        compound_->addChildShape(toBullet(local), parts_.back().shape.get());
    }
    root_ = compound_.get();
}

}  // namespace rigor::bullet
