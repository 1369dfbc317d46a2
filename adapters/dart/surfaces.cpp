// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/surfaces.hpp"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

namespace rigor::dart_adapter {

using dart::dynamics::ShapeFrame;

bool Surfaces::findsBothSides(const ShapeFrame* of) const {
    const std::string& kind = of->getShape()->getType();
    const bool box = kind == dart::dynamics::BoxShape::getStaticType();
    const bool ball = kind == dart::dynamics::SphereShape::getStaticType();
    return (narrowPhase_ == "ode" && box) || (narrowPhase_ == "fcl_primitive" && (box || ball));
}

/// True where this narrow phase has normals from the front of a mesh alone, wherever the shape is.
bool Surfaces::findsWrongSide(const ShapeFrame* of) const {
    return narrowPhase_ == "ode" ? of->getShape()->getType() == dart::dynamics::MeshShape::getStaticType()
                                 : !findsBothSides(of);
}

bool Surfaces::mayMeet(const ShapeFrame* one, const ShapeFrame* two) const {
    const auto isBack = [&](const ShapeFrame* of) {
        const auto at = isBack_.find(of);
        return at != isBack_.end() && at->second;
    };
    return !(isBack(one) && findsBothSides(two)) && !(isBack(two) && findsBothSides(one));
}

namespace {

/// True where `point` is on the side of a triangle of the mesh from which its corners run anticlockwise.
bool isInFront(const ShapeFrame& mesh, int triangle, const Eigen::Vector3d& point) {
    const auto& shape = dynamic_cast<const dart::dynamics::MeshShape&>(*mesh.getShape());
    const aiMesh& all = *shape.getMesh()->mMeshes[0];
    const auto corner = [&](int k) {
        const aiVector3D& v = all.mVertices[all.mFaces[triangle].mIndices[k]];
        return Eigen::Vector3d(v.x, v.y, v.z);
    };
    const Eigen::Vector3d first = corner(0), normal = (corner(1) - first).cross(corner(2) - first);
    return normal.dot(mesh.getWorldTransform().inverse() * point - first) > 0.0;
}

}  // namespace

bool Surfaces::pushesOut(const dart::collision::Contact& contact) const {
    const auto *first = contact.collisionObject1->getShapeFrame(),
               *second = contact.collisionObject2->getShapeFrame();
    const bool firstIsMesh = isBack_.contains(first);
    if (firstIsMesh == isBack_.contains(second)) return true;
    const ShapeFrame* body = firstIsMesh ? second : first;
    if (!findsWrongSide(body)) return true;
    // The normal points to the first.
    const Eigen::Vector3d push = firstIsMesh ? Eigen::Vector3d(-contact.normal) : contact.normal;
    const Eigen::Vector3d middle =
        body->getWorldTransform() * body->getShape()->getBoundingBox().computeCenter();
    // ODE's contacts do not name their triangles.
    if (narrowPhase_ != "ode" &&
        !isInFront(firstIsMesh ? *first : *second, firstIsMesh ? contact.triID1 : contact.triID2, middle))
        return false;
    return push.dot(middle - contact.point) > 0.0;
}

}  // namespace rigor::dart_adapter
