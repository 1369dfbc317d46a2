// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems: impacts, sliding, rolling, rest. Catalogued values, and second methods: integration of
// the equations of motion with friction, conservation laws, step-by-step event simulation.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/references/parts.hpp"
#include "validation/references/sliding/planar_slide.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;

void expectVec(Vec3 actual, Vec3 expected, double tolerance) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

/// Classic Runge-Kutta for v' = pull - f v/|v| until the speed gets small.
PlanarSlide::State integrateSlide(Vec3 pull, double f, Vec3 v, double duration) {
    Vec3 x{};
    const int steps = 200000;
    const double h = duration / steps;
    const auto a = [&](Vec3 u) { return pull - f * unit(u); };
    for (int k = 0; k < steps; ++k) {
        const Vec3 k1 = a(v), k2 = a(v + (h / 2) * k1), k3 = a(v + (h / 2) * k2), k4 = a(v + h * k3);
        x += h * v + (h * h / 6) * (k1 + k2 + k3);
        v += (h / 6) * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return {x, v};
}

TEST(PlanarSlide, AgreesWithIntegrationForEveryRatioOfFrictionToSlope) {
    for (const double f : {0.5, 2.0, 4.0, 5.9})
        for (const Vec3 v : {Vec3{2, 0, 0}, Vec3{1, 0, -3}, Vec3{-0.5, 0, 4}}) {
            const Vec3 pull{0, 0, 4};
            const PlanarSlide slide(pull, f, v, f);
            // Integration does not resolve the stop itself: end shortly before it.
            const double duration = std::min(0.5, 0.95 * slide.stopTime().value_or(1));
            const auto numeric = integrateSlide(pull, f, v, duration);
            const auto exact = slide.at(duration);
            expectVec(exact.velocity, numeric.velocity, 1e-9);
            expectVec(exact.displacement, numeric.displacement, 1e-9);
        }
    // kappa = 1 and cross-slope: half the speed straight downhill in the end; X(0.5), S(0.5) of the
    // catalogue.
    const double g = 9.81 * std::sin(std::atan(0.5));
    const PlanarSlide critical({0, 0, g}, g, {2, 0, 0}, g);
    expectVec(critical.at(0.5).displacement, {0.5244772904, 0, 0.3328364227}, 1e-9);
    expectVec(critical.at(40).velocity, {0, 0, 1}, 1e-6);
    const double a = 0.5235987755982988;
    EXPECT_NEAR(*PlanarSlide({0, 0, 9.81 * std::sin(a)}, 0.7 * 9.81 * std::cos(a), {2, 0, 0},
                             0.7 * 9.81 * std::cos(a))
                     .stopTime(),
                1.051845113, 1e-9);
}

Scenario inclineScene(double alpha, double mu, Vec3 velocity, double duration) {
    // The slope falls towards +x; the normal is (sin, cos, 0).
    Scenario s = emptyScene(3, {0, -9.81, 0}, duration);
    const Quat tilt = fromAxisAngle({0, 0, 1}, -alpha);
    const Vec3 n = rotate(tilt, {0, 1, 0});
    addFloor(s, n);
    addBox(s, "block", {0.2, 0.05, 0.2}, 2, 0.05 * n, rotate(tilt, velocity));
    s.bodies[1].pose.orientation = tilt;
    s.materials[0].friction = mu;
    setReference(s, "incline_slide");
    return s;
}

TEST(InclineSlide, CatalogueUpSlopeLaunchAndSticking) {
    const Scenario s = inclineScene(0.5, 0.3, {-3, 0, 0}, 1);
    const auto reference = makeReference(s);
    const auto along = [&](double t) {
        return norm(*reference->exact(1, t).position - s.bodies[1].pose.position);
    };
    EXPECT_NEAR(along(0.3), 0.5721349494, 1e-9);
    EXPECT_NEAR(along(1), 0.2507618064, 1e-9);
    EXPECT_NEAR(norm(*reference->exact(1, 1).velocity), 1.247338149, 1e-9);
    const Scenario stuck = inclineScene(0.5, 0.56, {}, 10);
    EXPECT_EQ(*makeReference(stuck)->exact(1, 10).position, stuck.bodies[1].pose.position);
    const Scenario loose = inclineScene(0.5, 0.54, {}, 10);
    EXPECT_NEAR(norm(*makeReference(loose)->exact(1, 10).velocity),
                10 * 9.81 * (std::sin(0.5) - 0.54 * std::cos(0.5)), 1e-10);
    Scenario tall = inclineScene(0.5, 0.9, {}, 1);
    std::get<Box>(tall.bodies[1].shapes[0].geometry).halfExtents = {0.05, 0.2, 0.05};
    tall.bodies[1].pose.position = 0.2 * rotate(tall.bodies[1].pose.orientation, {0, 1, 0});
    EXPECT_THROW(makeReference(tall), AssumptionViolated);
}

TEST(SlidingStop, DistanceTimeSchemeAndRefusals) {
    Scenario s = inclineScene(0, 0.5, {3 * std::cos(0.7), 0, 3 * std::sin(0.7)}, 1);
    setReference(s, "sliding_stop", {{"body", std::string("block")}, {"on", std::string("floor")}});
    const auto reference = makeReference(s);
    const Vec3 end = *reference->exact(1, 1).position - s.bodies[1].pose.position;
    EXPECT_NEAR(norm(end), 0.9174311927, 1e-10);
    EXPECT_NEAR(std::atan2(end.z, end.x), 0.7, 1e-14);
    // An ideal symplectic run stops v h/2 earlier to first order, and is what stepping by hand gives.
    const double h = 0.01;
    double x = 0, v = 3;
    for (int k = 0; k < 100; ++k) {
        v = std::max(0.0, v - 0.5 * 9.81 * h);
        x += h * v;
    }
    EXPECT_NEAR(norm(*reference->schemeExact(1, 100, h, Scheme::SymplecticEuler)->position -
                     s.bodies[1].pose.position),
                x, 1e-13);
    EXPECT_NEAR(x, norm(end) - 3 * h / 2, 2e-4);
    const auto quantities = reference->quantities(h, Scheme::SymplecticEuler);
    EXPECT_NEAR(*findQuantity(quantities, "stop_distance")->schemeExact, x, 1e-13);
    const Trajectory run = exactRun(s, *reference, h, 100);
    for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
    s.gravity = {0.5, -9.81, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.gravity = {0, -9.81, 0};
    s.bodies[1].angularVelocity = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(FrictionSweep, EveryDirectionStopsAtOneDistance) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 1);
    s.materials[0].friction = 0.5;
    addFloor(s);
    for (int i = 0; i < 5; ++i)
        addBox(s, "b" + std::to_string(i), {0.1, 0.05, 0.1}, 1, {0, 0.05, 3.0 * i},
               {3 * std::cos(0.4 * i), 0, 3 * std::sin(0.4 * i)});
    setReference(s, "friction_sweep");
    const auto reference = makeReference(s);
    for (int i = 1; i <= 5; ++i)
        EXPECT_NEAR(norm(*reference->exact(i, 1).position - s.bodies[i].pose.position), 0.9174311927, 1e-10);
    const Trajectory run = exactRun(s, *reference, 0.01, 100);
    for (const auto& q : reference->quantities(0.01, Scheme::Unknown))
        EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
}

TEST(BouncingBall, CatalogueQuantitiesAndAccumulation) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 6);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 1.1, 0});
    addFloor(s);
    s.materials[0].restitution = 0.8;
    setReference(s, "bouncing_ball");
    const auto reference = makeReference(s);
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    const double times[] = {0.451523641, 1.173961467, 1.751911727};
    for (int n = 1; n <= 3; ++n)
        EXPECT_NEAR(findQuantity(quantities, "bounce_time_" + std::to_string(n))->exact, times[n - 1], 1e-9);
    EXPECT_NEAR(findQuantity(quantities, "apex_height_1")->exact, 0.1 + 0.64, 1e-12);
    EXPECT_GT(reference->exact(0, 4.06).position->y, 0.1);
    EXPECT_NEAR(reference->exact(0, 4.07).position->y, 0.1, 1e-15);  // the ball rests after t = 4.063712769
    for (const double dt : {0.01, 0.013}) {
        const Trajectory run = exactRun(s, *reference, dt, static_cast<int>(5 / dt));
        for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-9) << q.name;
    }
    // Event by event: the height from an independent walk through the bounces.
    double t = 0, h = 1, v = 0;
    while (t + (v + std::sqrt(v * v + 2 * 9.81 * h)) / 9.81 < 3.0) {
        const double fall = (v + std::sqrt(v * v + 2 * 9.81 * h)) / 9.81;
        t += fall;
        v = 0.8 * (9.81 * fall - v);
        h = 0;
    }
    EXPECT_NEAR(reference->exact(0, 3.0).position->y, 0.1 + h + v * (3 - t) - 4.905 * (3 - t) * (3 - t),
                1e-12);
    s.bodies[0].velocity = {1, 0, 0};
    EXPECT_NO_THROW(makeReference(s));
    s.materials[0].friction = 0.3;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(Collision1d, CatalogueConservationAndWalls) {
    Scenario s = emptyScene(3, {}, 2);
    addBall(s, "a", 0.1, 1, 0.4, {-1, 0.5, 0}, {2, 0, 0});
    addBall(s, "b", 0.2, 3, 0.4, {1, 0.5, 0}, {-1, 0, 0});
    s.materials[0].restitution = 0.5;
    setReference(s, "collision_1d");
    const auto reference = makeReference(s);
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(quantities, "velocity_a")->exact, -1.375, 1e-13);
    EXPECT_NEAR(findQuantity(quantities, "velocity_b")->exact, 0.125, 1e-13);
    EXPECT_NEAR(findQuantity(quantities, "energy_loss")->exact, 2.53125, 1e-13);
    EXPECT_NEAR(findQuantity(quantities, "impact_time")->exact, 1.7 / 3, 1e-13);
    const Trajectory run = exactRun(s, *reference, 0.01, 200);
    for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
    // The common centre of mass moves on undisturbed.
    const Vec3 com = 1.0 * *reference->exact(0, 2).position + 3.0 * *reference->exact(1, 2).position;
    expectVec(com, {-1 + 3 + 2 * (2 - 3), 2, 0}, 1e-12);
    s.bodies[1].velocity = {3, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.bodies[1].velocity = {-1, 0.01, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    Scenario wall = emptyScene(3, {}, 2);
    addBall(wall, "a", 0.1, 1, 0.4, {0, 2, 0}, {0, -2, 0});
    addFloor(wall);
    wall.materials[0].restitution = 0.25;
    setReference(wall, "collision_1d");
    EXPECT_NEAR(makeReference(wall)->exact(0, 2).velocity->y, 0.5, 1e-14);
    EXPECT_NEAR(makeReference(wall)->exact(0, 2).position->y, 0.1 + 0.5 * (2 - 0.95), 1e-13);
}

TEST(NewtonsCradle, CatalogueAndGaps) {
    const auto cradle = [](std::vector<double> masses, double gap) {
        Scenario s = emptyScene(3, {}, 10);
        for (std::size_t i = 0; i < masses.size(); ++i)
            addBall(s, "b" + std::to_string(i), 0.1, masses[i], 0.4, {(0.2 + gap) * i, 0, 0},
                    {i == 0 ? 1.0 : 0.0, 0, 0});
        s.materials[0].restitution = 1.0;
        setReference(s, "newtons_cradle");
        return s;
    };
    const auto velocities = [](const Scenario& s) {
        const auto reference = makeReference(s);
        std::vector<double> v;
        for (const int b : reference->bodies()) v.push_back(reference->exact(b, 10).velocity->x);
        return v;
    };
    const auto five = velocities(cradle({1, 1, 1, 1, 1}, 0.01));
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(five[i], i == 4 ? 1 : 0, 1e-14);
    const auto unequal = velocities(cradle({1, 2, 1}, 0.01));
    EXPECT_NEAR(unequal[0], -0.3333333333, 1e-9);
    EXPECT_NEAR(unequal[1], 0.2222222222, 1e-9);
    EXPECT_NEAR(unequal[2], 0.8888888889, 1e-9);
    const Scenario touching = cradle({1, 1, 1}, 0);
    EXPECT_THROW(makeReference(touching), AssumptionViolated);
}

TEST(SpherePlaneImpact, CatalogueSlipAndStick) {
    for (const double mu : {0.2, 0.5}) {
        Scenario s = emptyScene(3, {}, 1);
        addBall(s, "ball", 0.1, 1.7, 0.4, {0, 0.5, 0}, {3, -2, 0});
        addFloor(s);
        s.materials[0] = {"stuff", mu, 0.8, 1000};
        setReference(s, "sphere_plane_impact");
        const auto reference = makeReference(s);
        const auto after = reference->exact(0, 1);
        EXPECT_NEAR(after.velocity->x, mu < 0.3 ? 2.28 : 15.0 / 7, 1e-12);
        EXPECT_NEAR(after.velocity->y, 1.6, 1e-14);
        // A ball that rolls along +x turns about -z if y is up.
        EXPECT_NEAR(after.angularVelocity->z, mu < 0.3 ? -18 : -150.0 / 7, 1e-12);
        EXPECT_NEAR(after.position->y, 0.1 + 1.6 * 0.8, 1e-12);
        const Trajectory run = exactRun(s, *reference, 0.01, 100);
        for (const auto& q : reference->quantities(0.01, Scheme::Unknown))
            EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-11) << q.name;
    }
}

TEST(SpherePlaneImpact, AngularMomentumAboutTheContactAndGravity) {
    // Friction and normal force act in the contact point: m r n x v + I w about it is kept in its plane.
    Scenario s = emptyScene(3, {0.4, -9.81, 1}, 0.6);
    addBall(s, "ball", 0.2, 1.7, 0.55, {0, 1, 0}, {3, -2, 1}, {4, 5, -6});
    addFloor(s);
    s.materials[0] = {"stuff", 0.3, 0.6, 1000};
    setReference(s, "sphere_plane_impact");
    const auto reference = makeReference(s);
    const double t = findQuantity(reference->quantities(0.01, Scheme::Unknown), "impact_time")->exact;
    const auto momentum = [&](double at) {
        const auto e = reference->exact(0, at);
        return cross(Vec3{0, 0.2, 0}, *e.velocity) + (0.55 * 0.04) * *e.angularVelocity;
    };
    expectVec(momentum(t + 1e-9), momentum(t - 1e-9), 1e-7);
    EXPECT_NEAR(reference->exact(0, t + 1e-9).velocity->y, -0.6 * reference->exact(0, t - 1e-9).velocity->y,
                1e-7);
    EXPECT_LT(reference->validUntil(), 1e3);
}

TEST(TwoSphereImpact, CatalogueAndConservation) {
    Scenario s = emptyScene(3, {}, 1);
    addBall(s, "a", 0.1, 1, 0.4, {0, 0, 0}, {2, 0, 0});
    addBall(s, "b", 0.1, 2, 0.4, {0.16, 0.12, 0}, {}, {0, 0, 10});
    s.materials[0] = {"stuff", 0.1, 0.5, 1000};
    setReference(s, "two_sphere_impact");
    const auto reference = makeReference(s);
    const auto a = reference->exact(0, 0.5), b = reference->exact(1, 0.5);
    expectVec(*a.velocity, {0.6971428571, -0.9295238095, 0}, 1e-9);
    expectVec(*b.velocity, {0.6514285714, 0.4647619048, 0}, 1e-9);
    expectVec(*a.angularVelocity, {0, 0, 0.9523809524}, 1e-9);
    expectVec(*b.angularVelocity, {0, 0, 10.47619048}, 1e-8);
    expectVec(1.0 * *a.velocity + 2.0 * *b.velocity, {2, 0, 0}, 1e-14);
    const Vec3 before = 0.008 * Vec3{0, 0, 10};  // L about the origin: k m r^2 of b; a passes through it
    const Vec3 after = cross(*a.position, *a.velocity) + 2.0 * cross(*b.position, *b.velocity) +
                       0.004 * *a.angularVelocity + 0.008 * *b.angularVelocity;
    expectVec(after, before, 1e-14);
    // The quantities are the components themselves, and are found in a run.
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(quantities, "velocity_x_a")->exact, 0.6971428571, 1e-9);
    EXPECT_NEAR(findQuantity(quantities, "velocity_y_b")->exact, 0.4647619048, 1e-9);
    EXPECT_NEAR(findQuantity(quantities, "spin_z_b")->exact, 10.47619048, 1e-8);
    EXPECT_EQ(findQuantity(quantities, "velocity_a"), nullptr);
    const Trajectory run = exactRun(s, *reference, 0.01, 100);
    for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
    s.bodies[0].velocity = {-2, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(TwoSphereImpact, VelocitiesRightAfterAnImpactInFreeFall) {
    Scenario s = emptyScene(2, {0, -9.81, 0}, 1);
    addBall(s, "a", 0.1, 1, 0.5, {0, 0, 0}, {2, 0, 0});
    addBall(s, "b", 0.1, 2, 0.5, {0.56, 0.12, 0});
    setReference(s, "two_sphere_impact");
    const auto reference = makeReference(s);
    const auto quantities = reference->quantities(0.01, Scheme::Unknown);
    const double t = (0.56 - 0.16) / 2;
    EXPECT_NEAR(findQuantity(quantities, "velocity_y_a")->exact, reference->exact(0, t + 1e-9).velocity->y,
                1e-7);
    const Trajectory run = exactRun(s, *reference, 0.01, 100);
    for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
    EXPECT_NE(findQuantity(quantities, "spin_a"), nullptr);
}

TEST(SlipToRoll, CatalogueMasseAndDisc) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 1);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 0, 0.1}, {2, 0, 0}, {20, 0, 0});
    addFloor(s, {0, 0, 1});
    s.materials[0].friction = 0.2;
    setReference(s, "slip_to_roll");
    const auto reference = makeReference(s);
    expectVec(*reference->exact(0, 1).velocity, {10.0 / 7, -4.0 / 7, 0}, 1e-12);
    expectVec(*reference->exact(0, 1).position, {1.546253391, -0.4537466091, 0.1}, 1e-9);
    const auto quantities = reference->quantities(0.005, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(quantities, "roll_time")->exact, 0.4118868683, 1e-10);
    const Trajectory run = exactRun(s, *reference, 0.005, 200);
    for (const auto& q : quantities) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-9) << q.name;
    // The orientation's rate is the spin.
    const double h = 1e-3;
    for (const double t : {0.2, 0.7}) {
        const auto q = [&](double at) { return *reference->exact(0, at).orientation; };
        const Quat d = q(t + h) * conjugate(q(t - h));
        expectVec((2 / (2 * h)) * Vec3{d.x, d.y, d.z}, *reference->exact(0, t).angularVelocity, 2e-2);
    }
    Scenario disc = emptyScene(2, {0, -9.81, 0}, 3);
    addBall(disc, "ball", 0.3, 2, 0.5, {0, 0.3, 0}, {3, 0, 0});
    addFloor(disc);
    disc.materials[0].friction = 0.2;
    setReference(disc, "slip_to_roll");
    EXPECT_NEAR(makeReference(disc)->exact(0, 3).velocity->x, 2.0, 1e-12);  // 2/3 v0
}

TEST(SlipToRoll, SchemeIsWhatSteppingByHandGives) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 1);
    addBall(s, "ball", 0.1, 1, 0.4, {0, 0.1, 0}, {2, 0, 0.5}, {3, 1, 20});
    addFloor(s);
    s.materials[0].friction = 0.25;
    setReference(s, "slip_to_roll");
    const auto reference = makeReference(s);
    Vec3 x{0, 0.1, 0}, v{2, 0, 0.5}, w{3, 1, 20};
    const Vec3 n{0, 1, 0};
    const double h = 0.01;
    for (int k = 0; k < 80; ++k) {
        const Vec3 u = v - 0.1 * cross(w, n);
        const double stick = norm(u) / 3.5, slide = 0.25 * 9.81 * h;
        const Vec3 impulse = -std::min(stick, slide) * unit(u);
        v += impulse;
        w += (1 / (0.4 * 0.1)) * cross(-n, impulse);
        x += h * v;
        const auto ideal = reference->schemeExact(0, k + 1, h, Scheme::SymplecticEuler);
        expectVec(*ideal->position, x, 1e-12);
        expectVec(*ideal->velocity, v, 1e-12);
        expectVec(*ideal->angularVelocity, w, 1e-10);
    }
}

TEST(RollingIncline, CatalogueRollAndSlip) {
    const double alpha = M_PI / 6;
    for (const double mu : {0.5, 0.1}) {
        Scenario s = emptyScene(3, {9.81 * std::sin(alpha), -9.81 * std::cos(alpha), 0}, 1);
        addBall(s, "ball", 0.1, 1, 0.4, {0, 0.1, 0});
        addFloor(s);
        s.materials[0].friction = mu;
        setReference(s, "rolling_incline");
        const auto reference = makeReference(s);
        const auto e = reference->exact(0, 1);
        EXPECT_NEAR(e.position->x, mu > 0.2 ? 1.751785714 : 2.027714539, 1e-8);
        EXPECT_NEAR(e.velocity->x, mu > 0.2 ? 3.503571429 : 4.055429079, 1e-8);
        EXPECT_NEAR(-e.angularVelocity->z, mu > 0.2 ? 35.03571429 : 21.23927303, 1e-7);
        const Trajectory run = exactRun(s, *reference, 0.01, 100);
        for (const auto& q : reference->quantities(0.01, Scheme::Unknown))
            EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-10) << q.name;
    }
}

TEST(Turntable, CatalogueAndItsOwnEquation) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 1);
    const int table = addBody(s, "table", BodyType::Kinematic, Box{{2, 2, 0.1}}, {0, 0, -0.1});
    s.bodies[table].angularVelocity = {0, 0, 3.5};
    // Rolling at the start: v - r w x n = Omega x p.
    const Vec3 v{0, 0.2, 0}, surface{0, 3.5 * 0.5, 0};
    addBall(s, "ball", 0.1, 1, 0.4, {0.5, 0, 0.1}, v, (1 / 0.1) * cross(Vec3{0, 0, 1}, v - surface));
    s.materials[0].friction = 0.5;
    setReference(s, "turntable");
    const auto reference = makeReference(s);
    expectVec(*reference->exact(1, 1).position, {0.4080604612, 0.168294197, 0.1}, 1e-9);
    const Trajectory run = exactRun(s, *reference, 0.01, 100);
    for (const auto& q : reference->quantities(0.01, Scheme::Unknown))
        EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-12) << q.name;
    s.bodies[1].angularVelocity.x += 1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(AtRest, StandsAndRefusesWhatCanNotStand) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 5);
    s.materials[0].friction = 0.4;
    addFloor(s);
    addBox(s, "low", {0.5, 0.5, 0.5}, 1, {0, 0.5, 0});
    addBox(s, "high", {0.5, 0.5, 0.5}, 1, {0, 1.5, 0});
    setReference(s, "at_rest");
    const auto reference = makeReference(s);
    EXPECT_EQ(reference->bodies().size(), 2U);
    EXPECT_EQ(*reference->exact(2, 5).position, (Vec3{0, 1.5, 0}));
    s.bodies[2].pose.position = {0, 2.5, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);  // nothing under it
    s.bodies[2].pose.position = {0, 1.5, 0};
    s.bodies[2].velocity = {0, 0.1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    Scenario slope = inclineScene(0.5, 0.3, {}, 1);
    setReference(slope, "at_rest");
    EXPECT_THROW(makeReference(slope), AssumptionViolated);
}

TEST(ClearWay, WhatStandsInThePathBreaksTheAssumptionsWhatStandsBesideItDoesNot) {
    const auto scene = [](Vec3 wall) {
        Scenario s = emptyScene(3, {0, -10, 0}, 2);
        s.materials[0].friction = 0.2;
        addFloor(s);
        addBody(s, "wall", BodyType::Static, Box{{0.1, 1, 1}}, wall);
        addBox(s, "block", {0.2, 0.1, 0.2}, 1, {0, 0.1, 0}, {3, 0, 0});
        setReference(s, "sliding_stop", {{"body", std::string("block")}, {"on", std::string("floor")}});
        return s;
    };
    // It stops after 9/(2 2) = 2.25 m: its front comes to 2.45.
    EXPECT_THROW(makeReference(scene({1.5, 1, 0})), AssumptionViolated);
    EXPECT_THROW(makeReference(scene({2.5, 1, 0})), AssumptionViolated);
    const Scenario beyond = scene({2.56, 1, 0}), beside = scene({1.5, 1, 1.21});
    EXPECT_NE(makeReference(beyond), nullptr);
    EXPECT_NE(makeReference(beside), nullptr);

    for (const double aside : {0.0, 0.25}) {
        Scenario balls = emptyScene(3, {}, 1);
        addBall(balls, "a", 0.1, 1, 0.4, {}, {2, 0, 0});
        addBall(balls, "b", 0.1, 1, 0.4, {0.5, 0, 0});
        addBall(balls, "third", 0.1, 1, 0.4, {0.9, aside, 0});
        balls.materials[0].restitution = 1.0;
        setReference(balls, "collision_1d", {{"a", std::string("a")}, {"b", std::string("b")}});
        if (aside == 0.0) {
            EXPECT_THROW(makeReference(balls), AssumptionViolated);
        } else {
            EXPECT_NE(makeReference(balls), nullptr);
        }
    }
    Scenario fall = emptyScene(3, {0, -10, 0}, 1);
    addBody(fall, "table", BodyType::Static, Box{{1, 0.1, 1}}, {0, -2, 0});
    addBall(fall, "ball", 0.1, 1, 0.4, {});
    setReference(fall, "free_flight", {{"body", std::string("ball")}});
    EXPECT_THROW(makeReference(fall), AssumptionViolated);
}

TEST(Table, SortedNamedAndComplete) {
    const auto& table = referenceTable();
    EXPECT_EQ(table.size(), 56U);
    for (std::size_t i = 1; i < table.size(); ++i) EXPECT_LT(std::string(table[i - 1].name), table[i].name);
    for (const auto& entry : table) EXPECT_EQ(findReference(entry.name), &entry);
    Scenario s = emptyScene(3, {}, 1);
    EXPECT_EQ(makeReference(s), nullptr);
    setReference(s, "no_such_reference");
    EXPECT_THROW(makeReference(s), std::invalid_argument);
    addBall(s, "ball", 0.1, 1, 0.4, {});
    // Every reference refuses a scene that it is not about, and names of bodies that do not exist.
    for (const auto& entry : table) {
        setReference(s, entry.name, {{"nonsense", true}});
        EXPECT_THROW(makeReference(s), std::invalid_argument) << entry.name;
    }
}

}  // namespace
}  // namespace rigor::validation::testing
