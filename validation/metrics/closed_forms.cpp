// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See closed_forms.hpp.
#include "validation/metrics/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rigor::validation {
namespace {

using namespace scenario;

std::optional<PairGeometry> spheres(const Sphere& a, Vec3 ca, const Sphere& b, Vec3 cb) {
    const Vec3 d = cb - ca;
    const double length = norm(d);
    if (!(length > 0.0)) return std::nullopt;
    return PairGeometry{length - a.radius - b.radius, d / length};
}

/// Normal from the sphere to the box.
std::optional<PairGeometry> sphereBox(const Sphere& sphere, Vec3 center, const Box& box, const Pose& pose,
                                      int dimension) {
    const Vec3 local = inverse(pose) * center, h = box.halfExtents;
    const Vec3 nearest{std::clamp(local.x, -h.x, h.x), std::clamp(local.y, -h.y, h.y),
                       dimension == 2 ? local.z : std::clamp(local.z, -h.z, h.z)};
    const Vec3 toBox = nearest - local;
    const double length = norm(toBox);
    if (!(length > 0.0)) return std::nullopt;
    return PairGeometry{length - sphere.radius, rotate(pose.orientation, toBox / length)};
}

/// Lowest reach of a convex shape along the unit vector n, relative to the world origin.
std::optional<double> lowest(const Geometry& geometry, const Pose& pose, Vec3 n, int dimension) {
    std::vector<Vec3> points;
    double radius = 0.0;
    if (const auto* s = std::get_if<Sphere>(&geometry)) {
        points = {{}};
        radius = s->radius;
    } else if (const auto* c = std::get_if<Capsule>(&geometry)) {
        points = {{0, -c->halfLength, 0}, {0, c->halfLength, 0}};
        radius = c->radius;
    } else if (const auto* hull = std::get_if<ConvexHull>(&geometry)) {
        points = hull->vertices;
    } else if (const auto* box = std::get_if<Box>(&geometry)) {
        const Vec3 h = box->halfExtents;
        for (const double x : {-h.x, h.x})
            for (const double y : {-h.y, h.y})
                for (const double z : {-h.z, h.z}) points.push_back({x, y, dimension == 2 ? 0.0 : z});
    } else if (const auto* e = std::get_if<Ellipsoid>(&geometry)) {
        const Vec3 m = rotateInverse(pose.orientation, n), h = e->halfAxes;
        return dot(n, pose.position) - norm(Vec3{h.x * m.x, h.y * m.y, h.z * m.z});
    } else {
        return std::nullopt;
    }
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3 p : points) low = std::min(low, dot(n, pose * p) - radius);
    return low;
}

std::optional<PairGeometry> onHalfSpace(const Geometry& geometry, const Pose& pose, const HalfSpace& half,
                                        const Pose& halfPose, int dimension) {
    const Vec3 n = rotate(halfPose.orientation, half.normal);
    const auto low = lowest(geometry, pose, n, dimension);
    if (!low) return std::nullopt;
    return PairGeometry{*low - dot(n, halfPose.position) - half.offset, -n};
}

std::optional<PairGeometry> reversed(std::optional<PairGeometry> pair) {
    if (pair) pair->normal = -pair->normal;
    return pair;
}

}  // namespace

std::optional<PairGeometry> closedFormPair(const Geometry& a, const Pose& poseA, const Geometry& b,
                                           const Pose& poseB, int dimension) {
    const auto *sa = std::get_if<Sphere>(&a), *sb = std::get_if<Sphere>(&b);
    if (sa && sb) return spheres(*sa, poseA.position, *sb, poseB.position);
    if (const auto* half = std::get_if<HalfSpace>(&b)) return onHalfSpace(a, poseA, *half, poseB, dimension);
    if (const auto* half = std::get_if<HalfSpace>(&a))
        return reversed(onHalfSpace(b, poseB, *half, poseA, dimension));
    if (const auto* box = std::get_if<Box>(&b); box && sa)
        return sphereBox(*sa, poseA.position, *box, poseB, dimension);
    if (const auto* box = std::get_if<Box>(&a); box && sb)
        return reversed(sphereBox(*sb, poseB.position, *box, poseA, dimension));
    return std::nullopt;
}

}  // namespace rigor::validation
