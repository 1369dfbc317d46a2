// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Test of the exact motion for obstacles: a wall before the sliding block, a third ball, the box under the
// falling one. The motion is sampled; at each sample points and balls that surely lie inside a body must not
// lie inside another. A motion that runs into something is found, one that only grazes it may not be; one
// that is clear is never refused.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using scenario::BodyType;

constexpr int kSamples = 96;         // times in the run at which the bodies are tested
constexpr double kTolerated = 2e-3;  // overlap beside the size: scenes start up to 1e-4 into the floor

/// A ball inside a body; a vertex has radius zero.
struct Inner {
    Vec3 center;
    double radius = 0.0;
    scenario::ContactFilter filter;
};

std::vector<Inner> innerOf(const Body& body, const Pose& pose, int dimension) {
    std::vector<Inner> result;
    for (const auto& shape : body.shapes) {
        const auto add = [&](Vec3 local, double radius) {
            result.push_back({pose * (shape.pose * local), radius, shape.filter});
        };
        if (const auto* s = std::get_if<scenario::Sphere>(&shape.geometry)) add({}, s->radius);
        if (const auto* s = std::get_if<scenario::Capsule>(&shape.geometry)) add({}, s->radius);
        if (const auto* s = std::get_if<scenario::Cylinder>(&shape.geometry))
            add({}, std::min(s->radius, s->halfLength));
        if (const auto* s = std::get_if<scenario::ConvexHull>(&shape.geometry))
            for (const Vec3 v : s->vertices) add(v, 0.0);
        if (const auto* s = std::get_if<scenario::Box>(&shape.geometry)) {
            const Vec3 h = s->halfExtents;
            const double flat = std::min(h.x, h.y);
            add({}, dimension == 2 ? flat : std::min(flat, h.z));
            for (int corner = 0; corner < (dimension == 2 ? 4 : 8); ++corner)
                add({corner & 1 ? h.x : -h.x, corner & 2 ? h.y : -h.y,
                     dimension == 2 ? 0.0 : (corner & 4 ? h.z : -h.z)},
                    0.0);
        }
    }
    return result;
}

/// Depth of the sphere in a solid; negative outside. Shapes without a simple distance count as far away.
double depthIn(const Body& body, const Pose& pose, const Inner& ball, int dimension) {
    double deepest = -1e300;
    for (const auto& shape : body.shapes) {
        if (!mayTouch(shape.filter, ball.filter)) continue;
        const Vec3 inBody = rotateInverse(pose.orientation, ball.center - pose.position);
        const Vec3 p = rotateInverse(shape.pose.orientation, inBody - shape.pose.position);
        double distance = 1e300;
        if (const auto* s = std::get_if<scenario::Sphere>(&shape.geometry)) distance = norm(p) - s->radius;
        if (const auto* s = std::get_if<scenario::HalfSpace>(&shape.geometry))
            distance = dot(unit(s->normal), p) - s->offset;
        if (const auto* s = std::get_if<scenario::Box>(&shape.geometry)) {
            const double x = std::abs(p.x) - s->halfExtents.x, y = std::abs(p.y) - s->halfExtents.y,
                         z = dimension == 2 ? -1e300 : std::abs(p.z) - s->halfExtents.z;
            const Vec3 out{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)};
            distance = norm(out) + std::min(0.0, std::max({x, y, z}));
        }
        deepest = std::max(deepest, ball.radius - distance);
    }
    return deepest;
}

bool areJoined(const Scenario& scenario, int a, int b) {
    for (const auto& joint : scenario.joints)
        if ((joint.bodyA == a && joint.bodyB == b) || (joint.bodyA == b && joint.bodyB == a)) return true;
    return false;
}

}  // namespace

void requireClearWay(const Scenario& scenario, const Reference& reference) {
    const std::vector<int> known = reference.bodies();
    const auto knows = [&](int i) { return std::find(known.begin(), known.end(), i) != known.end(); };
    const auto size = static_cast<int>(scenario.bodies.size());
    // Bodies that the reference does not know stay where they are, as long as nothing acts on them.
    std::vector<bool> placed(scenario.bodies.size());
    for (int i = 0; i < size; ++i) {
        const Body& body = scenario.bodies[i];
        const bool still = body.velocity == Vec3{} && body.angularVelocity == Vec3{};
        const bool left = body.type != BodyType::Dynamic || gravityOn(scenario, i) == Vec3{};
        placed[i] = knows(i) || (still && left);
    }
    const double end = std::min(scenario.duration, reference.validUntil());
    for (int k = 0; k <= kSamples; ++k) {
        const double t = end * k / kSamples;
        std::vector<Pose> poses;
        for (const auto& body : scenario.bodies) poses.push_back(body.pose);
        std::vector<std::vector<Inner>> inner(scenario.bodies.size());
        for (int i = 0; i < size; ++i) {
            const auto slot = static_cast<std::size_t>(i);
            if (knows(i)) {
                const PartialState exact = reference.exact(i, t);
                if (!exact.position || !exact.orientation) {
                    placed[slot] = false;
                    continue;
                }
                poses[slot] = {*exact.position, *exact.orientation};
            }
            inner[slot] = innerOf(scenario.bodies[slot], poses[slot], scenario.dimension);
        }
        for (const int a : known)
            for (int b = 0; b < size; ++b) {
                const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
                if (a == b || !placed[i] || !placed[j] || !scenario::mayCollide(scenario, a, b) ||
                    areJoined(scenario, a, b))
                    continue;
                const Body &one = scenario.bodies[i], &other = scenario.bodies[j];
                double depth = -1e300;
                for (const Inner& ball : inner[i])
                    depth = std::max(depth, depthIn(other, poses[j], ball, scenario.dimension));
                for (const Inner& ball : inner[j])
                    depth = std::max(depth, depthIn(one, poses[i], ball, scenario.dimension));
                require(depth <= kTolerated * sizeOf(one),
                        bodyTitle(scenario, b) + " stands in the way of " + bodyTitle(scenario, a));
            }
    }
}

}  // namespace rigor::validation
