// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/shape_def.hpp"

#include <cmath>

#include "engine/contacts/moving_shape.hpp"
#include "engine/pipeline/pose_check.hpp"
#include "engine/pipeline/require.hpp"
#include "engine/shapes/inner_sphere.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

// Sizes finite and positive, normals unit: an overload for each shape, so that a new one does not compile
// without.
template <class R>
bool validSize(R x) {
    return x > 0 && std::isfinite(x);
}
template <class S>
bool valid(const Sphere<S>& s) {
    return validSize(s.radius);
}
template <class S>
bool valid(const Capsule<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Box<S>& s) {
    return s.halfExtents.allFinite() && s.halfExtents.minCoeff() > 0;
}
template <class S>
bool valid(const HalfSpace<S>& s) {
    using R = typename S::Real;
    return std::isfinite(s.offset) && std::abs(s.normal.norm() - R(1)) < R(1e-4);
}
template <class S>
bool valid(const Cylinder<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Cone<S>& s) {
    return validSize(s.radius) && validSize(s.halfLength);
}
template <class S>
bool valid(const Ellipsoid<S>& s) {
    return s.halfAxes.allFinite() && s.halfAxes.minCoeff() > 0;
}
template <class S>
bool valid(const Triangle<S>& s) {
    return s.v[0].allFinite() && s.v[1].allFinite() && s.v[2].allFinite() &&
           validSize((s.v[1] - s.v[0]).cross(s.v[2] - s.v[0]).norm());
}
template <class S>
bool valid(const Segment<S>& s) {
    return s.a.allFinite() && s.b.allFinite() && validSize((s.b - s.a).norm());
}
/// Overload for shapes whose data is checked where it is made (makeHull, makeChain, ...).
template <class Shape>
requires requires(const Shape& s) {
    s.data != nullptr;
}
bool valid(const Shape& s) {
    return s.data != nullptr;
}

template <class S>
bool validShape(const Shape<S>& shape) {
    return std::visit([](const auto& s) { return valid(s); }, shape);
}

}  // namespace

template <class S>
void requireBodyType(const Shape<S>& shape, BodyType type) {
    const bool isStatic = type == BodyType::Static;
    require(!std::holds_alternative<HalfSpace<S>>(shape) || isStatic, "half_space_body",
            "a half-space needs a static body");
    require(!isStaticOnly<S>(shape) || isStatic, "surface_body",
            "segments, chains, triangles, meshes and height fields need a static body");
}

template <class S>
ShapeRecord<S> makeShapeRecord(const ShapeDef<S>& def, const BodyConstants<S>& constants,
                               std::uint32_t body) {
    require(validPose<S>(def.pose), "shape_pose", "position must be finite, orientation a unit rotation");
    require(validShape<S>(def.shape), "shape_size",
            "sizes must be positive and finite, normals unit vectors");
    require(def.density >= 0 && std::isfinite(def.density), "shape_density",
            "density must be finite and not negative");
    requireBodyType<S>(def.shape, constants.type);
    ShapeRecord<S> record;
    record.shape = def.shape;
    record.local = {def.pose.p - constants.centerOfMass, normalizedRot(def.pose.q)};
    record.body = body;
    record.material = def.material;
    setSurfaceVelocity<S>(record, def.surfaceVelocity, constants);
    record.filter = def.filter;
    record.sensor = def.sensor;
    record.density = def.sensor ? typename S::Real(0) : def.density;
    record.boundingRadius = coreBoundingRadius<S>(record.shape, record.local);
    record.inscribedRadius = inscribedRadiusOf<S>(record.shape);
    record.middle = middleOf<S>(record.shape);
    record.sphere = boundingSphere<S>(record.shape);
    const Aabb<S> box = boundingBox<S>(record.shape, {});
    record.radius = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).norm();
    return record;
}

template <class S>
void setSurfaceVelocity(ShapeRecord<S>& record, const Velocity<S>& surface,
                        const BodyConstants<S>& constants) {
    require(surface.v.allFinite() && finiteAng(surface.w), "shape_surface_velocity",
            "velocities of a surface must be finite");
    record.surface = {typename S::Vec(surface.v + cross(surface.w, constants.centerOfMass)), surface.w};
    record.hasSurfaceVelocity = !surface.v.isZero(0) || dotAng(surface.w, surface.w) > 0;
}

#define RIGOR_INSTANTIATE(S)                                                                        \
    template void requireBodyType<S>(const Shape<S>&, BodyType);                                    \
    template void setSurfaceVelocity(ShapeRecord<S>&, const Velocity<S>&, const BodyConstants<S>&); \
    template ShapeRecord<S> makeShapeRecord<S>(const ShapeDef<S>&, const BodyConstants<S>&, std::uint32_t);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
