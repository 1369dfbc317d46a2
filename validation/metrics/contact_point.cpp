// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/metrics/contact_point.hpp"

#include <algorithm>
#include <cmath>

#include "validation/metrics/mechanics.hpp"

namespace rigor::validation {

using namespace scenario;

namespace {

/// Inverse by cofactors; a singular matrix (a body of no extent) gives zero: it does not turn.
Mat3 inverseOf(const Mat3& m) {
    const auto row = [&](int i) { return Vec3{m(i, 0), m(i, 1), m(i, 2)}; };
    const Vec3 a = row(0), b = row(1), c = row(2);
    const double det = dot(a, cross(b, c));
    Mat3 r;
    if (!(det > 0.0)) return r;
    const Vec3 columns[3] = {cross(b, c) / det, cross(c, a) / det, cross(a, b) / det};
    for (int j = 0; j < 3; ++j) {
        r(0, j) = columns[j].x;
        r(1, j) = columns[j].y;
        r(2, j) = columns[j].z;
    }
    return r;
}

std::size_t place(int body) {
    return body;
}

}  // namespace

Mobility mobilityOf(const Scenario& scenario, int body, const BodyState& state) {
    const Body& b = scenario.bodies[place(body)];
    Mobility m;
    if (b.type != BodyType::Dynamic) return m;
    m.inverseMass = 1.0 / b.massProperties.mass;
    if (scenario.dimension == 2) {
        const double inertia = b.massProperties.inertia(2, 2);
        m.inverseInertia(2, 2) = inertia > 0.0 ? 1.0 / inertia : 0.0;
        return m;
    }
    const Mat3 R = toMatrix(state.orientation);
    m.inverseInertia = R * inverseOf(b.massProperties.inertia) * transpose(R);
    return m;
}

PointOfContact::PointOfContact(const Scenario& scenario, const ContactPoint& contact,
                               std::span<const BodyState> states)
    : a_(place(contact.bodyA)),
      b_(place(contact.bodyB)),
      dimension_(scenario.dimension),
      normal_(contact.normal),
      ofA_(mobilityOf(scenario, contact.bodyA, states[a_])),
      ofB_(mobilityOf(scenario, contact.bodyB, states[b_])) {
    const bool bothMove = ofA_.inverseMass > 0.0 && ofB_.inverseMass > 0.0;
    const Vec3 at = bothMove ? 0.5 * (contact.pointA + contact.pointB)
                             : (ofA_.inverseMass > 0.0 ? contact.pointA : contact.pointB);
    armA_ = at - centerOfMassOf(scenario.bodies[a_], states[a_]);
    armB_ = at - centerOfMassOf(scenario.bodies[b_], states[b_]);
}

Vec3 PointOfContact::velocity(std::span<const BodyState> states) const {
    const BodyState &a = states[a_], &b = states[b_];
    return b.velocity + cross(b.angularVelocity, armB_) - a.velocity - cross(a.angularVelocity, armA_);
}

Vec3 PointOfContact::response(const Vec3& impulse) const {
    return (ofA_.inverseMass + ofB_.inverseMass) * impulse +
           cross(ofA_.inverseInertia * cross(armA_, impulse), armA_) +
           cross(ofB_.inverseInertia * cross(armB_, impulse), armB_);
}

double PointOfContact::tangentialMobility() const {
    const auto [s, t] = tangentsOf(normal_, dimension_);
    const double ss = dot(s, response(s));
    if (dimension_ == 2) return ss;
    const double tt = dot(t, response(t)), st = dot(s, response(t));
    return 0.5 * (ss + tt) + std::hypot(0.5 * (ss - tt), st);
}

Vec3 surfaceSlip(const Scenario& scenario, const ContactPoint& contact, std::span<const BodyState> states) {
    const auto of = [&](int body, int shape, const Vec3& point) {
        const Shape& moving = scenario.bodies[place(body)].shapes[static_cast<std::size_t>(shape)];
        if (!moving.surfaceVelocity.moves()) return Vec3{};
        const BodyState& state = states[place(body)];
        return surfaceVelocityAt(moving, {state.position, state.orientation}, point);
    };
    return of(contact.bodyB, contact.shapeB, contact.pointB) -
           of(contact.bodyA, contact.shapeA, contact.pointA);
}

std::array<Vec3, 2> tangentsOf(const Vec3& n, int dimension) {
    if (dimension == 2) return {Vec3{-n.y, n.x, 0.0}, Vec3{0.0, 0.0, 1.0}};
    const Vec3 axis = std::abs(n.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(axis, n), s = across / norm(across);
    return {s, cross(n, s)};
}

bool isKnownContact(const Scenario& scenario, const ContactPoint& contact) {
    const auto known = [&](int body, int shape) {
        return body >= 0 && place(body) < scenario.bodies.size() && shape >= 0 &&
               static_cast<std::size_t>(shape) < scenario.bodies[place(body)].shapes.size();
    };
    return contact.bodyA != contact.bodyB && known(contact.bodyA, contact.shapeA) &&
           known(contact.bodyB, contact.shapeB) &&
           (scenario.bodies[place(contact.bodyA)].type == BodyType::Dynamic ||
            scenario.bodies[place(contact.bodyB)].type == BodyType::Dynamic);
}

PairCoefficients coefficientsOf(const Scenario& scenario, const ContactPoint& contact) {
    const auto material = [&](int body, int shape) {
        return scenario.bodies[place(body)].shapes[shape].material;
    };
    return pairCoefficients(scenario, material(contact.bodyA, contact.shapeA),
                            material(contact.bodyB, contact.shapeB));
}

}  // namespace rigor::validation
