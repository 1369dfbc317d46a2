// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Code of every Box2D program here around its scene: the loop of the manual's "Hello Box2D", with 8 velocity
// and 3 position iterations, and the bodies' states after each step.
#pragma once

#include <box2d/box2d.h>

#include <functional>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

inline std::vector<BodyState> statesOf(const std::vector<b2Body*>& bodies) {
    std::vector<BodyState> states;
    for (const b2Body* body : bodies) {
        const b2Vec2 p = body->GetPosition(), v = body->GetLinearVelocity();
        const auto number = [](float x) { return static_cast<double>(x); };
        states.push_back({{number(p.x), number(p.y), 0.0},
                          scenario::fromAxisAngle({0.0, 0.0, 1.0}, number(body->GetAngle())),
                          {number(v.x), number(v.y), 0.0},
                          {0.0, 0.0, number(body->GetAngularVelocity())}});
    }
    return states;
}

/// `afterStep` is the program's own work between two steps.
inline Trajectory run(
    b2World& world, const std::vector<b2Body*>& bodies, float dt, int steps,
    const std::function<void()>& afterStep = [] {}) {
    Trajectory trajectory{statesOf(bodies)};
    for (int i = 0; i < steps; ++i) {
        world.Step(dt, 8, 3);
        afterStep();
        trajectory.push_back(statesOf(bodies));
    }
    return trajectory;
}

inline b2Body* makeBody(b2World& world, b2BodyType type, const b2Vec2& position) {
    b2BodyDef def;
    def.type = type;
    def.position = position;
    return world.CreateBody(&def);
}

/// A fixture of density 1 on a body that moves, of density 0 on one that does not.
inline void addFixture(b2Body& body, const b2Shape& shape, float friction = 0.2f, float restitution = 0.0f) {
    b2FixtureDef def;
    def.shape = &shape;
    def.density = body.GetType() == b2_dynamicBody ? 1.0f : 0.0f;
    def.friction = friction;
    def.restitution = restitution;
    body.CreateFixture(&def);
}

inline b2PolygonShape box(float hx, float hy) {
    b2PolygonShape shape;
    shape.SetAsBox(hx, hy);
    return shape;
}
inline b2CircleShape circle(float radius) {
    b2CircleShape shape;
    shape.m_radius = radius;
    return shape;
}

/// A box of density 1 whose mass is set as a whole (manual, "Mass Data"): the inertia that Box2D adds up from
/// a polygon's triangles in single precision is an ulp off the scenario's.
inline void addBox(b2Body& body, double hx, double hy, float friction = 0.2f) {
    addFixture(body, box(static_cast<float>(hx), static_cast<float>(hy)), friction);
    b2MassData data;
    const double mass = 4.0 * hx * hy;
    data.mass = static_cast<float>(mass);
    data.center.SetZero();
    data.I = static_cast<float>(mass / 3.0 * (hx * hx + hy * hy));
    body.SetMassData(&data);
}

inline constexpr const char* kScenes = "adapters/conformance/plain_programs/box2d/";

}  // namespace rigor::plain
