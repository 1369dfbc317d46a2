// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/shapes.hpp"

#include <assimp/scene.h>

#include <cmath>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <numbers>

#include "scenarios/model/hull.hpp"

namespace rigor::dart_adapter {
namespace {

using scenario::ConvexHull;
using scenario::fromAxisAngle;
using scenario::HalfSpace;
using scenario::HeightField;
using scenario::HullMesh;
using scenario::TriangleMesh;

/// DART's capsules and cylinders lie along z, the scenario's along y.
const Quat kAlongZ = fromAxisAngle({1.0, 0.0, 0.0}, -0.5 * std::numbers::pi);

/// A mesh as assimp holds it, which MeshShape frees.
aiScene* sceneOf(const TriangleMesh& mesh) {
    auto* scene = new aiScene;
    scene->mNumMaterials = 1;
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    scene->mNumMeshes = 1;
    scene->mMeshes = new aiMesh* [1] { new aiMesh };
    aiMesh& out = *scene->mMeshes[0];
    out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    out.mNumVertices = static_cast<unsigned>(mesh.vertices.size());
    out.mVertices = new aiVector3D[mesh.vertices.size()];
    out.mNormals = new aiVector3D[mesh.vertices.size()];
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& v = mesh.vertices[i];
        out.mVertices[i] =
            aiVector3D(static_cast<ai_real>(v.x), static_cast<ai_real>(v.y), static_cast<ai_real>(v.z));
        out.mNormals[i] = aiVector3D(0, 1, 0);
    }
    out.mNumFaces = static_cast<unsigned>(mesh.triangles.size());
    out.mFaces = new aiFace[mesh.triangles.size()];
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        out.mFaces[i].mNumIndices = 3;
        out.mFaces[i].mIndices = new unsigned[3];
        for (int k = 0; k < 3; ++k) out.mFaces[i].mIndices[k] = static_cast<unsigned>(mesh.triangles[i][k]);
    }
    scene->mRootNode = new aiNode;
    scene->mRootNode->mNumMeshes = 1;
    scene->mRootNode->mMeshes = new unsigned[1]{0};
    return scene;
}

dart::dynamics::ShapePtr meshShape(const TriangleMesh& mesh) {
    return std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), sceneOf(mesh));
}

/// Front and back.
std::vector<DartShape> bothSides(const TriangleMesh& mesh) {
    TriangleMesh back = mesh;
    for (auto& triangle : back.triangles) std::swap(triangle[1], triangle[2]);
    return {{meshShape(mesh), {}, true, false}, {meshShape(back), {}, true, true}};
}

TriangleMesh surfaceOf(const ConvexHull& hull) {
    const HullMesh mesh = scenario::convexHull3d(hull.vertices);
    TriangleMesh out;
    out.vertices = mesh.vertices;
    for (const auto& face : mesh.faces)
        for (std::size_t k = 2; k < face.size(); ++k)
            out.triangles.push_back({face[0], face[k - 1], face[k]});
    return out;
}

/// A plane, or a box with a face in it.
DartShape groundShape(const HalfSpace& space, bool planes) {
    if (planes) return {std::make_shared<dart::dynamics::PlaneShape>(toDart(space.normal), space.offset), {}};
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), toDart(space.normal));
    Pose frame;
    frame.orientation = {turn.w(), turn.x(), turn.y(), turn.z()};
    frame.position = (space.offset - kGroundHalfSide) * space.normal;
    const double side = 2.0 * kGroundHalfSide;
    return {std::make_shared<dart::dynamics::BoxShape>(Eigen::Vector3d::Constant(side)), frame};
}

DartShape cylinder(double radius, double halfLength) {
    return {std::make_shared<dart::dynamics::CylinderShape>(radius, 2.0 * halfLength), {{}, kAlongZ}};
}

/// DART's use of FCL has no capsules: "unsupported shape type", and a ball of 0.1 m in its place.
std::vector<DartShape> capsule(const scenario::Capsule& of, bool whole) {
    if (whole)
        return {
            {std::make_shared<dart::dynamics::CapsuleShape>(of.radius, 2.0 * of.halfLength), {{}, kAlongZ}}};
    const auto cap = std::make_shared<dart::dynamics::SphereShape>(of.radius);
    return {cylinder(of.radius, of.halfLength),
            {cap, {{0.0, of.halfLength, 0.0}, {}}},
            {cap, {{0.0, -of.halfLength, 0.0}, {}}}};
}

/// DART's height maps have their heights along z and their rows along -y, and split cells as the format does.
DartShape heightField(const HeightField& field, const std::string& narrowPhase) {
    if (narrowPhase != "ode")
        throw adapter::notInLibrary(
            "dart", "shape 'height_field' with narrow_phase=" + narrowPhase,
            "message of FCLCollisionDetector: unsupported shape type [HeightmapShape (d)]");
    const auto map = std::make_shared<dart::dynamics::HeightmapShaped>();
    map->setHeightField(static_cast<std::size_t>(field.columns), static_cast<std::size_t>(field.rows),
                        field.heights);
    map->setScale({field.spacingX, field.spacingZ, 1.0});
    return {map, {{}, kAlongZ}};
}

DartShape ellipsoid(const scenario::Ellipsoid& of, const std::string& narrowPhase) {
    if (narrowPhase == "ode")
        throw adapter::notInLibrary(
            "dart", "shape 'ellipsoid' with narrow_phase=ode",
            "message of OdeCollisionDetector: unsupported shape type 'EllipsoidShape'");
    return {std::make_shared<dart::dynamics::EllipsoidShape>(2.0 * toDart(of.halfAxes)), {}};
}

}  // namespace

std::vector<DartShape> makeShapes(const adapter::Geometry& geometry, const std::string& narrowPhase) {
    using dart::dynamics::BoxShape;
    using dart::dynamics::SphereShape;
    if (const auto* s = std::get_if<scenario::Sphere>(&geometry))
        return {{std::make_shared<SphereShape>(s->radius), {}}};
    if (const auto* s = std::get_if<scenario::Box>(&geometry))
        return {{std::make_shared<BoxShape>(2.0 * toDart(s->halfExtents)), {}}};
    if (const auto* s = std::get_if<HalfSpace>(&geometry)) return {groundShape(*s, narrowPhase == "ode")};
    const std::string name = scenario::geometryName(geometry, 3);
    if (narrowPhase == "dart")
        throw adapter::notInLibrary("dart", "shape '" + name + "' with narrow_phase=dart",
                                    "message of DARTCollisionDetector: boxes and ellipsoids of equal radii");
    if (const auto* s = std::get_if<scenario::Capsule>(&geometry)) return capsule(*s, narrowPhase == "ode");
    if (const auto* s = std::get_if<scenario::Cylinder>(&geometry))
        return {cylinder(s->radius, s->halfLength)};
    if (const auto* s = std::get_if<ConvexHull>(&geometry)) return {{meshShape(surfaceOf(*s)), {}}};
    if (const auto* s = std::get_if<TriangleMesh>(&geometry)) return bothSides(*s);
    if (const auto* s = std::get_if<HeightField>(&geometry)) return {heightField(*s, narrowPhase)};
    if (const auto* s = std::get_if<scenario::Ellipsoid>(&geometry)) return {ellipsoid(*s, narrowPhase)};
    throw adapter::notInAdapter("dart", "shape '" + name + "'");
}

dart::collision::CollisionDetectorPtr makeDetector(const std::string& narrowPhase) {
    using dart::collision::FCLCollisionDetector;
    if (narrowPhase == "dart") return dart::collision::DARTCollisionDetector::create();
    if (narrowPhase == "ode") return dart::collision::OdeCollisionDetector::create();
    auto detector = FCLCollisionDetector::create();
    detector->setPrimitiveShapeType(narrowPhase == "fcl_mesh" ? FCLCollisionDetector::MESH
                                                              : FCLCollisionDetector::PRIMITIVE);
    return detector;
}

}  // namespace rigor::dart_adapter
