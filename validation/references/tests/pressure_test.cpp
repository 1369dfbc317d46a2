// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many contacts at once: discs of even pressure (against sums over a grid of small pieces), rows of touching
// balls (against catalogued values and energy), chains at rest (against the balance of every link).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using std::numbers::pi;

// ------------------------------------------------------------------------------------------ spinning_disc
Scenario disc(Vec3 velocity, double spin) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 0.6);
    s.materials[0].friction = 0.3;
    addFloor(s);
    addBody(s, "disc", BodyType::Dynamic, Cylinder{0.5, 0.05}, {0, 0.05, 0});
    Body& b = s.bodies.back();
    b.massProperties = {2, {0, -0.05, 0}, Mat3::diagonal(0.13, 0.25, 0.13)};
    b.velocity = velocity;
    b.angularVelocity = {0, spin, 0};
    setReference(s, "spinning_disc", {{"body", std::string("disc")}, {"floor", std::string("floor")}});
    return s;
}

TEST(SpinningDisc, CatalogueValues) {
    Scenario s = disc({2, 0, 0}, 3);
    s.bodies[1].massProperties.mass = 1;
    s.bodies[1].massProperties.inertia = Mat3::diagonal(0.1, 0.125, 0.1);
    const auto r = makeReference(s);
    const double t[] = {0.3, 0.5}, v[] = {1.201909129, 0.7043614645}, w[] = {2.214233357, 1.54104711},
                 x[] = {0.4792893861, 0.6691919689};
    for (int k = 0; k < 2; ++k) {
        const auto e = r->exact(1, t[k]);
        EXPECT_NEAR(e.velocity->x, v[k], 1e-8);
        EXPECT_NEAR(e.angularVelocity->y, w[k], 1e-8);
        EXPECT_NEAR(e.position->x, x[k], 1e-8);
    }
}

/// Friction of a disc summed over a polar grid: force and torque over the weight times mu.
std::pair<Vec3, double> summed(Vec3 v, double w, double radius) {
    Vec3 force{};
    double torque = 0.0;
    const int rings = 400, turns = 720;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < turns; ++j) {
            const double rho = radius * (i + 0.5) / rings, a = 2 * pi * (j + 0.5) / turns;
            const Vec3 p{rho * std::cos(a), 0, rho * std::sin(a)};
            const Vec3 u = unit(v + cross({0, w, 0}, p));
            const double share = 2.0 * (i + 0.5) / (static_cast<double>(rings) * rings * turns);
            force = force - share * u;
            torque -= share * cross(p, u).y;
        }
    return {force, torque};
}

TEST(SpinningDisc, FrictionIsThatOfItsPieces) {
    // Slides faster than its rim turns, and slower; obliquely.
    for (const auto& [velocity, spin] : {std::pair{Vec3{2, 0, 0.7}, 1.5}, std::pair{Vec3{0.5, 0, -0.3}, -6.0},
                                         std::pair{Vec3{1.0, 0, 0}, 2.05}}) {
        const Scenario s = disc(velocity, spin);
        const auto r = makeReference(s);
        const double t = 0.05;
        const auto e = r->exact(1, t);
        const Wrench w = wrenchOn(s, *r, 1, t, 1e-3);
        const auto [force, torque] = summed(*e.velocity, e.angularVelocity->y, 0.5);
        const double mu = 0.3 * 2 * 9.81;
        EXPECT_NEAR(w.force.x, mu * force.x, 2e-4);
        EXPECT_NEAR(w.force.z, mu * force.z, 2e-4);
        EXPECT_NEAR(w.torque.y, mu * torque, 2e-4);
        EXPECT_NEAR(w.force.y, 2 * 9.81, 1e-9);
        expectConsistent(s, *r, 1, t, 1e-7, 1e-3);
    }
}

TEST(SpinningDisc, SlidingAndSpinningEndTogether) {
    Scenario s = disc({1.6, 0, 0}, 5);
    s.duration = 2;
    const auto r = makeReference(s);
    ASSERT_LT(r->validUntil(), 2.0);
    const auto e = r->exact(1, r->validUntil());
    // I = m R^2/2: 0.653 draws the ratio of the speeds in from both sides.
    const Scenario faster = disc({3, 0, 0}, 4);
    const double start = 1.6 / 2.5, end = norm(*e.velocity) / (0.5 * e.angularVelocity->y);
    EXPECT_NEAR(end, 0.653, 0.5 * (0.653 - start) + 0.01);
    const Scenario slower = disc({0.5, 0, 0}, 5);
    const auto slow = makeReference(slower), fast = makeReference(faster);
    const auto ratio = [](const Reference& one, double t) {
        const auto at = one.exact(1, t);
        return norm(*at.velocity) / (0.5 * at.angularVelocity->y);
    };
    EXPECT_GT(ratio(*slow, 0.5), ratio(*slow, 0) + 0.05);
    EXPECT_LT(ratio(*fast, 0.5), ratio(*fast, 0) - 0.05);
}

/// Feet on two circles of five and seven, balanced; the centre of mass between them at height `above`.
Scenario feet(Vec3 velocity, double spin, double above, bool one = false) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 0.3);
    s.materials[0].friction = 0.4;
    addBody(s, "floor", BodyType::Static, Box{{5, 0.5, 5}}, {0, -0.5, 0});
    addBody(s, "ring", BodyType::Dynamic, Sphere{0.02}, {0, 0.1, 0});
    Body& b = s.bodies.back();
    b.shapes.clear();
    for (const auto& [n, radius] : {std::pair{5, 0.2}, std::pair{one ? 0 : 7, 0.35}})
        for (int i = 0; i < n; ++i) {
            const double a = 2 * pi * i / n + 0.3;
            b.shapes.push_back({Sphere{0.02}, {{radius * std::cos(a), -0.08, radius * std::sin(a)}, {}}, 0});
        }
    b.massProperties = {1.5, {0, above - 0.1, 0}, Mat3::diagonal(0.05, 0.08, 0.05)};
    b.velocity = velocity;
    b.angularVelocity = {0, spin, 0};
    setReference(s, "spinning_disc", {{"body", std::string("ring")}, {"floor", std::string("floor")}});
    return s;
}

TEST(SpinningDisc, FeetShareTheWeight) {
    const Scenario s = feet({1.5, 0, 0.4}, 6, 0.0);
    const auto r = makeReference(s);
    const double t = 0.08;
    const auto e = r->exact(1, t);
    const Wrench w = wrenchOn(s, *r, 1, t);
    Vec3 force{};
    double torque = 0.0;
    for (const auto& shape : s.bodies[1].shapes) {
        Vec3 p = rotate(*e.orientation, shape.pose.position);
        p.y = 0;
        const Vec3 f = (-0.4 * 1.5 * 9.81 / 12) * unit(*e.velocity + cross(*e.angularVelocity, p));
        force += f;
        torque += cross(p, f).y;
    }
    EXPECT_NEAR(w.force.x, force.x, 1e-7);
    EXPECT_NEAR(w.force.z, force.z, 1e-7);
    EXPECT_NEAR(w.torque.y, torque, 1e-8);
}

TEST(SpinningDisc, APureSpinOnOneCircleNeedsNoLoads) {
    const Scenario s = feet({}, 9, 0.15, true);
    const auto r = makeReference(s);
    EXPECT_NEAR(r->exact(1, 0.2).angularVelocity->y, 9 - 0.4 * 1.5 * 9.81 * 0.2 / 0.08 * 0.2, 1e-12);
}

TEST(SpinningDisc, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW(makeReference(feet({1, 0, 0}, 6, 0.05)), AssumptionViolated);
    EXPECT_THROW(makeReference(feet({}, 6, 0.05)), AssumptionViolated);  // two circles
    EXPECT_THROW(makeReference(disc({}, 0)), AssumptionViolated);
    Scenario s = disc({1, 0, 0}, 2);
    s.bodies[1].angularVelocity.x = 0.1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = feet({1, 0, 0}, 3, 0.0);
    s.bodies[1].shapes[0].pose.position.x += 0.05;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = disc({1, 0, 0}, 2);
    s.gravity = {1, -9.81, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// -------------------------------------------------------------------------------------------- touching_row
Scenario row(const std::vector<double>& masses, double e, int runners = 1) {
    Scenario s = emptyScene(3, {}, 1);
    s.materials[0].restitution = e;
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const bool runs = static_cast<int>(i) < runners;
        addBall(s, std::string(1, static_cast<char>('a' + i)), 0.1, masses[i], 0.4,
                {0.2 * i - (runs ? 0.3 : 0.0), 0, 0}, {runs ? 1.0 : 0.0, 0, 0});
    }
    setReference(s, "touching_row");
    return s;
}
std::vector<double> speeds(const Scenario& s) {
    const auto r = makeReference(s);
    std::vector<double> result;
    for (const int body : r->bodies()) result.push_back(r->exact(body, 0.9).velocity->x);
    return result;
}

TEST(TouchingRow, CatalogueValues) {
    const auto equal = speeds(row({1, 1, 1, 1, 1}, 1));
    EXPECT_NEAR(equal[0], -0.6, 1e-14);
    for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(equal[i], 0.4, 1e-14);
    const auto heavy = speeds(row({1, 2, 1}, 1));
    EXPECT_NEAR(heavy[0], -0.5, 1e-14);
    EXPECT_NEAR(heavy[1], 0.5, 1e-14);
    EXPECT_NEAR(heavy[2], 0.5, 1e-14);
    const auto dull = speeds(row({1, 1, 1, 1}, 0.5));
    EXPECT_NEAR(dull[0], (1 - 3 * 0.5) / 4, 1e-14);
    EXPECT_NEAR(dull[3], 1.5 / 4, 1e-14);
}

TEST(TouchingRow, TheLawHoldsAtEveryContact) {
    const std::vector<double> masses{2, 0.5, 3, 1, 0.7, 4};
    for (const double e : {0.0, 0.4, 1.0})
        for (const int runners : {1, 3, 5}) {
            const Scenario s = row(masses, e, runners);
            const auto after = speeds(s);
            double push = 0.0, momentum = 0.0, energy = 0.0, start = 0.0;
            for (std::size_t i = 0; i < masses.size(); ++i) {
                const double v = static_cast<int>(i) < runners ? 1.0 : 0.0;
                // The momentum taken from the left is the impulse at the contact on the right.
                push += masses[i] * (v - after[i]);
                momentum += masses[i] * (after[i] - v);
                energy += masses[i] * after[i] * after[i];
                start += masses[i] * v * v;
                if (i + 1 == masses.size()) continue;
                const double apart = after[i + 1] - after[i];
                const double before = static_cast<int>(i) + 1 == runners ? -1.0 : 0.0;
                EXPECT_GE(push, -1e-12);
                EXPECT_GE(apart + e * before, -1e-12);
                EXPECT_NEAR(push * (apart + e * before), 0.0, 1e-12);
            }
            EXPECT_NEAR(momentum, 0.0, 1e-12);
            EXPECT_LE(energy, start + 1e-12);
            EXPECT_GE(energy, e == 1.0 ? start - 1e-12 : 0.0);
        }
}

TEST(TouchingRow, DoesNotDependOnItsUnits) {
    const std::vector<double> masses{2, 0.5, 3, 1};
    const auto in = [&](double speed, double mass) {
        Scenario s = row(masses, 0.4);
        s.bodies[0].velocity.x = speed;
        s.duration = 1 / speed;
        for (Body& b : s.bodies) {
            b.massProperties.mass *= mass;
            for (int i = 0; i < 3; ++i) b.massProperties.inertia(i, i) *= mass;
        }
        return s;
    };
    const Scenario unit = in(1, 1);
    const auto one = makeReference(unit);
    for (const double speed : {1e-12, 1e-6, 1e9})
        for (const double mass : {1e-15, 1e12}) {
            const Scenario s = in(speed, mass);
            const auto other = makeReference(s);
            for (const int body : one->bodies())
                EXPECT_NEAR(other->exact(body, 0.9 / speed).velocity->x / speed,
                            one->exact(body, 0.9).velocity->x, 1e-13);
        }
    // Neighbours that close on each other a hundredth as fast as the runner comes are no row at rest.
    Scenario s = in(1e-9, 1);
    s.bodies[2].velocity.x = -1e-11;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = in(1, 1);
    for (const std::size_t i : {1U, 2U}) s.bodies[i].collides = false;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(TouchingRow, MovesUniformlyToAndFromTheImpact) {
    const Scenario s = row({1, 1, 1}, 1);
    const auto r = makeReference(s);
    EXPECT_NEAR(r->exact(0, 0.2).position->x, -0.1, 1e-15);
    EXPECT_NEAR(r->exact(0, 0.6).position->x, 0.0 - 0.3 / 3, 1e-14);
    EXPECT_NEAR(r->exact(2, 0.6).position->x, 0.4 + 0.3 * 2 / 3, 1e-14);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_EQ(all.size(), 3U);
    for (const auto& q : all) EXPECT_NEAR(q.measure(exactRun(s, *r, 0.01, 100)).value(), q.exact, 1e-13);
}

TEST(TouchingRow, RefusesWhatItDoesNotKnow) {
    Scenario s = row({1, 1, 1}, 1);
    s.bodies[2].pose.position.x += 0.1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = row({1, 1, 1}, 1);
    s.bodies[0].velocity.y = 1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = row({1, 1, 1}, 1);
    s.bodies[0].velocity = {-1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = row({1, 1, 1}, 1);
    s.gravity = {0, -1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// -------------------------------------------------------------------------------------------- hanging_chain
/// Links of given lengths and masses between (0, 0) and `span`, with a centre of mass at the part c of each,
/// placed by the balance of a shooting method on the pull (h, v) of its first hinge.
Scenario chain(int dimension, const std::vector<double>& length, const std::vector<double>& mass, double c,
               Vec3 span) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 1);
    const auto links = [&](double h, double v) {
        std::vector<Vec3> points{{0, 0, 0}};
        const Vec3 side = unit({span.x, 0, span.z});
        for (std::size_t i = 0; i < length.size(); ++i) {
            // Tangent of link i: the pull less the weight that hangs before its middle.
            double up = v;
            for (std::size_t k = 0; k < i; ++k) up += mass[k] * 9.81;
            up += (1 - c) * mass[i] * 9.81;
            points.push_back(points.back() + length[i] * unit(h * side + Vec3{0, up, 0}));
        }
        return points;
    };
    // The height of the end grows with v for each h; the span grows with h: two nested bisections.
    const auto level = [&](double h) {
        double low = -1e3, high = 1e3;
        for (int k = 0; k < 200; ++k) {
            const double v = (low + high) / 2;
            (links(h, v).back().y < span.y ? low : high) = v;
        }
        return low;
    };
    double low = 1e-3, high = 1e4;
    for (int k = 0; k < 200; ++k) {
        const double h = (low + high) / 2;
        const Vec3 end = links(h, level(h)).back();
        (std::hypot(end.x, end.z) < std::hypot(span.x, span.z) ? low : high) = h;
    }
    const auto points = links(low, level(low));
    for (std::size_t i = 0; i < length.size(); ++i) {
        const Vec3 along = points[i + 1] - points[i];
        addBody(s, "link" + std::to_string(i), BodyType::Dynamic, Sphere{0.01}, points[i] + c * along);
        s.bodies.back().massProperties = {mass[i], {}, Mat3::diagonal(0.01, 0.01, 0.01)};
        s.bodies.back().collides = false;
        addJoint(s, JointType::Hinge, i == 0 ? kNone : static_cast<int>(i) - 1, i, points[i]);
    }
    addJoint(s, JointType::Ball, static_cast<int>(length.size()) - 1, kNone, points.back());
    s.joints.back().bodyA = kNone;
    s.joints.back().bodyB = static_cast<int>(length.size()) - 1;
    s.joints.back().anchorA = points.back();
    s.joints.back().anchorB = inverse(s.bodies.back().pose) * points.back();
    setReference(s, "hanging_chain");
    return s;
}

TEST(HangingChain, CatalogueValue) {
    const Scenario s = chain(2, std::vector<double>(10, 0.2), std::vector<double>(10, 0.5), 0.5, {1.5, 0, 0});
    const auto r = makeReference(s);
    const auto all = r->quantities(0.01, adapter::Scheme::Unknown);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].exact, 0.5920391307, 1e-9);
    EXPECT_NEAR(all[0].measure(exactRun(s, *r, 0.01, 10)).value(), all[0].exact, 1e-9);
}

TEST(HangingChain, UnequalLinksHangWhereTwoBisectionsPutThem) {
    for (const int dimension : {2, 3}) {
        const Vec3 span{1.1, 0.4, dimension == 3 ? 0.5 : 0.0};
        const Scenario s = chain(dimension, {0.3, 0.5, 0.2, 0.6, 0.3}, {1, 0.2, 5, 0.4, 2}, 0.3, span);
        const auto r = makeReference(s);
        for (const int body : r->bodies())
            EXPECT_LT(norm(*r->exact(body, 0.5).position - s.bodies[body].pose.position), 1e-9);
    }
}

TEST(HangingChain, RefusesWhatItDoesNotKnow) {
    const auto base = [] { return chain(2, {0.5, 0.5, 0.5}, {1, 1, 1}, 0.5, {1.1, 0, 0}); };
    Scenario s = base();
    s.bodies[0].massProperties.mass = 3;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.bodies[1].velocity = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.joints.pop_back();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = base();
    s.gravity = {};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
