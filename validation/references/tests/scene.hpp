// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small scenes for the tests of references and metrics.
#pragma once

#include "scenarios/model/scenario.hpp"
#include "validation/references/reference.hpp"

namespace rigor::validation::testing {

using namespace scenario;

inline Scenario emptyScene(int dimension, Vec3 gravity, double duration) {
    Scenario s;
    s.name = "test";
    s.dimension = dimension;
    s.gravity = gravity;
    s.duration = duration;
    s.timeSteps = {0.01};
    s.materials = {{"stuff", 0.0, 0.0, 1000.0}};
    return s;
}

inline int addBody(Scenario& s, const std::string& name, BodyType type, Geometry shape, Vec3 position) {
    Body b;
    b.name = name;
    b.type = type;
    b.pose.position = position;
    b.shapes = {{std::move(shape), {}, 0}};
    s.bodies.push_back(std::move(b));
    s.observed.push_back(static_cast<int>(s.bodies.size()) - 1);
    return s.observed.back();
}

/// A joint whose anchor and axis are given in the world; `a` may be kNone, the world.
inline Joint& addJoint(Scenario& s, JointType type, int a, int b, Vec3 anchor, Vec3 axis = {0, 0, 1}) {
    Joint j;
    j.name = "joint" + std::to_string(s.joints.size());
    j.type = type;
    j.bodyA = a;
    j.bodyB = b;
    const auto pose = [&](int body) { return body == kNone ? Pose{} : s.bodies[body].pose; };
    j.anchorA = inverse(pose(a)) * anchor;
    j.anchorB = inverse(pose(b)) * anchor;
    j.axisA = rotateInverse(pose(a).orientation, axis);
    j.axisB = rotateInverse(pose(b).orientation, axis);
    s.joints.push_back(j);
    return s.joints.back();
}

/// A dynamic ball of moment k m r^2.
inline int addBall(Scenario& s, const std::string& name, double radius, double mass, double k, Vec3 position,
                   Vec3 velocity = {}, Vec3 spin = {}) {
    const int i = addBody(s, name, BodyType::Dynamic, Sphere{radius}, position);
    Body& b = s.bodies.back();
    const double moment = k * mass * radius * radius;
    b.massProperties = {mass, {}, Mat3::diagonal(moment, moment, moment)};
    b.velocity = velocity;
    b.angularVelocity = spin;
    return i;
}

inline int addBox(Scenario& s, const std::string& name, Vec3 half, double mass, Vec3 position,
                  Vec3 velocity = {}) {
    const int i = addBody(s, name, BodyType::Dynamic, Box{half}, position);
    Body& b = s.bodies.back();
    const Vec3 q{half.x * half.x, half.y * half.y, half.z * half.z};
    b.massProperties = {
        mass, {}, Mat3::diagonal(mass * (q.y + q.z) / 3, mass * (q.x + q.z) / 3, mass * (q.x + q.y) / 3)};
    b.velocity = velocity;
    return i;
}

inline int addFloor(Scenario& s, Vec3 normal = {0, 1, 0}) {
    return addBody(s, "floor", BodyType::Static, HalfSpace{normal, 0.0}, {});
}

inline void setReference(Scenario& s, const std::string& name,
                         std::map<std::string, ParameterValue> parameters = {}) {
    s.reference = ReferenceSpec{name, std::move(parameters)};
}

/// The run of an ideal engine: the reference's own states at every step.
inline Trajectory exactRun(const Scenario& s, const Reference& reference, double dt, int steps) {
    Trajectory run;
    run.dt = dt;
    run.bodyCount = s.bodies.size();
    for (int k = 0; k <= steps; ++k) {
        run.times.push_back(k * dt);
        run.contacts.emplace_back();
        for (const auto& body : s.bodies)
            run.states.push_back(
                {body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
        for (const int b : reference.bodies()) {
            const PartialState exact = reference.exact(b, run.times.back());
            auto& state = run.states[k * run.bodyCount + b];
            if (exact.position) state.position = *exact.position;
            if (exact.orientation) state.orientation = *exact.orientation;
            if (exact.velocity) state.velocity = *exact.velocity;
            if (exact.angularVelocity) state.angularVelocity = *exact.angularVelocity;
        }
    }
    return run;
}

inline const Quantity* findQuantity(const std::vector<Quantity>& all, const std::string& name) {
    for (const auto& q : all)
        if (q.name == name) return &q;
    return nullptr;
}

}  // namespace rigor::validation::testing
