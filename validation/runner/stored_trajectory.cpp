// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/stored_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

scenario::Vec3 vec(const double* v) {
    return {v[0], v[1], v[2]};
}

BodyState stateAt(const results::BodyChannels& body, std::size_t frame) {
    const double* q = body.orientation.values.data() + 4 * frame;
    return {vec(body.position.values.data() + 3 * frame),
            {q[0], q[1], q[2], q[3]},
            vec(body.velocity.values.data() + 3 * frame),
            vec(body.angularVelocity.values.data() + 3 * frame)};
}

ContactPoint storedContact(const results::ContactSample& c) {
    ContactPoint out;
    out.bodyA = c.bodyA;
    out.bodyB = c.bodyB;
    out.shapeA = c.shapeA;
    out.shapeB = c.shapeB;
    out.pointA = vec(c.pointA);
    out.pointB = vec(c.pointB);
    out.normal = vec(c.normal);
    out.depth = c.depth;
    out.hasImpulse = !std::isnan(c.normalImpulse);
    if (!out.hasImpulse) return out;
    out.normalImpulse = c.normalImpulse;
    out.frictionImpulse = vec(c.frictionImpulse);
    return out;
}

}  // namespace

Trajectory trajectoryOf(const results::TrajectoryFile& file) {
    results::requireStates(file);
    Trajectory t;
    t.dt = file.dt;
    t.stride = file.stride;
    t.bodyCount = file.bodies.size();
    t.times = file.times;
    t.contacts.resize(t.frames());
    if (file.contactsAtStepEnd) t.contactInstant = adapter::ContactInstant::StepEnd;
    t.states.reserve(t.frames() * t.bodyCount);
    for (std::size_t f = 0; f < t.frames(); ++f)
        for (const auto& body : file.bodies) t.states.push_back(stateAt(body, f));
    for (const auto& contact : file.contacts) {
        const auto it = std::lower_bound(t.times.begin(), t.times.end(), contact.time);
        if (it != t.times.end()) t.contacts[it - t.times.begin()].push_back(storedContact(contact));
    }
    return t;
}

}  // namespace rigor::validation
