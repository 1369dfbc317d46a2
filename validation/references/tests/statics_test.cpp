// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Static equilibrium against closed-form thresholds and, of arches, against the line of thrust: pyramids of
// cylinders and balls, arches, ladders, overhangs, slopes; forces of stacks against the weights above.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/statics/touching.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;
using std::numbers::pi;

Scenario standing(int dimension, double friction) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 2);
    s.materials[0].friction = friction;
    setReference(s, "static_equilibrium");
    return s;
}
bool stands(const Scenario& s) {
    const auto r = makeReference(s);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    const double moves = findQuantity(all, "moves")->exact;
    EXPECT_EQ(r->bodies().empty(), moves == 1.0);
    return moves == 0.0;
}
/// Bisects the parameter at which `scene` changes between standing (above) and falling.
template <class F>
double threshold(double low, double high, const F& scene) {
    EXPECT_FALSE(stands(scene(low)));
    EXPECT_TRUE(stands(scene(high)));
    while (high - low > 1e-5 * high) {
        const double middle = 0.5 * (low + high);
        try {
            (stands(scene(middle)) ? high : low) = middle;
        } catch (const AssumptionViolated&) {
            return middle;  // too near to the threshold to decide
        }
    }
    return 0.5 * (low + high);
}

TEST(StaticEquilibrium, PyramidOfThreeCylinders) {
    const auto scene = [](double between, double floor) {
        Scenario s = standing(2, 0);
        s.materials.push_back({"floor", 0.0, 0.0, 1000.0});
        s.pairs = {{0, 0, between, 0, 0}, {0, 1, floor, 0, 0}};
        addFloor(s);
        s.bodies[0].shapes[0].material = 1;
        addBall(s, "left", 0.5, 1, 0.5, {-0.5, 0.5, 0});
        addBall(s, "right", 0.5, 1, 0.5, {0.5, 0.5, 0});
        addBall(s, "top", 0.5, 2, 0.5, {0, 0.5 + std::sqrt(0.75), 0});
        return s;
    };
    EXPECT_NEAR(threshold(0.2, 0.4, [&](double mu) { return scene(mu, 1); }), 0.2679491924, 1e-5);
    EXPECT_NEAR(threshold(0.05, 0.4, [&](double mu) { return scene(1, mu); }), 0.1339745962, 1e-5);
    // The floor carries W + w/2 at each place for W below and w on top.
    const Scenario rough = scene(0.5, 0.5);
    const auto r = makeReference(rough);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(all, "force_floor_left")->exact, 9.81 * 2, 1e-9);
    const auto points = touchingPoints(rough);
    EXPECT_EQ(points.size(), 5U);
}

TEST(StaticEquilibrium, PyramidOfFourBalls) {
    const auto scene = [](double between, double floor) {
        Scenario s = standing(3, 0);
        s.materials.push_back({"floor", 0.0, 0.0, 1000.0});
        s.pairs = {{0, 0, between, 0, 0}, {0, 1, floor, 0, 0}};
        addFloor(s);
        s.bodies[0].shapes[0].material = 1;
        const double a = 1 / std::sqrt(3.0);
        for (int i = 0; i < 3; ++i)
            addBall(s, "ball" + std::to_string(i), 0.5, 1, 0.4,
                    {a * std::cos(2 * pi * i / 3), 0.5, a * std::sin(2 * pi * i / 3)});
        addBall(s, "top", 0.5, 2, 0.4, {0, 0.5 + std::sqrt(2.0 / 3), 0});
        return s;
    };
    EXPECT_NEAR(threshold(0.28, 0.36, [&](double mu) { return scene(mu, 1); }), 0.3178372452, 1e-5);
    EXPECT_NEAR(threshold(0.1, 0.15, [&](double mu) { return scene(1, mu); }), 0.1271348981, 1e-5);
    for (const double mu : {0.31, 0.315, 0.3175, 0.31783}) EXPECT_FALSE(stands(scene(mu, 1))) << mu;
    for (const double mu : {0.31785, 0.319, 0.321, 0.325}) EXPECT_TRUE(stands(scene(mu, 1))) << mu;
}

/// n equal voussoirs over half a circle of mid radius 1 between two fixed springers, edges straight.
Scenario arch(int n, double thickness) {
    Scenario s = standing(2, 5.0);
    const double inner = 1 - thickness / 2, outer = 1 + thickness / 2;
    addBody(s, "left", BodyType::Static, Box{{thickness, 0.1, 0}}, {-1, -0.1, 0});
    addBody(s, "right", BodyType::Static, Box{{thickness, 0.1, 0}}, {1, -0.1, 0});
    for (int i = 0; i < n; ++i) {
        const double a = pi * i / n, b = pi * (i + 1) / n, m = 0.5 * (a + b);
        const auto at = [](double r, double angle) {
            return Vec3{r * std::cos(angle), r * std::sin(angle), 0};
        };
        const auto addStone = [&](const std::vector<Vec3>& corners) {
            // Mass and centre of the ring sector, as the catalogue has them.
            const double ring = std::sin(0.5 * (b - a)) / (0.5 * (b - a)) * 2.0 / 3.0 *
                                (std::pow(outer, 3) - std::pow(inner, 3)) / (outer * outer - inner * inner);
            const Vec3 center = at(ring, m);
            ConvexHull hull;
            for (const Vec3 c : corners) hull.vertices.push_back(c - center);
            addBody(s, "stone" + std::to_string(i), BodyType::Dynamic, hull, center);
            s.bodies.back().massProperties = {1, {}, Mat3::diagonal(1, 1, 0.01)};
        };
        addStone({at(inner, a), at(outer, a), at(outer, b), at(inner, b)});
    }
    return s;
}

/// The thickness at which the line of thrust just fits into the right half of arch(n): the crown pushes with
/// H at the height M/H, and at every joint the resultant of what is above passes between intrados and
/// extrados, two conditions that are linear in H and M. The arch is critical if the widest gap between them
/// is zero.
double criticalThickness(int n) {
    const auto widest = [n](double thickness) {
        const Scenario s = arch(n, thickness);
        const auto gap = [&](double thrust) {
            // extent, weight and moment of the stones above the joint
            double low = -1e300, high = 1e300, weight = 0, moment = 0;
            for (int i = n / 2; i >= 0; --i) {
                const double angle = pi * i / n;
                const auto at = [&](double r) { return Vec3{r * std::cos(angle), r * std::sin(angle), 0}; };
                const Vec3 inner = at(1 - thickness / 2), outer = at(1 + thickness / 2);
                low = std::max(low, inner.y * thrust - (moment - weight * inner.x));
                high = std::min(high, outer.y * thrust - (moment - weight * outer.x));
                if (i == 0) break;
                moment += s.bodies[i + 1].pose.position.x;
                weight += 1;
            }
            return high - low;
        };
        double a = 0, b = n;  // thrust beside the weight of a stone; the gap is concave in it
        for (int k = 0; k < 200; ++k) {
            const double p = a + (b - a) / 3, q = b - (b - a) / 3;
            (gap(p) < gap(q) ? a : b) = gap(p) < gap(q) ? p : q;
        }
        return gap(a);
    };
    double low = 0.05, high = 0.2;
    for (int k = 0; k < 60; ++k) (widest(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
    return high;
}

TEST(StaticEquilibrium, ThinnestArch) {
    EXPECT_NEAR(criticalThickness(16), 0.1072372988, 1e-9);
    EXPECT_NEAR(threshold(0.1, 0.115, [](double t) { return arch(16, t); }), 0.1072372988, 2e-6);
    // Finer joints come nearer to Milankovitch's 0.10748 from below.
    const double fine = threshold(0.1, 0.115, [](double t) { return arch(20, t); });
    EXPECT_NEAR(fine, 0.1074601099, 2e-6);
}

TEST(StaticEquilibrium, ArchesOfManyStonesNearTheLimit) {
    for (const int stones : {26, 30, 40, 50}) {
        const double critical = criticalThickness(stones);
        for (const double share : {1.00001, 1.01, 1.05, 1.2})
            EXPECT_TRUE(stands(arch(stones, share * critical))) << stones << " stones, " << share;
        for (const double share : {0.99999, 0.97})
            EXPECT_FALSE(stands(arch(stones, share * critical))) << stones << " stones, " << share;
    }
}

TEST(StaticEquilibrium, LadderAndAFrame) {
    const auto ladder = [](double mu) {
        Scenario s = standing(2, 0);
        s.materials.push_back({"floor", 0.0, 0.0, 1000.0});
        s.materials.push_back({"wall", 0.0, 0.0, 1000.0});
        s.pairs = {{0, 1, mu, 0, 0}, {0, 2, 0.2, 0, 0}};
        addFloor(s);
        addBody(s, "wall", BodyType::Static, HalfSpace{{1, 0, 0}, 0.0}, {});
        s.bodies[0].shapes[0].material = 1;
        s.bodies[1].shapes[0].material = 2;
        // Foot at (L cos, 0), top at (0, L sin); load at the fraction q from the foot.
        const double l = 4, angle = 1.1, q = (5 + 70 * 0.8) / 80;
        const Vec3 foot{l * std::cos(angle), 0, 0}, top{0, l * std::sin(angle), 0};
        addBody(s, "ladder", BodyType::Dynamic, Capsule{1e-12, l / 2}, 0.5 * (foot + top));
        Body& body = s.bodies.back();
        body.pose.orientation = fromAxisAngle({0, 0, 1}, pi / 2 - angle);
        body.massProperties = {80, {0, (q - 0.5) * l, 0}, Mat3::diagonal(1, 1, 100)};
        return s;
    };
    EXPECT_NEAR(threshold(0.3, 0.5, ladder), 0.378927241, 1e-5);
    const auto frame = [](double mu) {
        Scenario s = standing(2, 0);
        s.materials.push_back({"floor", 0.0, 0.0, 1000.0});
        s.pairs = {{0, 0, 0.0, 0, 0}, {0, 1, mu, 0, 0}};
        addFloor(s);
        s.bodies[0].shapes[0].material = 1;
        const double half = 0.5, r = 0.01, beta = 1;
        for (const double side : {-1.0, 1.0}) {
            addBody(s, side < 0 ? "left" : "right", BodyType::Dynamic, Capsule{r, half},
                    {side * (half * std::cos(beta) + r), half * std::sin(beta) + r, 0});
            s.bodies.back().pose.orientation = fromAxisAngle({0, 0, 1}, side * (pi / 2 - beta));
            s.bodies.back().massProperties = {1, {}, Mat3::diagonal(1, 1, 1)};
        }
        return s;
    };
    // The thrust about the foot's contact: W l cos(beta) = H (2 l sin(beta) + r); 1/(2 tan(beta)) without
    // caps.
    const double thrust = 0.5 * std::cos(1.0) / (std::sin(1.0) + 0.01);
    EXPECT_NEAR(thrust, 0.321046308, 0.004);
    EXPECT_NEAR(threshold(0.2, 0.5, frame), thrust, 1e-5);
    const Scenario rough = frame(0.4);
    const auto r = makeReference(rough);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(all, "force_left_right")->exact, 9.81 * thrust, 1e-9);
    EXPECT_NEAR(findQuantity(all, "force_floor_left")->exact, 9.81, 1e-9);
}

TEST(StaticEquilibrium, HarmonicOverhangAndStackForces) {
    const auto stack = [](double stretch) {
        Scenario s = standing(2, 0.5);
        addBody(s, "table", BodyType::Static, Box{{2, 0.5, 0}}, {-2, -0.5, 0});
        // The topmost reaches 1/2 (1 + 1/2 + 1/3 + 1/4) over the edge.
        const double centres[] = {-0.375, -0.2083333333, 0.04166666667, 0.5416666667};
        for (int i = 0; i < 4; ++i) {
            const double shift = centres[i] + 0.5;
            addBox(s, "box" + std::to_string(i), {0.5, 0.1, 0}, 1,
                   {-0.5 + stretch * shift, 0.1 + 0.2 * i, 0});
        }
        return s;
    };
    EXPECT_TRUE(stands(stack(0.999)));
    EXPECT_FALSE(stands(stack(1.001)));
    for (const int dimension : {2, 3}) {
        Scenario s = standing(dimension, 0.5);
        addFloor(s);
        const double masses[] = {1, 1, 1000}, offsets[] = {0, 0.1, 0.2};
        for (int i = 0; i < 3; ++i)
            addBox(s, "box" + std::to_string(i), {0.5, 0.25, 0.5}, masses[i],
                   {offsets[i], 0.25 + 0.5 * i, 0});
        const auto r = makeReference(s);
        const auto all = r->quantities(0.01, Scheme::Unknown);
        EXPECT_NEAR(findQuantity(all, "force_floor_box0")->exact, 9829.62, 2e-5);
        EXPECT_NEAR(findQuantity(all, "force_box0_box1")->exact, 9819.81, 2e-5);
        EXPECT_NEAR(findQuantity(all, "force_box1_box2")->exact, 9810, 2e-5);
        s.bodies[3].pose.position.x = 0.65;
        EXPECT_FALSE(stands(s));
    }
}

TEST(StaticEquilibrium, MeasuresForcesAndMovesFromARun) {
    Scenario s = standing(2, 0.5);
    addFloor(s);
    addBox(s, "box", {0.5, 0.25, 0}, 2, {0, 0.25, 0});
    const auto r = makeReference(s);
    Trajectory run = exactRun(s, *r, 0.01, 40);
    for (auto& contacts : run.contacts)
        for (int i = 0; i < 2; ++i) {
            adapter::ContactPoint c;
            c.bodyB = 1;
            c.hasImpulse = true;
            c.normalImpulse = 0.01 * 9.81;
            contacts.push_back(c);
        }
    const auto all = r->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(all, "force_floor_box")->measure(run).value(), 19.62, 1e-9);
    EXPECT_EQ(findQuantity(all, "moves")->measure(run).value(), 0.0);
    run.states[30 * 2 + 1].position.x = 0.03;
    EXPECT_EQ(findQuantity(all, "moves")->measure(run).value(), 1.0);
}

TEST(StaticEquilibrium, RefusesWhatItDoesNotKnow) {
    Scenario s = standing(2, 0.5);
    addFloor(s);
    addBox(s, "box", {0.5, 0.25, 0}, 2, {0, 0.25, 0});
    s.bodies[1].velocity = {0.1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.bodies[1].velocity = {};
    s.joints.emplace_back();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s.joints.clear();
    s.dimension = 3;
    s.bodies[1].shapes[0].geometry = Cylinder{0.1, 0.25};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

}  // namespace
}  // namespace rigor::validation::testing
