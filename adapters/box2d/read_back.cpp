// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of Box2D's objects: states, contacts, what was built, counters.
#include <algorithm>
#include <cmath>

#include "adapters/box2d/world.hpp"

namespace rigor::box2d {

using adapter::BodyState;
using adapter::ContactPoint;

BodyState Box2dWorld::stateOf(const BodyRecord& record) const {
    const Pose pose =
        fromBox2d(record.body->GetPosition(), record.body->GetAngle(), scale_) * inverse(record.frame);
    return {pose.position,
            pose.orientation,
            fromBox2d(record.body->GetLinearVelocity(), scale_),
            {0.0, 0.0, record.body->GetAngularVelocity()}};
}

void Box2dWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < records_.size(); ++i) states[i] = stateOf(*records_[i]);
}

/// The manifolds of Box2D after a step are still those found at its start; bodies have moved on, so the
/// manifold is placed with the poses kept from then.
void Box2dWorld::appendContact(const b2Contact& contact, std::vector<ContactPoint>& contacts) const {
    if (!contact.IsTouching() || !contact.IsEnabled()) return;
    auto* fixtureA = const_cast<b2Fixture*>(contact.GetFixtureA());
    auto* fixtureB = const_cast<b2Fixture*>(contact.GetFixtureB());
    const auto awake = [](const b2Body* body) { return body->IsAwake() && body->GetType() != b2_staticBody; };
    // A contact between sleeping bodies stays, but the step did not solve it.
    const bool solved = awake(fixtureA->GetBody()) || awake(fixtureB->GetBody());
    const auto& tagA = *reinterpret_cast<const FixtureTag*>(fixtureA->GetUserData().pointer);
    const auto& tagB = *reinterpret_cast<const FixtureTag*>(fixtureB->GetUserData().pointer);
    const b2Shape &shapeA = *fixtureA->GetShape(), &shapeB = *fixtureB->GetShape();
    b2WorldManifold placed;
    const b2Manifold& manifold = *contact.GetManifold();
    placed.Initialize(&manifold, before_[tagA.body], shapeA.m_radius, before_[tagB.body], shapeB.m_radius);
    const b2Vec2 normal = placed.normal, tangent = b2Cross(normal, 1.0f);
    const float skinA = skinOf(shapeA, shapes_.skin), skinB = skinOf(shapeB, shapes_.skin);
    const bool ordered = tagA.body < tagB.body;
    for (int i = 0; i < manifold.pointCount; ++i) {
        const float half = 0.5f * placed.separations[i];
        const Vec3 onA = fromBox2d(placed.points[i] - (half + skinA) * normal, scale_);
        const Vec3 onB = fromBox2d(placed.points[i] + (half + skinB) * normal, scale_);
        const double sign = ordered ? 1.0 : -1.0;
        ContactPoint point;
        point.bodyA = std::min(tagA.body, tagB.body);
        point.bodyB = std::max(tagA.body, tagB.body);
        point.shapeA = ordered ? tagA.shape : tagB.shape;
        point.shapeB = ordered ? tagB.shape : tagA.shape;
        point.pointA = ordered ? onA : onB;
        point.pointB = ordered ? onB : onA;
        point.normal = sign * fromBox2d(normal, 1.0);
        point.depth = -static_cast<double>(placed.separations[i] + skinA + skinB) / scale_;
        point.hasImpulse = solved;
        if (solved) {
            point.normalImpulse = manifold.points[i].normalImpulse / scale_;
            point.frictionImpulse = sign * fromBox2d(manifold.points[i].tangentImpulse * tangent, scale_);
        }
        contacts.push_back(point);
    }
}

void Box2dWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    contacts.clear();
    if (steps_ == 0) return;
    for (const b2Contact* c = world_->GetContactList(); c != nullptr; c = c->GetNext())
        appendContact(*c, contacts);
    std::stable_sort(contacts.begin(), contacts.end(), [](const ContactPoint& a, const ContactPoint& b) {
        return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
    });
}

adapter::ReadBack Box2dWorld::readBack() const {
    adapter::ReadBack back;
    for (const auto& record : records_) {
        const b2Body& body = *record->body;
        adapter::BodyReadBack entry;
        entry.state = stateOf(*record);
        entry.centerOfMass = record->frame * fromBox2d(body.GetLocalCenter(), scale_);
        if (body.GetType() == b2_dynamicBody) {
            entry.mass = body.GetMass();
            const b2Vec2 c = body.GetLocalCenter();
            const double aboutOrigin = body.GetInertia();
            const double shift = entry.mass * b2Dot(c, c);
            entry.inertia(2, 2) = (aboutOrigin - shift) / (scale_ * scale_);
            entry.gravity = body.GetGravityScale() * fromBox2d(world_->GetGravity(), scale_);
        }
        back.bodies.push_back(entry);
    }
    for (const auto& m : pairs_.examples()) {
        const auto used = rules_->probe(m.materialA, m.materialB);
        back.pairs.push_back({m.materialA, m.materialB, used.friction, used.restitution});
    }
    return back;
}

bool Box2dWorld::isAsleep(int body) const {
    const b2Body* object = records_[body]->body;
    return object->GetType() == b2_dynamicBody && !object->IsAwake();
}

adapter::StepCounters Box2dWorld::counters() const {
    adapter::StepCounters counters;
    counters.pairs = world_->GetContactCount();
    counters.contacts = 0;
    for (const b2Contact* c = world_->GetContactList(); c != nullptr; c = c->GetNext())
        if (c->IsTouching()) counters.contacts += c->GetManifold()->pointCount;
    counters.solverIterations = velocityIterations_;
    if (steps_ == 0) return counters;
    const b2Profile& profile = world_->GetProfile();  // milliseconds
    const auto seconds = [](float ms) { return 1e-3 * ms; };
    counters.phaseSeconds = {{"broad_phase", seconds(profile.broadphase)},
                             {"narrow_phase", seconds(profile.collide)},
                             {"solve_init", seconds(profile.solveInit)},
                             {"solve_velocity", seconds(profile.solveVelocity)},
                             {"solve_position", seconds(profile.solvePosition)},
                             {"continuous", seconds(profile.solveTOI)}};
    return counters;
}

}  // namespace rigor::box2d
