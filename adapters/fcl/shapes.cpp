// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes as FCL geometries. FCL's capsules, cylinders and cones lie along z, centred, and take the length
// without caps; boxes take full sides; a half-space is solid where n.x < d.
#include "adapters/fcl/shapes.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>

#include <cmath>

#include "scenarios/model/hull.hpp"

namespace rigor::fcl_adapter {
namespace {

using adapter::Pose;
using adapter::Vec3;

struct ToGeometry {
    Vec3 origin;          ///< origin of FCL's frame in the shape's frame
    bool alongZ = false;  ///< FCL's z axis is the format's y axis

    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Sphere& s) {
        return std::make_shared<fcl::Sphered>(s.radius);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Box& b) {
        const Vec3& h = b.halfExtents;
        return std::make_shared<fcl::Boxd>(2 * h.x, 2 * h.y, 2 * h.z);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Ellipsoid& e) {
        return std::make_shared<fcl::Ellipsoidd>(e.halfAxes.x, e.halfAxes.y, e.halfAxes.z);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Capsule& c) {
        alongZ = true;
        return std::make_shared<fcl::Capsuled>(c.radius, 2 * c.halfLength);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Cylinder& c) {
        alongZ = true;
        return std::make_shared<fcl::Cylinderd>(c.radius, 2 * c.halfLength);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::Cone& c) {
        alongZ = true;
        return std::make_shared<fcl::Coned>(c.radius, 2 * c.halfLength);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::ConvexHull& hull) {
        const scenario::HullMesh mesh = scenario::convexHull3d(hull.vertices);
        // The solvers start from the frame's origin, which has to be inside.
        for (const Vec3& v : mesh.vertices) origin += v / mesh.vertices.size();
        auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
        for (const Vec3& v : mesh.vertices) vertices->push_back(toFcl(v - origin));
        auto faces = std::make_shared<std::vector<int>>();
        for (const auto& face : mesh.faces) {
            faces->push_back(face.size());
            faces->insert(faces->end(), face.begin(), face.end());
        }
        return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.faces.size()), faces);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::HalfSpace& h) {
        return std::make_shared<fcl::Halfspaced>(toFcl(h.normal), h.offset);
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::TriangleMesh& mesh) {
        std::vector<fcl::Vector3d> vertices;
        for (const Vec3& v : mesh.vertices) vertices.push_back(toFcl(v));
        std::vector<fcl::Triangle> triangles;
        for (const auto& t : mesh.triangles)
            triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                                   static_cast<std::size_t>(t[2]));
        auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
        model->beginModel();
        model->addSubModel(vertices, triangles);
        model->endModel();
        return model;
    }
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const scenario::HeightField&) {
        throw adapter::notInLibrary("fcl", "shape 'height_field'", kNoHeightField);
    }
    template <class Other>
    std::shared_ptr<fcl::CollisionGeometryd> operator()(const Other& other) {
        throw adapter::notInAdapter("fcl", std::string("shape '") + scenario::geometryName(other, 3) + "'");
    }
};

}  // namespace

fcl::Transform3d transformOf(const Pose& pose) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    const scenario::Mat3 R = toMatrix(normalized(pose.orientation));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) transform.linear()(i, j) = R(i, j);
    transform.translation() = toFcl(pose.position);
    return transform;
}

FclShape toFcl(const adapter::Geometry& geometry, const Pose& pose) {
    ToGeometry convert;
    FclShape shape;
    shape.geometry = std::visit(convert, geometry);
    // A quarter turn about -x takes z to y.
    const double half = std::sqrt(0.5);
    const scenario::Quat turn = convert.alongZ ? scenario::Quat{half, -half, 0, 0} : scenario::Quat{};
    shape.pose = transformOf(pose * Pose{convert.origin, turn});
    return shape;
}

}  // namespace rigor::fcl_adapter
