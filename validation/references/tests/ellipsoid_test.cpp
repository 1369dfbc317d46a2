// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The rolling ellipsoid: Newton and Euler at its point of contact, the period of small oscillations, a sphere as the
// limit, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/references/tests/newton_euler.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Vec3 kHalf{0.5, 0.3, 0.4};

/// Turned by `tilt` about the axis of the third half axis, which is `yaw` from z; on the floor.
Scenario egg(double tilt, double friction, double rate = 0.0, double yaw = 0.4, Vec3 half = kHalf) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 3);
    s.materials[0].friction = friction;
    addFloor(s);
    const double sine = half.x * std::sin(tilt), cosine = half.y * std::cos(tilt),
                 height = std::hypot(sine, cosine);
    addBody(s, "egg", BodyType::Dynamic, Ellipsoid{half}, {0.3, height, -0.2});
    Body& b = s.bodies.back();
    const Quat turned = fromAxisAngle({0, 1, 0}, yaw);
    b.pose.orientation = turned * fromAxisAngle({0, 0, 1}, tilt);
    const Vec3 q{half.x * half.x, half.y * half.y, half.z * half.z};
    b.massProperties = {2, {}, Mat3::diagonal(0.4 * (q.y + q.z), 0.4 * (q.x + q.z), 0.4 * (q.x + q.y))};
    const double slope = (q.x - q.y) * std::sin(tilt) * std::cos(tilt) / height;
    b.angularVelocity = rotate(turned, {0, 0, rate});
    b.velocity = rotate(turned, {friction > 0 ? -height * rate : 0, slope * rate, 0});
    setReference(s, "rolling_ellipsoid");
    return s;
}

/// The point of the ellipsoid with the outward normal -y.
Vec3 contactOf(const PartialState& state, Vec3 half) {
    const Vec3 d = rotateInverse(*state.orientation, {0, -1, 0});
    const Vec3 e{half.x * d.x, half.y * d.y, half.z * d.z};
    return *state.position +
           rotate(*state.orientation, Vec3{half.x * e.x, half.y * e.y, half.z * e.z} / norm(e));
}

TEST(RollingEllipsoid, OneForceAtItsPointOfContactMovesIt) {
    for (const double rate : {0.0, -1.2, -6.0})
        for (const double friction : {0.0, 1.5}) {
            if (friction == 0.0 && rate < -2.0) continue;  // it would leave a smooth floor
            const Scenario s = egg(rate < -2.0 ? 0.0 : 0.25, friction, rate);
            const auto r = makeReference(s);
            for (const double t : {0.05, 0.4, 1.3, 2.2}) {
                SCOPED_TRACE(std::to_string(rate) + " " + std::to_string(t));
                const auto e = r->exact(1, t);
                const Vec3 contact = contactOf(e, kHalf);
                EXPECT_NEAR(contact.y, 0.0, 1e-12);
                const Wrench w = wrenchOn(s, *r, 1, t);
                EXPECT_LT(norm(w.remainder(contact)), 1e-6);
                EXPECT_GT(w.force.y, 0.0);
                const Vec3 slip = *e.velocity + cross(*e.angularVelocity, contact - *e.position);
                EXPECT_NEAR(slip.y, 0.0, 1e-12);
                if (friction > 0.0)
                    EXPECT_LT(norm(slip), 1e-12);
                else
                    EXPECT_LT(std::hypot(w.force.x, w.force.z), 1e-6);
                expectConsistent(s, *r, 1, t, 1e-8);
                EXPECT_NEAR(energyOf(s, *r, t), energyOf(s, *r, 0), 1e-11);
            }
        }
}

TEST(RollingEllipsoid, SmallOscillationsHaveTheirPeriod) {
    for (const double friction : {0.0, 1.5}) {
        const Scenario s = egg(1e-4, friction);
        const auto r = makeReference(s);
        const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
        const Quantity* period = findQuantity(all, "period");
        ASSERT_NE(period, nullptr);
        const double inertia = 0.2 * (0.25 + 0.09) + (friction > 0.0 ? 0.09 : 0.0);
        EXPECT_NEAR(period->exact, 2 * kPi * std::sqrt(inertia * 0.3 / (9.81 * (0.25 - 0.09))), 1e-7);
        EXPECT_NEAR(period->measure(exactRun(s, *r, 0.002, 1400)).value(), period->exact, 1e-6);
    }
}

TEST(RollingEllipsoid, OfEqualHalfAxesIsABall) {
    const Scenario s = egg(0.7, 1.0, -2.0, 0.0, {0.3, 0.3, 0.3});
    const auto e = makeReference(s)->exact(1, 1.5);
    EXPECT_LT(norm(*e.position - Vec3{0.3 + 0.6 * 1.5, 0.3, -0.2}), 1e-11);
    EXPECT_LT(norm(*e.angularVelocity - Vec3{0, 0, -2}), 1e-11);
    EXPECT_LT(norm(*e.velocity - Vec3{0.6, 0, 0}), 1e-11);
}

TEST(RollingEllipsoid, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(makeReference(egg(0.6, 0.05)), AssumptionViolated) << "slips";
    EXPECT_THROW(makeReference(egg(0.0, 1.5, -20.0)), AssumptionViolated) << "leaves the floor";
    Scenario s = egg(0.25, 1.5);
    s.bodies[1].pose.position.y += 0.01;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = egg(0.25, 1.5);
    s.bodies[1].pose.orientation = fromAxisAngle({1, 0, 0}, 0.2) * s.bodies[1].pose.orientation;
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "no axis along the floor";
    s = egg(0.25, 1.5);
    s.bodies[1].angularVelocity = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = egg(0.25, 1.5);
    s.bodies[1].velocity = {0.1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "slips at the start";
    s = egg(0.25, 1.5);
    s.gravity = {1, -9, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
