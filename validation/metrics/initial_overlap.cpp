// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Excess of the engine's penetration over that of the scenario's poses: contacts of the first step were found
// at the initial poses, where the exact overlap along their normals is that of the supporting planes. Margins
// that grow shapes outwards show here, and only here before anything has moved.
// Source: Ericson, Real-Time Collision Detection, 2005, section 4.2 (extent of a shape along a direction).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "validation/metrics/metric_parts.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kSameDirection = 0.1;  // [rad]

/// The normal of the half-space where one of the two is one and the contact's normal is meant to be its own:
/// a half-space is bounded along that direction alone, to the last digit.
Vec3 directionFor(const ContactPoint& contact, const Shape& a, const Pose& poseA, const Shape& b,
                  const Pose& poseB) {
    const auto snapped = [&](const Shape& shape, const Pose& pose, double sign) {
        const auto* plane = std::get_if<HalfSpace>(&shape.geometry);
        if (plane == nullptr) return contact.normal;
        const Vec3 own = sign * rotate(pose.orientation, plane->normal);
        return angleBetween(own, contact.normal) < kSameDirection ? own : contact.normal;
    };
    const bool isPlaneA = std::holds_alternative<HalfSpace>(a.geometry);
    return isPlaneA ? snapped(a, poseA, 1.0) : snapped(b, poseB, -1.0);
}

/// The deepest overlap along the contact's normal of any shape of A with any of B [m], negative when apart;
/// empty where a pair has no exact result.
std::optional<double> exactDepth(const MetricInput& input, const ContactPoint& contact) {
    const auto bodyPose = [&](int body) {
        const BodyState& s = input.trajectory.state(0, body);
        return Pose{s.position, s.orientation};
    };
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Shape& a : input.scenario.bodies[contact.bodyA].shapes)
        for (const Shape& b : input.scenario.bodies[contact.bodyB].shapes) {
            const Pose poseA = bodyPose(contact.bodyA) * a.pose, poseB = bodyPose(contact.bodyB) * b.pose;
            const auto apart = separationAlong(a.geometry, poseA, b.geometry, poseB, input.scenario.dimension,
                                               directionFor(contact, a, poseA, b, poseB));
            if (!apart) return std::nullopt;
            deepest = std::max(deepest, -*apart);
        }
    return deepest;
}

}  // namespace

std::vector<MetricValue> initialOverlap(const MetricInput& input) {
    const int bodies = input.scenario.bodies.size();
    if (input.trajectory.contacts.empty()) return {};
    std::map<int, Worst> worst;
    for (const ContactPoint& contact : input.trajectory.contacts.front()) {
        if (std::min(contact.bodyA, contact.bodyB) < 0 || std::max(contact.bodyA, contact.bodyB) >= bodies)
            continue;
        const std::optional<double> exact = exactDepth(input, contact);
        if (!exact) continue;
        for (const int body : {contact.bodyA, contact.bodyB})
            if (isDynamic(input.scenario, body)) worst[body].add(std::max(0.0, contact.depth - *exact), 0.0);
    }
    std::vector<MetricValue> rows;
    for (const auto& [body, value] : worst) rows.push_back(value.row(bodyName(input, body)));
    return withWorst(std::move(rows));
}

}  // namespace rigor::validation
