// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/fcl/separation.hpp"

#include <fcl/narrowphase/distance.h>

#include <cmath>

namespace rigor::fcl_adapter {
namespace {

/// Tolerance of libccd's distance iteration, FCL's own value: it leaves errors of 2e-4 m at round shapes that
/// are apart, but with a smaller one the assertions of its EPA fail and end the process.
constexpr double kDistanceTolerance = 1e-6;

}  // namespace

bool isPolytope(const adapter::Geometry& geometry) {
    return std::holds_alternative<scenario::Box>(geometry) ||
           std::holds_alternative<scenario::ConvexHull>(geometry);
}

std::optional<Separation> separation(const FclShape& a, const FclShape& b, bool inside,
                                     fcl::GJKSolverType solver) {
    const fcl::DistanceRequestd request(true, inside, 0.0, 0.0, kDistanceTolerance, solver);
    fcl::DistanceResultd result;
    try {
        fcl::distance(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request, result);
    } catch (const std::exception&) {
        return std::nullopt;
    }
    const Separation found{result.min_distance, fromFcl(result.nearest_points[0]),
                           fromFcl(result.nearest_points[1])};
    if (!std::isfinite(found.distance) || std::abs(found.distance) > 1e150) return std::nullopt;
    return found;
}

bool pointsAgree(const Separation& s) {
    return isFinite(s.onA) && isFinite(s.onB) &&
           std::abs(norm(s.onA - s.onB) - std::abs(s.distance)) <= 1e-6 * (1.0 + std::abs(s.distance));
}

adapter::ContactPoint contactOf(const Separation& s) {
    adapter::ContactPoint contact;
    contact.bodyB = 1;
    contact.depth = -s.distance;
    contact.pointA = s.onA;
    contact.pointB = s.onB;
    contact.normal = (s.onA - s.onB) / norm(s.onA - s.onB);
    return contact;
}

}  // namespace rigor::fcl_adapter
