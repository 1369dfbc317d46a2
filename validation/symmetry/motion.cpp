// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Space is homogeneous and knows no rest: the scene elsewhere, and the scene that moves on. The second needs
// everything to move, so a floor becomes a body that moves at a constant velocity; a half-space, which can
// not, stays where its surface moves along itself and has no friction.
#include <algorithm>
#include <cmath>
#include <set>

#include "scenarios/model/surfaces.hpp"
#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr Vec3 kVelocity{1.7, 0.6, -0.9};  ///< [m/s] no multiple of anything, of the size of usual speeds
constexpr double kFar = 500.0;             ///< [m] single precision still resolves 0.03 mm there

bool hasStaticOnlyShape(const Body& b) {
    return std::any_of(b.shapes.begin(), b.shapes.end(),
                       [](const Shape& s) { return isStaticOnly(s.geometry); });
}

/// The velocity, made to lie along every half-space that has to stay.
Vec3 boostOf(const Scenario& s) {
    Vec3 v = s.dimension == 2 ? Vec3{kVelocity.x, kVelocity.y, 0.0} : kVelocity;
    std::vector<Vec3> normals;
    for (const Body& b : s.bodies)
        for (const Shape& shape : b.shapes)
            if (const auto* half = std::get_if<HalfSpace>(&shape.geometry)) {
                Vec3 n = rotate(b.pose.orientation, rotate(shape.pose.orientation, half->normal));
                for (const Vec3& other : normals) n = n - dot(n, other) * other;
                if (norm(n) > 1e-9) normals.push_back(n / norm(n));
            }
    for (const Vec3& n : normals) v = v - dot(v, n) * n;
    return v;
}

/// True if nothing depends on whether a static body stays while the scene moves along it.
bool isFrictionless(const Scenario& s, const Body& fixed) {
    for (const Shape& shape : fixed.shapes)
        for (const Body& b : s.bodies)
            for (const Shape& other : b.shapes)
                if (b.type == BodyType::Dynamic && b.collides &&
                    pairCoefficients(s, shape.material, other.material).friction > 0.0)
                    return false;
    return true;
}

bool holdsToTheWorld(const Scenario& s) {
    return std::any_of(s.joints.begin(), s.joints.end(),
                       [](const Joint& j) { return j.bodyA == kNone || j.bodyB == kNone; }) ||
           std::any_of(s.forces.begin(), s.forces.end(), [](const Force& f) {
               const auto* spring = std::get_if<SpringForce>(&f);
               return spring != nullptr && spring->bodyA == kNone;
           });
}

/// A kinematic body without shapes where the world was; its frame is the world's at the start.
void holdToFrame(Scenario& s) {
    Body frame;
    frame.name = "frame";
    while (findBody(s, frame.name) != kNone) frame.name += "_";
    frame.type = BodyType::Kinematic;
    frame.collides = false;
    const int index = s.bodies.size();
    s.bodies.push_back(frame);
    for (Joint& j : s.joints) {
        if (j.bodyA == kNone) j.bodyA = index;
        if (j.bodyB == kNone) j.bodyB = index;
    }
    for (Force& force : s.forces)
        if (auto* f = std::get_if<SpringForce>(&force))
            if (f->bodyA == kNone) f->bodyA = index;
}

Trajectory movedBack(const Trajectory& trajectory, const Vec3& start, const Vec3& velocity,
                     const std::vector<bool>& stays) {
    const auto offset = [&](double t) { return start + t * velocity; };
    Trajectory t = mapped(
        trajectory,
        [&](BodyState b, double time) {
            b.position = b.position - offset(time);
            b.velocity = b.velocity - velocity;
            return b;
        },
        [&](ContactPoint c, double time) {
            c.pointA = c.pointA - offset(time);
            c.pointB = c.pointB - offset(time);
            return c;
        });
    for (std::size_t f = 0; f < t.frames(); ++f)
        for (std::size_t i = 0; i < stays.size(); ++i)
            if (stays[i]) t.states[f * t.bodyCount + i] = trajectory.state(f, i);
    return t;
}

std::vector<int> firstBodies(std::size_t count) {
    std::vector<int> place(count);
    for (std::size_t i = 0; i < count; ++i) place[i] = i;
    return place;
}

}  // namespace

std::string galileanObstacle(const Scenario& s) {
    for (const Force& f : s.forces)
        if (std::holds_alternative<DragForce>(f)) return "the medium of a drag force stays at rest";
    for (const Body& b : s.bodies) {
        if (b.type == BodyType::Dynamic && (b.linearVelocityKept < 1.0))
            return "damping is measured against the world at rest";
        if (b.type != BodyType::Static || !hasStaticOnlyShape(b)) continue;
        for (const Shape& shape : b.shapes)
            if (!std::holds_alternative<HalfSpace>(shape.geometry))
                return "body " + b.name + " has a shape that only static bodies may have";
        if (!isFrictionless(s, b))
            return "the half-space " + b.name + " can not move along under its friction";
    }
    return norm(boostOf(s)) < 0.1 ? "half-spaces leave no direction to move in" : "";
}

Transformed galilean(const Scenario& scenario, const Trajectory*) {
    require(galileanObstacle(scenario));
    Scenario s = bare(scenario);
    const Vec3 V = boostOf(s);
    const std::size_t bodies = s.bodies.size();
    if (holdsToTheWorld(s)) holdToFrame(s);
    std::vector<bool> stays;
    for (Body& b : s.bodies) {
        stays.push_back(b.type == BodyType::Static && hasStaticOnlyShape(b));
        if (stays.back()) continue;
        if (b.type == BodyType::Static) b.type = BodyType::Kinematic;
        b.velocity += V;
    }
    return {s, 1.0, [V, stays, bodies](const Trajectory& t) {
                return reordered(movedBack(t, {}, V, stays), firstBodies(bodies));
            }};
}

Transformed translation(const Scenario& scenario, const Trajectory*) {
    Scenario s = bare(scenario);
    const Vec3 D{kFar, kFar, s.dimension == 2 ? 0.0 : kFar};
    for (Body& b : s.bodies) b.pose.position += D;
    for (Joint& j : s.joints) {
        if (j.bodyA == kNone) j.anchorA += D;
        if (j.bodyB == kNone) j.anchorB += D;
    }
    for (Force& force : s.forces)
        if (auto* f = std::get_if<SpringForce>(&force))
            if (f->bodyA == kNone) f->anchorA += D;
    return {s, 1.0, [D](const Trajectory& t) { return movedBack(t, D, {}, {}); }};
}

}  // namespace rigor::validation
