// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Laws of impact, coefficients of pairs, and the report of a step on its solver.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/solvers/natural_map.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Impacts : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Impacts, Spaces);

TYPED_TEST(Impacts, LawsAgreeWithoutFrictionAndOffMeansOff) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double e : {0.0, 0.5, 1.0}) {
        for (const char* law : {"newton", "poisson", "none"}) {
            WorldDef<S> def = earthByEuler<S>();
            def.restitution = law;
            World<S> world(def);
            const std::uint32_t m = world.addMaterial(0, static_cast<R>(e));
            addGround<S>(world, m);
            const BodyId ball = addBall<S>(world, 0, 0.7, 0.5, 3, m);
            double before = 0, after = 0;
            for (int i = 0; i < 200 && after <= before + 0.2; ++i) {
                before = world.velocity(ball)[1];
                world.step(R(1.0 / 240));
                after = world.velocity(ball)[1];
            }
            const double kept = std::string(law) == "none" ? 0 : e;
            // If there is no bounce, the contact may close the gap in the step of the impact.
            EXPECT_NEAR(after, -kept * before, kept > 0 ? tol<S>(1e-13, 1e-5) : 0.25) << law << e;
        }
        // Two spheres, one dimension.
        for (const char* law : {"newton", "poisson"}) {
            WorldDef<S> def = euler<S>();
            def.restitution = law;
            World<S> world(def);
            const std::uint32_t m = world.addMaterial(R(0.4), static_cast<R>(e));
            const BodyId a = addBall<S>(world, -0.5, 0, 0.2, 1, m, 2);
            const BodyId b = addBall<S>(world, 0.5, 0, 0.3, 3, m, -1);
            for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
            const double v1 = (1 * 2.0 + 3 * -1.0 - 3 * e * 3.0) / 4;
            EXPECT_NEAR(world.velocity(a)[0], v1, tol<S>(1e-12, 1e-5)) << law << e;
            EXPECT_NEAR(world.velocity(b)[0], v1 + e * 3, tol<S>(1e-12, 1e-5)) << law << e;
        }
    }
}

/// Approaches on both sides of the threshold, near it: slower ones stop, faster ones bounce by the whole
/// coefficient.
TYPED_TEST(Impacts, BounceAboveTheThresholdAndNotBelow) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* law : {"newton", "poisson"})
        for (const double share : {0.5, 0.95, 1.05, 1.5, 1.95, 3.0}) {
            WorldDef<S> def;  // no gravity
            def.restitution = law;
            def.restitutionThreshold = R(0.4);
            World<S> world(def);
            const std::uint32_t m = world.addMaterial(0, R(0.5));
            addGround<S>(world, m);
            const BodyId ball = addBall<S>(world, 0, 0.5, 0.5, 3, m, 0, -0.4 * share);
            for (int i = 0; i < 3; ++i) world.step(R(1.0 / 240));
            EXPECT_NEAR(world.velocity(ball)[1], share > 1 ? 0.2 * share : 0, tol<S>(1e-12, 1e-5))
                << law << " " << share;
        }
}

/// A body that hits the ground with one point, at r from its centre of mass; mass 1, inertia I about z.
struct Oblique {
    double rx, ry, I, mu, e, vx, vy, w;
};
struct Plane {
    double t, n;
};
/// Coulomb's law with impulse on at least `floor` on the normal and w_n >= target: P of [w = W P + b].
Plane contactByCases(const Oblique& o, Plane b, double atLeast, double target) {
    const double Wnn = 1 + o.rx * o.rx / o.I, Wtt = 1 + o.ry * o.ry / o.I, Wnt = -o.rx * o.ry / o.I;
    std::vector<Plane> found;
    const auto consider = [&](Plane P) {
        const double un = Wnn * P.n + Wnt * P.t + b.n, ut = Wtt * P.t + Wnt * P.n + b.t;
        const bool normal = (std::abs(P.n - atLeast) < 1e-12 && un >= target - 1e-12) ||
                            (P.n >= atLeast && std::abs(un - target) < 1e-12);
        const double limit = o.mu * P.n;
        const bool tangent = (std::abs(P.t) <= limit + 1e-12 && std::abs(ut) < 1e-12) ||
                             (std::abs(P.t + limit) < 1e-12 && ut >= -1e-12) ||
                             (std::abs(P.t - limit) < 1e-12 && ut <= 1e-12);
        if (normal && tangent) found.push_back(P);
    };
    for (const double s : {-1.0, 1.0}) {
        consider({s * o.mu * atLeast, atLeast});
        const double n = (target - b.n) / (Wnn + s * o.mu * Wnt);
        consider({s * o.mu * n, n});
    }
    consider({-(Wnt * atLeast + b.t) / Wtt, atLeast});
    const double det = Wnn * Wtt - Wnt * Wnt;
    consider({(-Wnn * b.t - Wnt * (target - b.n)) / det, (Wtt * (target - b.n) + Wnt * b.t) / det});
    EXPECT_FALSE(found.empty());
    return found.empty() ? Plane{0, 0} : found[0];
}
Plane contactVelocity(const Oblique& o) {
    return {o.vx - o.w * o.ry, o.vy + o.w * o.rx};
}
Plane impulseOf(const Oblique& o, bool poisson) {
    const Plane u = contactVelocity(o);
    if (!poisson) return contactByCases(o, u, 0, -o.e * u.n);
    const Plane c = contactByCases(o, u, 0, 0);
    const double Wnn = 1 + o.rx * o.rx / o.I, Wtt = 1 + o.ry * o.ry / o.I, Wnt = -o.rx * o.ry / o.I;
    const Plane after{u.t + Wtt * c.t + Wnt * c.n, u.n + Wnn * c.n + Wnt * c.t};
    const Plane x = contactByCases(o, after, o.e * c.n, 0);
    return {c.t + x.t, c.n + x.n};
}
double energyAfter(const Oblique& o, Plane P) {
    const double vx = o.vx + P.t, vy = o.vy + P.n, w = o.w + (o.rx * P.n - o.ry * P.t) / o.I;
    return 0.5 * (vx * vx + vy * vy + o.I * w * w);
}
std::vector<Oblique> obliqueImpacts() {
    std::vector<Oblique> all;
    for (const double angle : {0.3, 0.8, 1.2})
        for (const double mu : {0.1, 0.4, 0.9})
            for (const double e : {0.3, 0.8, 1.0})
                for (const double vx : {-1.0, 0.2, 1.5})
                    all.push_back(
                        {0.5 * std::cos(angle), -0.5 * std::sin(angle), 1.0 / 12, mu, e, vx, -1.0, 0});
    return all;
}

/// Returns the kinetic energy after the impact.
template <class S>
double obliqueWorld(const Oblique& o, const char* law, double out[3]) {
    using R = typename S::Real;
    WorldDef<S> def;
    def.restitution = law;
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(static_cast<R>(o.mu), static_cast<R>(o.e));
    addGround<S>(world, m);
    // A small sphere at the end of a rod: the contact is below its centre, in the body frame's origin.
    const double radius = 0.05;
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = isotropic<S>(o.I);
    body.centerOfMass = at<S>(-o.rx, -o.ry - radius);
    body.pose.p = at<S>(0, radius - 1e-6);
    body.velocity = at<S>(o.vx, o.vy);
    body.angularVelocity = spin<S>(o.w);
    const BodyId id = world.addBody(body);
    attach<S>(world, id, Sphere<S>{static_cast<R>(radius)}, m);
    world.step(R(1e-4));
    out[0] = world.velocity(id)[0];
    out[1] = world.velocity(id)[1];
    out[2] = spinOf<S>(world.angularVelocity(id));
    return 0.5 * (out[0] * out[0] + out[1] * out[1] + o.I * out[2] * out[2]);
}

TYPED_TEST(Impacts, ObliqueImpactsFollowTheLawsInClosedForm) {
    using S = TypeParam;
    double mostByNewton = 0, largestDifference = 0;
    for (const Oblique& o : obliqueImpacts()) {
        const double before = energyAfter(o, {0, 0});
        for (const bool poisson : {false, true}) {
            double v[3];
            const double energy = obliqueWorld<S>(o, poisson ? "poisson" : "newton", v);
            const Plane P = impulseOf(o, poisson);
            const double size = 1 + std::abs(P.n);
            EXPECT_NEAR(v[0], o.vx + P.t, tol<S>(1e-5, 1e-3) * size) << o.mu << o.e << o.vx << poisson;
            EXPECT_NEAR(v[1], o.vy + P.n, tol<S>(1e-5, 1e-3) * size) << o.mu << o.e << o.vx << poisson;
            EXPECT_NEAR(v[2], o.w + (o.rx * P.n - o.ry * P.t) / o.I, tol<S>(1e-4, 1e-2) * size);
            if (poisson) {
                EXPECT_LE(energy, before * (1 + tol<S>(1e-5, 1e-3))) << o.mu << " " << o.e << " " << o.vx;
            } else {
                mostByNewton = std::max(mostByNewton, energy / before);
            }
        }
        largestDifference =
            std::max(largestDifference, std::abs(impulseOf(o, true).n - impulseOf(o, false).n));
    }
    EXPECT_GT(mostByNewton, 1.01) << "the known defect of Newton's law with friction";
    EXPECT_GT(largestDifference, 0.1) << "else these impacts do not distinguish the laws";
}

TYPED_TEST(Impacts, RestingBodiesDoNotBounceUnderPoisson) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.restitution = "poisson";
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(R(0.5), R(0.9));
    addGround<S>(world, m);
    const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, m);
    for (int i = 0; i < 240; ++i) world.step(R(1.0 / 240));
    EXPECT_LT(world.velocity(box).norm(), 1e-4);
    EXPECT_NEAR(world.pose(box).p[1], 0.25, 1e-4);
}

TYPED_TEST(Impacts, CombineRulesMakeThePairUnlessItIsNamed) {
    using S = TypeParam;
    using R = typename S::Real;
    const double a = 0.2, b = 0.8;
    const std::pair<const char*, double> rules[] = {
        {"average", 0.5}, {"geometric_mean", 0.4}, {"max", 0.8}, {"min", 0.2}, {"multiply", 0.16}};
    for (const auto& [rule, expected] : rules) {
        WorldDef<S> def;
        def.frictionCombine = def.restitutionCombine = rule;
        World<S> world(def);
        const std::uint32_t ma = world.addMaterial(R(a), R(a)), mb = world.addMaterial(R(b), R(b), R(1.2));
        EXPECT_NEAR(world.pairCoefficients(ma, mb).friction, expected, 1e-6) << rule;
        EXPECT_NEAR(world.pairCoefficients(mb, ma).restitution, expected, 1e-6) << rule;
        EXPECT_GE(world.pairCoefficients(ma, mb).staticFriction, world.pairCoefficients(ma, mb).friction);
        world.setPair(ma, mb, {R(0.33), R(0.1), R(0)});
        EXPECT_EQ(world.pairCoefficients(ma, mb).friction, R(0.33));
    }
    WorldDef<S> def;
    def.frictionCombine = "no_such";
    EXPECT_THROW(World<S>{def}, EngineError);
    World<S> world{WorldDef<S>{}};
    EXPECT_THROW(world.addMaterial(R(0.5), 0, R(0.4)), EngineError);
}

/// A block on a slope between the two coefficients: at rest it stays, pushed it goes on with the kinetic one.
TYPED_TEST(Impacts, StaticFrictionHoldsWhatKineticFrictionWouldNot) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double push : {0.0, 0.5}) {
        WorldDef<S> def;
        const double angle = 0.35;  // tan = 0.365
        def.gravity[0] = static_cast<R>(kGravity * std::sin(angle));
        def.gravity[1] = static_cast<R>(-kGravity * std::cos(angle));
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.2), 0, R(0.5));
        addGround<S>(world, m);
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, m, push);
        for (int i = 0; i < 120; ++i) world.step(R(1.0 / 240));
        const double a = kGravity * (std::sin(angle) - 0.2 * std::cos(angle));
        EXPECT_NEAR(world.velocity(box)[0], push > 0 ? push + a * 0.5 : 0, 2e-3) << push;
    }
}

TYPED_TEST(Impacts, MeasuredResidualIsTheNaturalMapAndObserversSeeEveryIteration) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* solver : {"nsgs", "dantzig", "lemke"}) {
        WorldDef<S> def = earth<S>();
        def.solver = solver;
        def.measureResiduals = true;
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.5), 0);
        addGround<S>(world, m);
        for (int i = 0; i < 3; ++i) addCube<S>(world, 0.02 * i, 0.25 + 0.5 * i, 0.25, 1, m);
        int seen = 0;
        R last = -1, recomputed = -1;
        world.observeIterations([&](int iteration, const ConstraintRows<S>& rows, R residual) {
            EXPECT_EQ(iteration, seen++);
            last = residual;
            R sum = 0;
            for (const Block<S>& block : rows.blocks) sum += rows.rows[block.first].impulse;
            recomputed = sum;
        });
        for (int i = 0; i < 3; ++i) {
            seen = 0;
            world.step(R(1.0 / 60));
        }
        EXPECT_EQ(world.lastStep().measure, ResidualMeasure::NaturalMap);
        EXPECT_EQ(seen, world.lastStep().iterations) << solver;
        EXPECT_EQ(last, world.lastStep().residuals.back());
        EXPECT_LT(last, tol<S>(1e-10, 1e-4)) << solver;
        EXPECT_FALSE(world.lastStep().solverGaveUp) << solver;
        EXPECT_NEAR(recomputed, (1 + 2 + 3) * kGravity / 60, tol<S>(2e-3, 2e-3))
            << "normals carry the weight";
    }
}

}  // namespace
}  // namespace rigor::engine::test
