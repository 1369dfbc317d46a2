// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Restitution: Box2D multiplies the coefficient with the approach speed after this step's forces have been
// added, v' = v + dt a, so a ball leaves with e (v + g dt) and gains energy at every bounce. The corrected
// coefficient e v / v' makes it leave with e v.
#include "adapters/box2d/contact_rules.hpp"
#include "adapters/box2d/convert.hpp"

#include <stdexcept>

namespace rigor::box2d {
namespace {

const FixtureTag& tagOf(const b2Fixture* fixture) {
    // GetUserData is not const in Box2D.
    return *reinterpret_cast<const FixtureTag*>(const_cast<b2Fixture*>(fixture)->GetUserData().pointer);
}

struct Motion {
    b2Vec2 v;
    float w;
};

Motion now(const b2Body& body) {
    return {body.GetLinearVelocity(), body.GetAngularVelocity()};
}

/// Velocity after b2Island::Solve has added forces and damping, before any constraint.
Motion predicted(b2Body& body, float dt) {
    Motion m = now(body);
    if (body.GetType() != b2_dynamicBody) return m;
    const auto* tag = reinterpret_cast<const BodyTag*>(body.GetUserData().pointer);
    const float mass = body.GetMass();
    const b2Vec2 center = body.GetLocalCenter();
    const float inertia = body.GetInertia() - mass * b2Dot(center, center);
    const b2Vec2 gravity = body.GetWorld()->GetGravity();
    m.v += dt * (body.GetGravityScale() * gravity + (1.0f / mass) * tag->force);
    if (inertia > 0.0f) m.w += dt * tag->torque / inertia;
    m.v *= 1.0f / (1.0f + dt * body.GetLinearDamping());
    m.w *= 1.0f / (1.0f + dt * body.GetAngularDamping());
    return m;
}

/// Separation speed of B from A at a point, along the normal.
float separationSpeed(const b2Body& a, const Motion& ma, const b2Body& b, const Motion& mb,
                      const b2Vec2& point, const b2Vec2& normal) {
    const b2Vec2 va = ma.v + b2Cross(ma.w, point - a.GetWorldCenter());
    const b2Vec2 vb = mb.v + b2Cross(mb.w, point - b.GetWorldCenter());
    return b2Dot(vb - va, normal);
}

}  // namespace

bool ContactRules::ShouldCollide(b2Fixture* a, b2Fixture* b) {
    const FixtureTag &ofA = tagOf(a), &ofB = tagOf(b);
    return pairs_.mayCollide(ofA.body, ofB.body) &&
           pairs_.shapesMayTouch(ofA.body, ofA.shape, ofB.body, ofB.shape);
}

void ContactRules::PreSolve(b2Contact* contact, const b2Manifold*) {
    const auto& pair =
        pairs_.coefficients(tagOf(contact->GetFixtureA()).material, tagOf(contact->GetFixtureB()).material);
    contact->SetFriction(static_cast<float>(pair.friction));
    contact->SetRestitutionThreshold(settings_.restitutionThreshold);
    contact->SetRestitution(restitutionFor(*contact, static_cast<float>(pair.restitution)));
    contact->SetTangentSpeed(tangentSpeed(*contact));
}

/// b2ContactSolver makes b2Cross(normal, 1) . (vB - vA) this speed; the surfaces stick where it is that of A's
/// surface against B's over their bodies. One speed serves both points of a manifold: the mean of theirs.
float ContactRules::tangentSpeed(const b2Contact& contact) const {
    const b2Fixture *a = contact.GetFixtureA(), *b = contact.GetFixtureB();
    if (tagOf(a).source == nullptr && tagOf(b).source == nullptr) return 0.0f;
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    const int count = contact.GetManifold()->pointCount;
    const auto surface = [&](const b2Fixture* fixture, const b2Vec2& point) {
        const FixtureTag& tag = tagOf(fixture);
        if (tag.source == nullptr) return Vec3{};
        const b2Body* body = fixture->GetBody();
        const Pose pose = fromBox2d(body->GetPosition(), body->GetAngle(), settings_.scale) * tag.frame;
        return surfaceVelocityAt(*tag.source, pose, fromBox2d(point, settings_.scale));
    };
    const b2Vec2 tangent = b2Cross(manifold.normal, 1.0f);
    float sum = 0.0f;
    for (int i = 0; i < count; ++i)
        sum += b2Dot(tangent, toBox2d(surface(a, manifold.points[i]) - surface(b, manifold.points[i]),
                                      settings_.scale));
    return count > 0 ? sum / static_cast<float>(count) : 0.0f;
}

/// One coefficient serves both points of a manifold: the mean of their speeds decides.
float ContactRules::restitutionFor(b2Contact& contact, float restitution) const {
    if (!settings_.correctRestitution || restitution == 0.0f) return restitution;
    b2Body& a = *contact.GetFixtureA()->GetBody();
    b2Body& b = *contact.GetFixtureB()->GetBody();
    const Motion nowA = now(a), nowB = now(b);
    const Motion nextA = predicted(a, settings_.dt), nextB = predicted(b, settings_.dt);
    b2WorldManifold manifold;
    contact.GetWorldManifold(&manifold);
    float before = 0.0f, after = 0.0f;
    for (int i = 0; i < contact.GetManifold()->pointCount; ++i) {
        before += separationSpeed(a, nowA, b, nowB, manifold.points[i], manifold.normal);
        after += separationSpeed(a, nextA, b, nextB, manifold.points[i], manifold.normal);
    }
    if (before >= 0.0f || after >= 0.0f) return 0.0f;  // the point was not approaching by itself: no rebound
    return restitution * before / after;
}

scenario::PairCoefficients ContactRules::probe(int materialA, int materialB) const {
    ContactRules rules(pairs_, settings_);
    b2World world(b2Vec2(0.0f, 0.0f));
    world.SetContactListener(&rules);
    world.SetContinuousPhysics(false);  // it would update the contact once more, after the bounce
    const FixtureTag tags[2] = {{0, 0, materialA}, {1, 0, materialB}};
    BodyTag bodies[2];
    for (int i = 0; i < 2; ++i) {
        b2BodyDef def;
        def.type = i == 0 ? b2_staticBody : b2_dynamicBody;
        def.position.Set(0.0f, 1.9f * i);
        def.linearVelocity.Set(0.0f, -10.0f * i);
        def.userData.pointer = reinterpret_cast<uintptr_t>(&bodies[i]);
        b2CircleShape disc;
        disc.m_radius = 1.0f;
        b2FixtureDef fixture;
        fixture.shape = &disc;
        fixture.density = 1.0f;
        fixture.userData.pointer = reinterpret_cast<uintptr_t>(&tags[i]);
        world.CreateBody(&def)->CreateFixture(&fixture);
    }
    // The first step of a world finds the pair and updates it: the listener is called once.
    world.Step(settings_.dt, 1, 1);
    const b2Contact* contact = world.GetContactList();
    if (contact == nullptr) throw std::logic_error("box2d: the probe bodies did not meet");
    return {contact->GetFriction(), contact->GetRestitution()};
}

}  // namespace rigor::box2d
