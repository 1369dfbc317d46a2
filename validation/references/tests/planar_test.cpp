// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One body on a floor seen from the side: catalogued values of rocking blocks, falling rods, impacts of
// corners and Painleve's rod; and Newton's and Euler's laws solved for the contact force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/numerics/real.hpp"
#include "validation/references/planar/planar_motion.hpp"
#include "validation/references/tests/newton_euler.hpp"
#include "validation/references/tests/other_units.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;
using std::numbers::pi;

Scenario onFloor(double duration, double friction, double restitution, int dimension = 2) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, duration);
    s.materials[0].friction = friction;
    s.materials[0].restitution = restitution;
    addFloor(s);
    setReference(s, "planar_contact");
    return s;
}
/// A box tilted by `angle` about the corner that stays on the floor at the origin (angle > 0: to the left).
void addTilted(Scenario& s, double b, double h, double angle, double rate = 0) {
    const Quat q = fromAxisAngle({0, 0, 1}, angle);
    const Vec3 corner{angle > 0 ? -b : b, -h, 0};
    addBox(s, "block", {b, h, s.dimension == 3 ? 0.2 : 0.0}, 1, rotate(q, -corner));
    Body& body = s.bodies.back();
    body.pose.orientation = q;
    body.massProperties.inertia = Mat3::diagonal(1, 1, (b * b + h * h) / 3);
    body.angularVelocity = {0, 0, rate};
    body.velocity = cross(body.angularVelocity, body.pose.position);
}
/// A slender rod (capsule of a vanishing radius) with its foot at the origin, leaning by `tilt` from upright.
void addRod(Scenario& s, double half, double tilt, double rate = 0, Vec3 foot = {}) {
    const Quat q = fromAxisAngle({0, 0, 1}, -tilt);
    addBody(s, "rod", BodyType::Dynamic, Capsule{1e-13, half}, rotate(q, {0, half, 0}));
    Body& body = s.bodies.back();
    body.pose.orientation = q;
    body.massProperties = {1, {}, Mat3::diagonal(1, 1, half * half / 3)};
    body.angularVelocity = {0, 0, rate};
    body.velocity = foot + cross(body.angularVelocity, body.pose.position);
}
double quantity(const Reference& r, const char* name) {
    const auto all = r.quantities(0.01, Scheme::Unknown);
    const Quantity* q = findQuantity(all, name);
    EXPECT_NE(q, nullptr) << name;
    return q ? q->exact : 0.0;
}

/// The force from the reference's own velocities acts at the lowest corner, pushes, and obeys Coulomb.
void expectContactForce(const Scenario& s, const Reference& r, double t, Vec3 contact, bool slips) {
    const Wrench w = wrenchOn(s, r, 1, t, 1e-4);
    const double mu = s.materials[0].friction;
    EXPECT_LT(norm(w.remainder(contact)), 1e-6) << t;
    EXPECT_GT(w.force.y, 0.0) << t;
    if (slips) {
        EXPECT_NEAR(std::abs(w.force.x), mu * w.force.y, 1e-6) << t;
    } else {
        EXPECT_LT(std::abs(w.force.x), mu * w.force.y) << t;
    }
}

TEST(PlanarContact, RockingBlockOfHousner) {
    for (const int dimension : {2, 3}) {
        Scenario s = onFloor(2, 0.9, 0, dimension);
        addTilted(s, 0.1, 0.4, 0.15);
        const auto r = makeReference(s);
        EXPECT_NEAR(quantity(*r, "impact_time_1"), 0.3794327442, 1e-9);
        EXPECT_NEAR(quantity(*r, "impact_time_2"), 0.9599502251, 1e-9);
        EXPECT_NEAR(quantity(*r, "impact_time_3"), 1.440522242, 1e-9);
        EXPECT_NEAR(quantity(*r, "impact_time_4"), 1.851713166, 1e-9);
        EXPECT_NEAR(quantity(*r, "peak_1"), 0.1123422461, 1e-6);
        EXPECT_NEAR(quantity(*r, "peak_2"), 0.0877293220, 1e-6);
        expectContactForce(s, *r, 0.2, {}, false);
        expectContactForce(s, *r, 0.7, {0.2, 0, 0}, false);
        // The measures find what the exact run shows, to what steps can resolve of an impact.
        const Trajectory run = exactRun(s, *r, 0.001, 2000);
        for (const auto& q : r->quantities(0.001, Scheme::Unknown))
            EXPECT_NEAR(q.measure(run).value(), q.exact, 2e-4) << q.name;
    }
}

TEST(PlanarContact, RockingLosesWhatHousnerSaysAndKeepsTheMomentumAboutTheNewCorner) {
    Scenario s = onFloor(2, 0.9, 0);
    const double b = 0.13, h = 0.5;
    addTilted(s, b, h, -0.12, 0.4);
    const auto r = makeReference(s);
    const double t = quantity(*r, "impact_time_1"), alpha = std::atan(b / h);
    const double before = r->exact(1, t - 1e-7).angularVelocity->z,
                 after = r->exact(1, t + 1e-7).angularVelocity->z;
    EXPECT_NEAR(after / before, 1 - 1.5 * std::sin(alpha) * std::sin(alpha), 1e-5);
    EXPECT_NEAR(energyOf(s, *r, 0), energyOf(s, *r, t - 1e-9), 1e-7);
    EXPECT_LT(energyOf(s, *r, t + 1e-9), energyOf(s, *r, t - 1e-9));
    expectConsistent(s, *r, 1, 0.5 * t, 1e-8);
}

TEST(PlanarContact, SlenderRodFromUprightSticksAndThenSlipsBackOrForth) {
    // Stuck foot: the elliptic closed form, friction 3 s (3 c - 2)/(3 c - 1)^2.
    Scenario s = onFloor(1.05, 5.0, 0);
    addRod(s, 0.5, 0.05);
    const auto stuck = makeReference(s);
    const auto lean = [](const Reference& r, double t) {
        const Vec3 up = rotate(*r.exact(1, t).orientation, {0, 1, 0});
        return std::atan2(up.x, up.y);
    };
    EXPECT_NEAR(lean(*stuck, 0.5), 0.173706764, 1e-9);
    // The ratio of friction to load depends on the lean alone after a start at (almost) rest upright.
    const PlanarFrame frame(s, 1, 0);
    const PlanarMotion motion(frame.setup(), frame.start(), 1.0);
    for (const double t : {0.6, 0.8, 0.9}) {
        const auto load = motion.loadAt(t);
        const double a = lean(*stuck, t), c = std::cos(a), si = std::sin(a), c0 = std::cos(0.05);
        // A start from rest at 0.05 gives N = m g (1 - 3/4 s^2 - 3/2 c (c0 - c)), F = 3/4 m g s (3 c - 2 c0).
        EXPECT_NEAR(static_cast<double>(load->normal), 9.81 * (1 - 0.75 * si * si - 1.5 * c * (c0 - c)),
                    1e-8);
        EXPECT_NEAR(static_cast<double>(load->tangential), 9.81 * 0.75 * si * (3 * c - 2 * c0), 1e-8);
    }
    // The foot slips back before 35 degrees if mu is below 0.3706, forward after 48 if it is above.
    for (const double mu : {0.36, 0.38}) {
        Scenario slips = onFloor(1.06, mu, 0);
        addRod(slips, 0.5, 0.001, 0.0);
        slips.duration = 2.03;
        const PlanarFrame f(slips, 1, 0);
        const PlanarMotion m(f.setup(), f.start(), 2.0);
        ASSERT_FALSE(m.events().empty());
        const auto& first = m.events()[0];
        EXPECT_EQ(first.kind, PlanarMotion::EventKind::Slip);
        EXPECT_EQ(m.modeAt(first.time + 1e-6).kind,
                  mu < 0.3706 ? PlanarMotion::Kind::SlipBackward : PlanarMotion::Kind::SlipForward);
        const double angle = std::abs(static_cast<double>(first.before.angle));
        EXPECT_TRUE(mu < 0.3706 ? angle < 35.11 * pi / 180 : angle > 48.18 * pi / 180) << angle;
        expectContactForce(slips, *makeReference(slips), first.time + 0.01,
                           pointAt(*makeReference(slips), 1, first.time + 0.01, {0, -0.5, 0}), true);
    }
}

TEST(PlanarContact, RodOnIceFallsStraightDown) {
    Scenario s = onFloor(0.55, 0, 0);
    addRod(s, 0.5, 0.1);
    const auto r = makeReference(s);
    const Vec3 up = rotate(*r->exact(1, 0.5).orientation, {0, 1, 0});
    EXPECT_NEAR(std::atan2(up.x, up.y), 1.150705756, 1e-9);
    EXPECT_NEAR(r->exact(1, 0.5).position->x, s.bodies[1].pose.position.x, 1e-13);
    EXPECT_NEAR(energyOf(s, *r, 0.5), energyOf(s, *r, 0), 1e-11);
    const PlanarFrame frame(s, 1, 0);
    const PlanarMotion motion(frame.setup(), frame.start(), 1.0);
    ASSERT_FALSE(motion.events().empty());
    EXPECT_NEAR(motion.events()[0].time, 0.5859474728, 1e-8);
    // A capsule with a thick end falls in the same way, higher by its radius.
    Scenario thick = onFloor(0.55, 0, 0, 3);
    addRod(thick, 0.5, 0.1);
    std::get<Capsule>(thick.bodies[1].shapes[0].geometry).radius = 0.07;
    thick.bodies[1].pose.position.y += 0.07;
    const auto t = makeReference(thick);
    EXPECT_NEAR(t->exact(1, 0.5).position->y - 0.07, r->exact(1, 0.5).position->y, 1e-10);
}

struct PlanarHit {
    double inertia, rx, ry, vx, vy, mu, e;
    double x, y, w;
};
Scenario cornerHit(const PlanarHit& h) {
    Scenario s = onFloor(0.4, h.mu, h.e);
    s.gravity = {};
    addBody(s, "body", BodyType::Dynamic, ConvexHull{{{h.rx, h.ry, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}},
            {0, 0.3 - h.ry, 0});
    s.bodies[1].massProperties = {1, {}, Mat3::diagonal(1, 1, h.inertia)};
    s.bodies[1].velocity = {h.vx, h.vy, 0};
    return s;
}

TEST(PlanarContact, RodThatRestsAHairAboveTheFloorHasLanded) {
    Scenario s = onFloor(0.9, 0, 0);
    addRod(s, 0.5, 0.1);
    const auto r = makeReference(s);
    const double landing = quantity(*r, "impact_time_1");
    const double rate = norm(*r->exact(1, landing - 1e-9).angularVelocity);
    const auto measured = [&](double restsShort) {
        Trajectory run = exactRun(s, *r, 0.001, 900);
        for (std::size_t k = 0; k < run.times.size(); ++k) {
            auto& state = run.states[k * run.bodyCount + 1];
            const double last = landing - restsShort / rate;
            if (run.times[k] <= last) continue;
            state.orientation = *r->exact(1, last).orientation;
            state.angularVelocity = {};
        }
        return findQuantity(r->quantities(0.001, Scheme::Unknown), "impact_time_1")->measure(run);
    };
    for (const double restsShort : {1e-7, 1e-5, 5e-4}) {
        const auto time = measured(restsShort);
        ASSERT_TRUE(time.has_value()) << restsShort;
        EXPECT_NEAR(*time, landing, 5e-4) << restsShort;
    }
    EXPECT_FALSE(measured(0.01).has_value());
}

TEST(PlanarContact, CornerImpactsOfTheCatalogue) {
    const PlanarHit hits[] = {
        {0.1, 0.2, -0.4, 1, -2, 0.2, 0.5, 0.5161290323, 0.4193548387, 2.903225806},
        {0.1, -0.2, -0.4, 0.2, -2, 0.8, 0.5, 0.9066666667, 0.5466666667, -2.266666667},
        {1.0 / 12, -0.25, -0.4330127019, 0.6, -2, 0.3, 0.5, 1.261624321, 0.2054144024, -3.17834239}};
    for (const PlanarHit& h : hits) {
        const Scenario s = cornerHit(h);
        const auto r = makeReference(s);
        EXPECT_NEAR(quantity(*r, "impact_time_1"), 0.15, 1e-12);
        EXPECT_NEAR(quantity(*r, "along_after"), h.x, 1e-9);
        EXPECT_NEAR(quantity(*r, "above_after"), h.y, 1e-9);
        EXPECT_NEAR(quantity(*r, "spin_after"), h.w, 1e-8);
        const Trajectory run = exactRun(s, *r, 0.01, 40);
        for (const auto& q : r->quantities(0.01, Scheme::Unknown))
            EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-9) << q.name;
    }
}

TEST(PlanarContact, ImpulsesActAtTheCornerWithRestitutionAndCoulomb) {
    // A spinning box dropped with gravity: the second method is the pair of changes of momentum.
    Scenario s = onFloor(1.5, 0.25, 0.4);
    addBox(s, "box", {0.5, 0.1, 0}, 2, {0, 2, 0}, {1, 0, 0});
    s.bodies[1].angularVelocity = {0, 0, 4};
    const auto r = makeReference(s);
    // The catalogue's time of impact: y(t) = hx |sin| + hy |cos| with w = 4 from rest at 2 m.
    EXPECT_NEAR(quantity(*r, "impact_time_1"), 0.5616630192, 1e-9);
    const double t = quantity(*r, "impact_time_1");
    const auto a = r->exact(1, t - 1e-10), b = r->exact(1, t + 1e-10);
    const Vec3 impulse = 2.0 * (*b.velocity - *a.velocity);
    double low = 1e9;
    Vec3 corner;
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.1, 0.1}) {
            const Vec3 p = pointAt(*r, 1, t, {x, y, 0});
            if (p.y < low) {
                low = p.y;
                corner = p;
            }
        }
    EXPECT_NEAR(low, 0.0, 1e-9);
    const Vec3 arm = corner - *a.position;
    EXPECT_NEAR(s.bodies[1].massProperties.inertia(2, 2) * (b.angularVelocity->z - a.angularVelocity->z),
                cross(arm, impulse).z, 1e-7);
    const Vec3 ua = *a.velocity + cross(*a.angularVelocity, arm),
               ub = *b.velocity + cross(*b.angularVelocity, arm);
    EXPECT_NEAR(ub.y, -0.4 * ua.y, 1e-7);
    const bool sticks = std::abs(ub.x) < 1e-7;
    EXPECT_TRUE(sticks ? std::abs(impulse.x) <= 0.25 * impulse.y + 1e-7
                       : std::abs(impulse.x + 0.25 * impulse.y * (ub.x > 0 ? 1 : -1)) < 1e-7);
}

TEST(PlanarContact, PainleveRodSlidesBelowTheThresholdAndJamsAboveIt) {
    // The lean from the floor is theta; the foot slides ahead of the rod's fall.
    const auto scene = [](double mu, double theta) {
        Scenario s = onFloor(0.05, mu, 0);
        addRod(s, 0.5, -(pi / 2 - theta), 0, {1.0, 0, 0});
        return s;
    };
    const Scenario smooth = scene(0.5, 1.0);
    const PlanarFrame f(smooth, 1, 0);
    const PlanarMotion slides(f.setup(), f.start(), 0.05);
    const auto load = slides.loadAt(0);
    const double c = std::cos(1.0), si = std::sin(1.0);
    // Leading and trailing corner: p = 1 + 3 c (c -+ mu s); 8.2174 is the catalogue's with p = 1.1938.
    const double p = 9.81 / static_cast<double>(load->normal);
    EXPECT_TRUE(std::abs(p - (1 + 3 * c * (c - 0.5 * si))) < 1e-9 ||
                std::abs(p - (1 + 3 * c * (c + 0.5 * si))) < 1e-9);
    EXPECT_NEAR(static_cast<double>(load->normal), 8.217410913, 1e-8);
    const Scenario rough = scene(1.5, 1.1);
    const PlanarFrame g(rough, 1, 0);
    const PlanarMotion jams(g.setup(), g.start(), 0.05);
    ASSERT_FALSE(jams.events().empty());
    EXPECT_EQ(jams.events()[0].kind, PlanarMotion::EventKind::Jam);
    EXPECT_EQ(jams.events()[0].time, 0.0);
    // The foot stands still after the impact, and the momentum about the foot is unchanged.
    const auto& e = jams.events()[0];
    const double hx = 0.5 * std::cos(1.1), hy = 0.5 * std::sin(1.1), moment = 0.25 / 3;
    const double about =
        moment * static_cast<double>(e.before.rate) + -hy * 1.0;  // m (r x v), r = (-+hx, hy)
    const auto after = e.after;
    const double sign = g.start().x < 0 ? -1 : 1;
    EXPECT_NEAR(moment * static_cast<double>(after.rate) + sign * hx * static_cast<double>(after.vz) -
                    hy * static_cast<double>(after.vx),
                about, 1e-10);
    EXPECT_NEAR(static_cast<double>(after.vx) + hy * static_cast<double>(after.rate), 0.0, 1e-10);
    // The threshold for an unchanged friction is (1 + 3 c^2)/(3 s c).
    const double threshold = (1 + 3 * std::cos(1.1) * std::cos(1.1)) / (3 * std::sin(1.1) * std::cos(1.1));
    for (const double mu : {0.999 * threshold, 1.001 * threshold}) {
        const Scenario near = scene(mu, 1.1);
        const PlanarFrame n(near, 1, 0);
        if (mu > threshold) {
            EXPECT_EQ(PlanarMotion(n.setup(), n.start(), 1e-4).events().size(), 1U);
        } else {
            EXPECT_TRUE(PlanarMotion(n.setup(), n.start(), 1e-6).events().empty());
        }
    }
}

TEST(PlanarContact, TippingThresholds) {
    // Pushed at height y a box at rest tips where mu m g > F > m g b/(2 y) (width b), else it stays.
    const auto pushed = [](double force, double height) {
        Scenario s = onFloor(0.3, 0.9, 0);
        addBox(s, "box", {0.2, 0.5, 0}, 1, {0, 0.5, 0});
        s.forces.push_back(ConstantForce{1, {force, 0, 0}, {0, 0, -force * (height - 0.5)}});
        return makeReference(s)->exact(1, 0.3);
    };
    const double tips = 9.81 * 0.4 / (2 * 0.8);
    EXPECT_NEAR(pushed(0.999 * tips, 0.8).orientation->z, 0.0, 1e-15);
    EXPECT_LT(pushed(1.001 * tips, 0.8).orientation->z, -1e-6);
    // Case of a slope (gravity leans instead): tan(slope) against b/h.
    for (const double factor : {0.99, 1.01}) {
        Scenario s = onFloor(0.3, 0.9, 0);
        addBox(s, "box", {0.2, 0.5, 0}, 1, {0, 0.5, 0});
        const double slope = std::atan(0.4 * factor);
        s.gravity = {9.81 * std::sin(slope), -9.81 * std::cos(slope), 0};
        const bool stays = std::abs(makeReference(s)->exact(1, 0.3).orientation->z) < 1e-15;
        EXPECT_EQ(stays, factor < 1);
    }
    // The floor is too smooth: the body slides as a whole.
    Scenario s = onFloor(0.3, 0.1, 0);
    addBox(s, "box", {0.2, 0.5, 0}, 1, {0, 0.5, 0});
    s.gravity = {2, -9, 0};
    const auto slides = makeReference(s)->exact(1, 0.3);
    EXPECT_NEAR(slides.position->x, 0.5 * 0.3 * 0.3 * (2 - 0.1 * 9), 1e-15);
    EXPECT_EQ(slides.orientation->z, 0.0);
}

TEST(PlanarContact, ABoxThatSlidesOnItsSideStopsOrTipsOver) {
    // A start at 2 m/s against friction 0.3 ends after the time v/(mu g) and the distance v^2/(2 mu g).
    Scenario s = onFloor(2, 0.3, 0);
    addBox(s, "box", {0.2, 0.5, 0}, 1, {0, 0.5, 0}, {2, 0, 0});
    const auto r = makeReference(s);
    EXPECT_NEAR(r->exact(1, 0.4).velocity->x, 2 - 0.4 * 0.3 * 9.81, 1e-14);
    EXPECT_NEAR(r->exact(1, 1.9).position->x, 2.0 / (0.3 * 9.81), 1e-14);
    EXPECT_EQ(r->exact(1, 1.9).velocity->x, 0.0);
    // The same box tips forward over its leading edge at once if friction is above b/h.
    for (const double mu : {0.39, 0.41}) {
        Scenario tips = onFloor(0.2, mu, 0);
        addBox(tips, "box", {0.2, 0.5, 0}, 1, {0, 0.5, 0}, {2, 0, 0});
        const auto t = makeReference(tips);
        if (mu < 0.4) {
            EXPECT_EQ(t->exact(1, 0.1).angularVelocity->z, 0.0);
        } else {
            EXPECT_LT(t->exact(1, 0.1).angularVelocity->z, -1e-3);
            expectContactForce(tips, *t, 0.1, pointAt(*t, 1, 0.1, {0.2, -0.5, 0}), true);
        }
    }
}

TEST(PlanarContact, RockingOnASmoothFloorEndsFlatAfterAFiniteTime) {
    for (const double mu : {0.0, 0.01, 0.05, 0.1}) {
        Scenario s = onFloor(2.5, mu, 0);
        addTilted(s, 0.12, 0.45, 0.14);
        const auto r = makeReference(s);
        EXPECT_GT(r->validUntil(), 2.5);
        const auto end = r->exact(1, 2.4);
        EXPECT_NEAR(2 * std::asin(end.orientation->z), 0.0, 1e-12) << mu;
        EXPECT_NEAR(end.position->y, 0.45, 1e-12) << mu;
        if (mu == 0.0) {
            EXPECT_NEAR(end.position->x, s.bodies[1].pose.position.x, 1e-12);
        }
        const PlanarFrame frame(s, 1, 0);
        const PlanarMotion motion(frame.setup(), frame.start(), 2.5);
        // Energy never grows; velocity is the rate of the position on both sides of the limit.
        double before = energyOf(s, *r, 0);
        for (int k = 1; k <= 500; ++k) {
            const double now = energyOf(s, *r, 0.005 * k);
            EXPECT_LE(now, before + 1e-9) << mu << " at " << 0.005 * k;
            before = now;
        }
        // The momentum given by the impacts and the loads between them is the weight times the time.
        double settled = 0.0, given = 0.0;
        for (const auto& e : motion.events())
            if (e.kind == PlanarMotion::EventKind::Impact) {
                given += static_cast<double>(e.after.vz - e.before.vz);
                settled = e.time;
            }
        const int pieces = 100000;
        for (int k = 0; k < pieces; ++k) {
            const auto load = motion.loadAt((k + 0.5) * settled / pieces);
            if (load) given += static_cast<double>(load->normal) * settled / pieces;
        }
        EXPECT_NEAR(given, 9.81 * settled, 2e-4) << mu;
    }
}

TEST(PlanarContact, ABoxThatFallsFlatBouncesAsTheRestitutionSays) {
    for (const double mu : {0.0, 0.8}) {
        const double h = 0.25, drop = 0.05, e = 0.6, g = 9.81;
        Scenario s = onFloor(1.2, mu, e);
        addBox(s, "block", {0.4, h, 0}, 1, {0, h + drop, 0});
        s.bodies.back().massProperties.inertia = Mat3::diagonal(1, 1, (0.16 + h * h) / 3);
        const auto r = makeReference(s);
        const double fall = std::sqrt(2 * drop / g), fast = g * fall;
        EXPECT_NEAR(r->exact(1, fall * (1 + e)).position->y, h + e * e * drop, 1e-12) << mu;
        EXPECT_NEAR(r->exact(1, fall * (1 + 2 * e + e * e)).position->y, h + e * e * e * e * drop, 1e-12)
            << mu;
        EXPECT_NEAR(r->exact(1, fall * (1 + 1.5 * e)).velocity->y, -0.5 * e * fast, 1e-11) << mu;
        // Bounces end when the geometric series of the flights has run out, and the box stays.
        const double stop = fall * (1 + e) / (1 - e);
        EXPECT_GT(r->validUntil(), s.duration) << mu;
        EXPECT_NEAR(r->exact(1, stop + 1e-6).position->y, h, 1e-12) << mu;
        EXPECT_EQ(norm(*r->exact(1, stop + 1e-6).velocity), 0.0) << mu;
        const double before = r->exact(1, stop - 1e-3).position->y - h;
        EXPECT_GT(before, 1e-8) << mu;
    }
}

TEST(PlanarContact, ARockingBlockThatBouncesIsFollowedToTheEndWithoutGainingEnergy) {
    for (const double e : {0.01, 0.3}) {
        Scenario s = onFloor(4, 0.9, e);
        addTilted(s, 0.12, 0.45, 0.14);
        const auto r = makeReference(s);
        ASSERT_GT(r->validUntil(), s.duration) << e;
        double before = energyOf(s, *r, 0);
        for (int k = 1; k <= 800; ++k) {
            const double now = energyOf(s, *r, 0.005 * k);
            EXPECT_LE(now, before + 1e-9) << e << " at " << 0.005 * k;
            before = now;
        }
        EXPECT_LT(before, energyOf(s, *r, 0) - 1e-3) << e;
    }
}

TEST(PlanarContact, AnotherCornerThatLandsBouncesWhileTheFirstHolds) {
    // A low box turns about its left corner and lands on its base; the impulse at the right corner leaves the
    // left one pressed down, so that the box turns back with e times its rate.
    const double b = 0.42, h = 0.072, e = 0.35;
    Scenario s = onFloor(0.5, 0.9, e);
    addTilted(s, b, h, 0.1);
    const auto r = makeReference(s);
    const PlanarFrame frame(s, 1, 0);
    const PlanarMotion motion(frame.setup(), frame.start(), 0.5);
    ASSERT_FALSE(motion.events().empty());
    const auto& hit = motion.events()[0];
    ASSERT_GE(hit.other, 0);
    EXPECT_NEAR(static_cast<double>(hit.after.rate / hit.before.rate), -e, 1e-12);
    EXPECT_NEAR(static_cast<double>(hit.after.vx), static_cast<double>(-e * hit.before.vx), 1e-12);
}

TEST(PlanarContact, SmallAndLightBodiesHaveTheImpactsOfLargeOnes) {
    Scenario s = onFloor(1.5, 1.28, 0.0108);
    addTilted(s, 0.523, 1.962, 0.14);
    const auto whole = makeReference(s);
    Scenario small = s;
    const double scale = std::ldexp(1.0, -20);
    ASSERT_TRUE(inUnits(small, {scale, 1, scale}));
    const auto same = makeReference(small);
    for (const double t : {0.5, 0.7, 1.0, 1.5})
        EXPECT_NEAR(same->exact(1, t).position->y / scale, whole->exact(1, t).position->y, 1e-9) << t;
}

TEST(PlanarContact, RefusesAnImpactThatAddsEnergy) {
    // Perfect restitution and friction: after some bounces the slip is turned round and the law adds energy.
    Scenario s = onFloor(1.5, 0.9, 1.0);
    addTilted(s, 0.12, 0.45, 0.14);
    try {
        (void)makeReference(s);
        ADD_FAILURE() << "not refused";
    } catch (const AssumptionViolated& e) {
        EXPECT_NE(std::string(e.what()).find("adds energy"), std::string::npos) << e.what();
    }
}

TEST(PlanarContact, LowFrictionLetsAStruckBoxRockAndSlideToAStop) {
    for (const int dimension : {2, 3})
        for (const double mu : {0.0, 0.01, 0.05, 0.1}) {
            Scenario s = onFloor(3.5, mu, 0, dimension);
            addTilted(s, 0.15, 0.4, 1e-300, 1.4358152860945013);
            const auto r = makeReference(s);
            const double v0 = s.bodies[1].velocity.x;
            if (mu == 0.0) {
                EXPECT_NEAR(r->exact(1, 3.4).velocity->x, v0, 1e-13);
            }
            if (mu == 0.1) {
                EXPECT_EQ(r->exact(1, 3.4).velocity->x, 0.0);
            }
            // Friction has one direction all the way, so the momentum along the floor is mu times that across
            // it.
            if (mu > 0.0 && mu < 0.1) {
                const double t = 0.5;
                EXPECT_NEAR(r->exact(1, t).velocity->x, v0 + mu * (9.81 * t - s.bodies[1].velocity.y), 1e-12);
            }
        }
}

TEST(PlanarContact, RefusesWhatIsNotPlanar) {
    Scenario s = onFloor(1, 0.5, 0, 3);
    addTilted(s, 0.1, 0.4, 0.15);
    s.bodies[1].velocity.z = 0.1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = onFloor(1, 0.5, 0, 3);
    addTilted(s, 0.1, 0.4, 0.15);
    s.bodies[1].shapes.push_back({Box{{0.05, 0.05, 0.05}}, {{0, 0.5, 0.4}, {}}, 0});
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = onFloor(1, 0.5, 0);
    addTilted(s, 0.1, 0.4, 0.15);
    s.bodies[1].pose.position.y -= 0.05;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
