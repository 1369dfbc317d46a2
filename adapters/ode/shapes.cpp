// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes as ODE geoms. ODE's capsules and cylinders lie along z and take the length without caps; boxes take
// full sides; a plane is solid where n.x < d and has no pose of its own; a convex needs its frame inside it.
#include "adapters/ode/shapes.hpp"

#include <cmath>

#include "adapters/ode/convert.hpp"
#include "scenarios/model/hull.hpp"

namespace rigor::ode {

using adapter::Geometry;

namespace {

/// Turns ODE's z axis into the format's y axis: a quarter turn about -x.
const Quat kFromZToY{std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0};

void place(dGeomID geom, const Pose& pose) {
    dQuaternion q;
    toOde(pose.orientation, q);
    dGeomSetPosition(geom, pose.position.x, pose.position.y, pose.position.z);
    dGeomSetQuaternion(geom, q);
}

}  // namespace

Geom::Geom(const Geometry& geometry, const Pose& pose) {
    if (const auto* sphere = std::get_if<scenario::Sphere>(&geometry)) {
        id_ = dCreateSphere(nullptr, sphere->radius);
    } else if (const auto* box = std::get_if<scenario::Box>(&geometry)) {
        id_ = dCreateBox(nullptr, 2 * box->halfExtents.x, 2 * box->halfExtents.y, 2 * box->halfExtents.z);
    } else if (const auto* capsule = std::get_if<scenario::Capsule>(&geometry)) {
        id_ = dCreateCapsule(nullptr, capsule->radius, 2 * capsule->halfLength);
        frame_.orientation = kFromZToY;
    } else if (const auto* cylinder = std::get_if<scenario::Cylinder>(&geometry)) {
        id_ = dCreateCylinder(nullptr, cylinder->radius, 2 * cylinder->halfLength);
        frame_.orientation = kFromZToY;
    } else if (const auto* hull = std::get_if<scenario::ConvexHull>(&geometry)) {
        createConvex(*hull);
    } else if (const auto* mesh = std::get_if<scenario::TriangleMesh>(&geometry)) {
        createMesh(*mesh);
    } else if (const auto* field = std::get_if<scenario::HeightField>(&geometry)) {
        createField(*field);
    } else if (const auto* half = std::get_if<scenario::HalfSpace>(&geometry)) {
        const Vec3 n = rotate(pose.orientation, half->normal);
        id_ = dCreatePlane(nullptr, n.x, n.y, n.z, half->offset + dot(n, pose.position));
        return;
    } else {
        throw adapter::notInAdapter("ode", std::string("shape '") + geometryName(geometry, 3) + "'");
    }
    place(id_, pose * frame_);
    if (back_ != nullptr) place(back_, pose * frame_);
}

Geom::~Geom() {
    dGeomDestroy(id_);
    if (back_ != nullptr) dGeomDestroy(back_);
}

void Geom::createConvex(const scenario::ConvexHull& hull) {
    const scenario::HullMesh mesh = scenario::convexHull3d(hull.vertices);
    for (const Vec3& v : mesh.vertices) frame_.position += v / mesh.vertices.size();
    convex_ = std::make_unique<Convex>();
    const auto corner = [&](int i) { return mesh.vertices[i] - frame_.position; };
    for (int i = 0; i < static_cast<int>(mesh.vertices.size()); ++i)
        for (const double c : {corner(i).x, corner(i).y, corner(i).z}) convex_->points.push_back(c);
    for (const auto& face : mesh.faces) {
        // Newell's sum: twice the area along the outward normal of a counter-clockwise loop.
        Vec3 n, middle;
        for (std::size_t i = 0; i < face.size(); ++i) {
            n += cross(corner(face[i]), corner(face[(i + 1) % face.size()]));
            middle += corner(face[i]) / face.size();
        }
        n = n / norm(n);
        for (const double c : {n.x, n.y, n.z, dot(n, middle)}) convex_->planes.push_back(c);
        convex_->polygons.push_back(face.size());
        for (const int i : face) convex_->polygons.push_back(i);
    }
    id_ = dCreateConvex(nullptr, convex_->planes.data(), mesh.faces.size(), convex_->points.data(),
                        mesh.vertices.size(), convex_->polygons.data());
}

Geom::Mesh::~Mesh() {
    for (const dTriMeshDataID each : data)
        if (each != nullptr) dGeomTriMeshDataDestroy(each);
}
Geom::Field::~Field() {
    if (data != nullptr) dGeomHeightfieldDataDestroy(data);
}

void Geom::createMesh(const scenario::TriangleMesh& mesh) {
    mesh_ = std::make_unique<Mesh>();
    for (const Vec3& v : mesh.vertices)
        for (const double c : {v.x, v.y, v.z, 0.0}) mesh_->vertices.push_back(c);
    for (const auto& t : mesh.triangles) {
        for (const int i : {t[0], t[1], t[2]}) mesh_->front.push_back(i);
        for (const int i : {t[0], t[2], t[1]}) mesh_->back.push_back(i);
    }
    const auto create = [&](dTriMeshDataID& data, const std::vector<dTriIndex>& indices) {
        data = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSimple(data, mesh_->vertices.data(), mesh.vertices.size(), indices.data(),
                                    indices.size());
        // Convex geoms raise an error at meshes without the angles between their faces.
        dGeomTriMeshDataPreprocess2(data, 1U << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
        return dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    };
    id_ = create(mesh_->data[0], mesh_->front);
    back_ = create(mesh_->data[1], mesh_->back);
}

bool Geom::meetsBacks(dGeomID geom) {
    const int kind = dGeomGetClass(geom);
    return kind == dSphereClass || kind == dCapsuleClass || kind == dCylinderClass || kind == dConvexClass;
}

/// ODE's height fields are those of the format: heights along y, centred in x and z, x running fastest, cells
/// split from (i + 1, k) to (i, k + 1). It is not wrapped: a wrapped one repeats without end.
void Geom::createField(const scenario::HeightField& field) {
    field_ = std::make_unique<Field>();
    field_->data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(field_->data, field.heights.data(), 1,
                                    field.spacingX * (field.columns - 1), field.spacingZ * (field.rows - 1),
                                    field.columns, field.rows, 1.0, 0.0, field.thickness, 0);
    id_ = dCreateHeightfield(nullptr, field_->data, 1);
}

void Geom::attach(dBodyID body, const Pose& inBody) {
    const Pose offset = inBody * frame_;
    dQuaternion q;
    toOde(offset.orientation, q);
    dGeomSetBody(id_, body);
    dGeomSetOffsetPosition(id_, offset.position.x, offset.position.y, offset.position.z);
    dGeomSetOffsetQuaternion(id_, q);
}

void Geom::setTag(const GeomTag& tag) {
    tag_ = backTag_ = tag;
    backTag_.back = true;
    dGeomSetData(id_, &tag_);
    if (back_ != nullptr) dGeomSetData(back_, &backTag_);
}

const GeomTag& Geom::tagOf(dGeomID geom) {
    return *static_cast<const GeomTag*>(dGeomGetData(geom));
}

}  // namespace rigor::ode
