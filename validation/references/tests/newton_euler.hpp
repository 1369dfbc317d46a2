// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Newton's and Euler's laws as a second method: a reference is evaluated for velocities around a time, and
// their change must be the effect of forces that its joints and contacts can give. No reference's own
// equation of motion is used.
#pragma once

#include <gtest/gtest.h>

#include "validation/references/parts.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {

inline void expectNear(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Wrench on a body at time t beside gravity, from finite differences of the reference's velocities.
struct Wrench {
    Vec3 com;
    Vec3 force;         ///< m (dv/dt - g) [N]
    Vec3 torque;        ///< dL/dt about the centre of mass [N m]
    Vec3 acceleration;  ///< dv/dt [m/s^2]
    /// Rest of the torque if `force` acts at `point` [N m].
    Vec3 remainder(Vec3 point) const { return torque - cross(point - com, force); }
};

inline Vec3 spinMomentum(const Scenario& s, const Reference& r, int body, double t) {
    const Body& b = s.bodies[body];
    const PartialState e = r.exact(body, t);
    if (s.dimension == 2) return b.massProperties.inertia(2, 2) * *e.angularVelocity;
    const Mat3 turn = toMatrix(*e.orientation);
    return turn * (b.massProperties.inertia * (transpose(turn) * *e.angularVelocity));
}
inline Vec3 centerAt(const Scenario& s, const Reference& r, int body, double t) {
    const PartialState e = r.exact(body, t);
    return *e.position + rotate(*e.orientation, s.bodies[body].massProperties.centerOfMass);
}
/// The world position of a point of the body frame.
inline Vec3 pointAt(const Reference& r, int body, double t, Vec3 local) {
    const PartialState e = r.exact(body, t);
    return *e.position + rotate(*e.orientation, local);
}
/// Fourth-order derivative of f; error about 1e-11 of the scale for motions of about 1 s.
template <class F>
Vec3 derivativeOf(const F& f, double t, double h = 5e-4) {
    return (8.0 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}
inline Wrench wrenchOn(const Scenario& s, const Reference& r, int body, double t, double h = 5e-4) {
    Wrench w;
    const Body& b = s.bodies[body];
    w.com = centerAt(s, r, body, t);
    w.acceleration = derivativeOf([&](double at) { return *r.exact(body, at).velocity; }, t, h);
    w.force = b.massProperties.mass * (w.acceleration - b.gravityScale * s.gravity);
    w.torque = derivativeOf([&](double at) { return spinMomentum(s, r, body, at); }, t, h);
    return w;
}
/// Position and orientation must move as the velocities say.
inline void expectConsistent(const Scenario& s, const Reference& r, int body, double t, double tolerance,
                             double h = 5e-4) {
    const Vec3 rate = derivativeOf([&](double at) { return centerAt(s, r, body, at); }, t, h);
    EXPECT_LT(norm(rate - *r.exact(body, t).velocity), tolerance) << "velocity at " << t;
    const PartialState e = r.exact(body, t);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
        const Vec3 turn =
            derivativeOf([&](double at) { return rotate(*r.exact(body, at).orientation, axis); }, t, h);
        EXPECT_LT(norm(turn - cross(*e.angularVelocity, rotate(*e.orientation, axis))), tolerance)
            << "angular velocity at " << t;
    }
}
inline double energyOf(const Scenario& s, const Reference& r, double t) {
    double sum = 0.0;
    for (const int body : r.bodies()) {
        const Body& b = s.bodies[body];
        const PartialState e = r.exact(body, t);
        sum += 0.5 * b.massProperties.mass * dot(*e.velocity, *e.velocity) +
               0.5 * dot(*e.angularVelocity, spinMomentum(s, r, body, t)) -
               b.massProperties.mass * b.gravityScale * dot(s.gravity, centerAt(s, r, body, t));
    }
    return sum;
}

}  // namespace rigor::validation::testing
