// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/surface_points.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::adapter {
namespace {

/// Distance from the region x <= 0, y <= 0 of a plane, as boxes and cylinders look from outside and inside.
double cornerDistance(double x, double y) {
    return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0);
}

struct PointDistance {
    Vec3 p;
    std::optional<double> operator()(const scenario::Sphere& s) const { return norm(p) - s.radius; }
    std::optional<double> operator()(const scenario::Box& b) const {
        const Vec3 q{std::abs(p.x) - b.halfExtents.x, std::abs(p.y) - b.halfExtents.y,
                     std::abs(p.z) - b.halfExtents.z};
        const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
        return norm(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
    }
    std::optional<double> operator()(const scenario::Capsule& c) const {
        const double y = p.y - std::clamp(p.y, -c.halfLength, c.halfLength);
        return norm(Vec3{p.x, y, p.z}) - c.radius;
    }
    std::optional<double> operator()(const scenario::Cylinder& c) const {
        return cornerDistance(std::hypot(p.x, p.z) - c.radius, std::abs(p.y) - c.halfLength);
    }
    std::optional<double> operator()(const scenario::Cone& c) const {
        const double height = 2.0 * c.halfLength, slant = std::hypot(height, c.radius);
        const double side = (std::hypot(p.x, p.z) * height + (p.y - c.halfLength) * c.radius) / slant;
        return std::max(side, -c.halfLength - p.y);
    }
    std::optional<double> operator()(const scenario::HalfSpace& h) const {
        return dot(h.normal, p) - h.offset;
    }
    template <class Other>
    std::optional<double> operator()(const Other&) const {
        return std::nullopt;  // no simple distance
    }
};

std::optional<double> distanceTo(const PosedShape& shape, const Vec3& point) {
    return pointDistance(*shape.geometry, inverse(shape.pose) * point);
}

}  // namespace

std::optional<double> pointDistance(const Geometry& geometry, const Vec3& point) {
    return std::visit(PointDistance{point}, geometry);
}

SurfacePoints surfacePoints(const PosedShape& a, const PosedShape& b, const Vec3& reported,
                            const Vec3& normal, double depth) {
    if (const auto* sphere = std::get_if<scenario::Sphere>(a.geometry)) {
        const Vec3 onA = a.pose.position + sphere->radius * normal;
        return {onA, onA - depth * normal};
    }
    if (const auto* sphere = std::get_if<scenario::Sphere>(b.geometry)) {
        const Vec3 onB = b.pose.position - sphere->radius * normal;
        return {onB + depth * normal, onB};
    }
    SurfacePoints best;
    double least = INFINITY;
    const auto consider = [&](const Vec3& onA) {
        const SurfacePoints points{onA, onA - depth * normal};
        const double error = std::abs(distanceTo(a, points.onA).value_or(0.0)) +
                             std::abs(distanceTo(b, points.onB).value_or(0.0));
        if (error < least - 1e-12) {
            least = error;
            best = points;
        }
    };
    for (const double s : {0.5, 0.0, 1.0}) consider(reported + s * depth * normal);
    // The normal leads out of A and into B: one step along it reaches a surface that is not too curved.
    if (const auto d = distanceTo(a, reported)) consider(reported - *d * normal);
    if (const auto d = distanceTo(b, reported)) consider(reported + (*d + depth) * normal);
    return best;
}

}  // namespace rigor::adapter
