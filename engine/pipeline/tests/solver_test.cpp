// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every solver and every position correction of the tables on the same scenes: what all must do, what the
// weaker ones are known not to do, and that no two of them are the same.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "engine/core/tests/counting_new.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Solvers : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Solvers, Spaces);

/// Known properties of a solver; a solver that is not named here does everything.
struct Traits {
    const char* name;
    bool solves = true;     ///< coupled contacts: stacks stand, boxes stick to slopes
    double sinks = 1e-3;    ///< sinking of the top of a stack of five, at most [m]
    double drifts = 1e-3;   ///< sideways in five seconds, at most [m]
    double slips = 1e-4;    ///< error of the speed of a sliding box, two seconds after its start [m/s]
    double swings = 0.2;    ///< change of a pendulum's energy in ten seconds [J], of 9.81/2 J
    double turns = 1e-12;   ///< angular momentum that an impact changes [kg m^2/s]
    bool iterates = false;  ///< iterates to a solution, warm started, as pgs does
};
Traits traitsOf(const std::string& name) {
    static const Traits known[] = {
        {.name = "block", .iterates = true},
        {.name = "jacobi", .iterates = true},
        {.name = "pgs", .iterates = true},
        // Springs at a quarter of the step rate: load is carried by overlap.
        {.name = "pgs_soft", .sinks = 0.04, .slips = 1e-3, .swings = 1.0, .iterates = true},
        {.name = "single_pass", .solves = false, .swings = 5},
        // One iteration per sub-step: the sliding box loses a part of a sub-step's friction where it starts.
        {.name = "tgs_soft", .sinks = 0.01, .slips = 0.01, .turns = 1e-5},
        {.name = "wide", .sinks = 0.01, .slips = 0.01, .turns = 1e-4},
        // Positions linearised along the end of each sub-step, hence the damped swing; stacks rock on.
        {.name = "xpbd", .drifts = 0.05, .slips = 0.01, .swings = 1.0, .turns = 1e-4},
    };
    for (const Traits& traits : known)
        if (name == traits.name) return traits;
    return {.name = ""};
}

template <class S>
WorldDef<S> earthWith(const char* solver, const std::string& correction = WorldDef<S>().positionCorrection) {
    WorldDef<S> def = earth<S>();
    def.solver = solver;
    def.positionCorrection = correction;
    return def;
}

TYPED_TEST(Solvers, ImpactReboundsByTheCoefficientAndKeepsMomentum) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        WorldDef<S> def;
        def.solver = solver.name;
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.4), R(0.5));
        const BodyId a = addBall<S>(world, -0.5, 0, 0.2, 1, m, 2),
                     b = addBall<S>(world, 0.5, 0, 0.3, 3, m, -1);
        for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
        const double u = 2 + 1, mean = (2.0 - 3.0) / 4;
        EXPECT_NEAR(world.velocity(a)[0], mean - 0.75 * 0.5 * u, tol<S>(1e-12, 1e-5)) << solver.name;
        EXPECT_NEAR(world.velocity(b)[0], mean + 0.25 * 0.5 * u, tol<S>(1e-12, 1e-5)) << solver.name;
    }
}

TYPED_TEST(Solvers, ObliqueImpactKeepsLinearAndAngularMomentum) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        WorldDef<S> def;
        def.solver = solver.name;
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.6), R(0.8));
        const BodyId a = addBall<S>(world, -0.6, 0.15, 0.2, 1, m, 2, 0, 5);
        const BodyId b = addCube<S>(world, 0.3, 0, 0.25, 2, m, -1);
        const auto momentum = [&] {
            std::array<double, 3> sum{};
            for (const BodyId id : {a, b}) {
                const double mass = world.constants(id).mass;
                const typename S::Vec p = world.pose(id).p, v = world.velocity(id);
                const double I = id == a ? 0.4 * 1 * 0.04 : 2.0 / 3 * 2 * 0.0625;
                sum[0] += mass * v[0];
                sum[1] += mass * v[1];
                sum[2] += mass * (p[0] * v[1] - p[1] * v[0]) + I * spinOf<S>(world.angularVelocity(id));
            }
            return sum;
        };
        const auto before = momentum();
        for (int i = 0; i < 120; ++i) world.step(R(1.0 / 60));
        const auto after = momentum();
        EXPECT_LT(spinOf<S>(world.angularVelocity(b)), -4) << solver.name << ": they did collide";
        EXPECT_NEAR(after[0], before[0], tol<S>(1e-12, 2e-5)) << solver.name;
        EXPECT_NEAR(after[1], before[1], tol<S>(1e-12, 2e-5)) << solver.name;
        EXPECT_NEAR(after[2], before[2], std::max(tol<S>(0, 2e-5), traitsOf(solver.name).turns))
            << solver.name;
    }
}

TYPED_TEST(Solvers, BoxOnAnInclineSticksAboveTheThresholdAndSlidesBelow) {
    using S = TypeParam;
    using R = typename S::Real;
    const double alpha = 0.5;
    for (const auto& solver : solverTable<S>())
        for (const double excess : {-0.02, 0.02}) {
            WorldDef<S> def = earthWith<S>(solver.name);
            def.gravity = at<S>(kGravity * std::sin(alpha), -kGravity * std::cos(alpha));
            World<S> world(def);
            const double mu = std::tan(alpha) + excess;
            const std::uint32_t m = world.addMaterial(static_cast<R>(mu), 0);
            addGround<S>(world, m);
            const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, m);
            for (int i = 0; i < 120; ++i) world.step(R(1.0 / 60));
            const double v = 2 * std::max(0.0, kGravity * (std::sin(alpha) - mu * std::cos(alpha)));
            const Traits traits = traitsOf(solver.name);
            const double error = std::abs(static_cast<double>(world.velocity(box)[0]) - v);
            if (traits.solves)
                EXPECT_LT(error, std::max(traits.slips, tol<S>(0, 2e-3))) << solver.name << ", v " << v;
            else
                EXPECT_GT(error, 0.01) << solver.name << " has learnt: say so in its traits";
        }
}

/// Motion of the top box of a stack of n.
struct Stood {
    double sunk = 0, drifted = 0;
};
template <class S>
Stood stackOf(const WorldDef<S>& def, int n, int steps) {
    using R = typename S::Real;
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(R(0.5), 0);
    addGround<S>(world, m);
    BodyId top;
    for (int i = 0; i < n; ++i) top = addCube<S>(world, 0, 0.5 + i, 0.5, 1, m);
    for (int i = 0; i < steps; ++i) world.step(R(1.0 / 60));
    typename S::Vec away = world.pose(top).p;
    away[1] = 0;
    return {n - 0.5 - static_cast<double>(world.pose(top).p[1]), static_cast<double>(away.norm())};
}

TYPED_TEST(Solvers, StackOfFiveStandsOrFallsAsItIsKnownTo) {
    using S = TypeParam;
    for (const auto& solver : solverTable<S>()) {
        const Traits traits = traitsOf(solver.name);
        const Stood stood = stackOf(earthWith<S>(solver.name), 5, 300);
        if (traits.solves) {
            EXPECT_LT(std::abs(stood.sunk), std::max(traits.sinks, 2e-3)) << solver.name;
            EXPECT_LT(stood.drifted, std::max(traits.drifts, tol<S>(0, 5e-3))) << solver.name;
        } else {
            EXPECT_GT(stood.sunk, 0.05) << solver.name << " has learnt: say so in its traits";
        }
    }
}

TYPED_TEST(Solvers, CorrectionsKeepAStackInPlace) {
    using S = TypeParam;
    for (const auto& correction : positionCorrectionTable<S>()) {
        WorldDef<S> def = earthWith<S>("pgs", correction.name);
        def.integrator = "symplectic_euler";
        const Stood stood = stackOf(def, 5, 300);
        const bool soft = std::strcmp(correction.name, "soft") == 0;
        EXPECT_LT(std::abs(stood.sunk), soft ? 0.04 : 2e-3) << correction.name;
        EXPECT_LT(stood.drifted, 5e-3) << correction.name;
    }
}

/// A box let into the ground by 1 cm: where it is, and how fast, after each step.
TYPED_TEST(Solvers, CorrectionsLiftABoxOutAndOnlyBaumgarteThrowsIt) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto fastest = [](const char* solver, const char* correction, double& left) {
        World<S> world(earthWith<S>(solver, correction));
        const std::uint32_t m = world.addMaterial(R(0.5), 0);
        addGround<S>(world, m);
        const BodyId box = addCube<S>(world, 0, 0.49, 0.5, 1, m);
        double v = 0;
        for (int i = 0; i < 60; ++i) {
            world.step(R(1.0 / 60));
            v = std::max(v, static_cast<double>(world.velocity(box)[1]));
        }
        left = 0.5 - static_cast<double>(world.pose(box).p[1]);
        return v;
    };
    double left = 0;
    EXPECT_LT(fastest("block", "none", left), 1e-4);
    EXPECT_NEAR(left, 0.01, 1e-4);
    for (const char* correction : {"ngs", "split_impulse", "soft"}) {
        EXPECT_LT(fastest("block", correction, left), 1e-3) << correction;
        EXPECT_LT(std::abs(left), 2.5e-3) << correction;
    }
    EXPECT_GT(fastest("block", "baumgarte", left), 0.05);
    EXPECT_LT(std::abs(left), 1e-3);
    EXPECT_GT(fastest("pgs_soft", "none", left), 0.02) << "no relaxation: the push stays";
    EXPECT_LT(std::abs(left), 5e-3);
    EXPECT_LT(fastest("tgs_soft", "none", left), 0.02) << "relaxed, by one iteration";
    EXPECT_LT(std::abs(left), 1e-3);
    EXPECT_LT(fastest("xpbd", "none", left), 1e-3) << "the velocity pass takes it out";
    EXPECT_LT(std::abs(left), 1e-4);
}

TYPED_TEST(Solvers, PendulumKeepsItsJointAndItsEnergy) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        World<S> world(earthWith<S>(solver.name));
        BodyDef<S> body;
        body.pose.p = at<S>(0.5, 0);
        body.mass = 1;
        body.inertia = isotropic<S>(1.0 / 12);
        const BodyId rod = world.addBody(body);
        JointDef<S> j;
        j.type = JointType::Hinge;
        j.bodyB = rod;
        j.anchorB = at<S>(-0.5, 0);
        world.addJoint(j);
        double gap = 0, energy = 0;
        for (int i = 0; i < 600; ++i) {
            world.step(R(1.0 / 60));
            gap = std::max(gap, static_cast<double>(toWorld<S>(world.pose(rod), at<S>(-0.5, 0)).norm()));
            const auto w = world.angularVelocity(rod);
            const double E =
                0.5 * world.velocity(rod).squaredNorm() + dotAng(w, w) / 24 + kGravity * world.pose(rod).p[1];
            energy = std::max(energy, std::abs(E));
        }
        EXPECT_LT(energy, traitsOf(solver.name).swings) << solver.name;
        EXPECT_LT(gap, 6e-3) << solver.name;
    }
}

/// A tower with a swinging sphere: contacts, a joint, impacts, friction.
template <class S>
World<S> busyWorld(const WorldDef<S>& def) {
    World<S> world(def);
    const std::uint32_t m = world.addMaterial(typename S::Real(0.5), typename S::Real(0.3));
    addGround<S>(world, m);
    for (int i = 0; i < 4; ++i) addCube<S>(world, 0.05 * i, 0.55 + 1.02 * i, 0.5, 1, m);
    JointDef<S> j;
    j.bodyB = addBall<S>(world, -3, 2, 0.4, 2, m, 4);
    j.anchorA = at<S>(-2, 3.5);
    j.anchorB = at<S>(1, 1.5);
    world.addJoint(j);
    return world;
}

TYPED_TEST(Solvers, EveryoneIsDeterministicAndNoTwoAreTheSame) {
    using S = TypeParam;
    using R = typename S::Real;
    std::set<std::uint64_t> seen;
    std::size_t choices = 0;
    const auto run = [&](WorldDef<S> def, const std::string& name) {
        def.islandContacts = 2;
        World<S> world = busyWorld<S>(def), same = busyWorld<S>(def);
        for (int i = 0; i < 60; ++i) {
            world.step(R(1.0 / 60));
            same.step(R(1.0 / 60));
        }
        World<S> copy = world;
        for (int i = 0; i < 30; ++i) {
            ASSERT_FALSE(world.step(R(1.0 / 60)).nonFinite) << name;
            same.step(R(1.0 / 60));
            copy.step(R(1.0 / 60));
        }
        EXPECT_EQ(world.stateHash(), same.stateHash()) << name;
        EXPECT_EQ(world.stateHash(), copy.stateHash()) << name;
        EXPECT_TRUE(seen.insert(world.stateHash()).second) << name << " gives the bits of another";
        ++choices;
    };
    for (const auto& solver : solverTable<S>()) run(earthWith<S>(solver.name), solver.name);
    for (const auto& correction : positionCorrectionTable<S>())
        if (earth<S>().positionCorrection != correction.name)
            run(earthWith<S>(earth<S>().solver.c_str(), correction.name), correction.name);
    EXPECT_GE(choices, 11u);
}

TYPED_TEST(Solvers, SteadyStepDoesNotAllocate) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        WorldDef<S> def = earthWith<S>(solver.name);
        def.islandContacts = 2;
        World<S> world = busyWorld<S>(def);
        for (int i = 0; i < 400; ++i) world.step(R(1.0 / 60));
        const long before = allocationCount();
        for (int i = 0; i < 20; ++i) world.step(R(1.0 / 60));
        EXPECT_EQ(allocationCount() - before, 0) << solver.name;
        EXPECT_GT(world.lastStep().contacts, 0u) << solver.name;
    }
}

/// A pendulum that rests against a tower after some hits: rounds that do not converge leave the nearest impulses, which
/// give nothing more speed than the pendulum has. The last ones gave a cube 20 and 33 m/s in two of these worlds.
TEST(DirectSolvers, RoundsThatDoNotConvergeLaunchNothing) {
    using S = Space2d;
    for (const char* solver : {"lemke", "dantzig"})
        for (int k = 0; k < 4; ++k) {
            WorldDef<S> def = earthWith<S>(solver);
            def.islandContacts = 2;
            World<S> world = busyWorld<S>(def);
            const BodyId ball = world.bodies().back();
            world.setVelocity(ball, at<S>(4 + 1e-9 * k, 0), 0);
            double fastest = 0;
            for (int i = 0; i < 420; ++i) {
                world.step(1.0 / 60);
                for (const BodyId id : world.bodies()) fastest = std::max(fastest, world.velocity(id).norm());
            }
            EXPECT_LT(fastest, 4.5) << solver << ' ' << k;
        }
}

/// A chain of spheres that hangs from a joint and carries no redundant row, hit by one more: one solution.
TYPED_TEST(Solvers, ConvergedSolversAgree) {
    using S = TypeParam;
    using R = typename S::Real;
    std::vector<typename S::Vec> answers;
    std::vector<std::string> names;
    for (const auto& solver : solverTable<S>()) {
        const Traits traits = traitsOf(solver.name);
        if (!traits.iterates || std::strcmp(solver.name, "pgs_soft") == 0) continue;
        WorldDef<S> def = earthWith<S>(solver.name);
        def.velocityIterations = 20000;
        def.velocityTolerance = sizeof(R) == 8 ? R(1e-11) : R(1e-5);
        World<S> world(def);
        const std::uint32_t m = world.addMaterial(R(0.4), 0);
        addGround<S>(world, m);
        BodyId last;
        for (int i = 0; i < 3; ++i) {
            const BodyId next = addBall<S>(world, 0.4 * (i + 1), 1, 0.15, 1 + i, m);
            JointDef<S> j;
            j.bodyA = last;
            j.bodyB = next;
            j.anchorA = i == 0 ? at<S>(0, 1) : at<S>(0, 0);
            j.anchorB = at<S>(-0.4, 0);
            world.addJoint(j);
            last = next;
        }
        const BodyId loose = addBall<S>(world, 1.21, 1.35, 0.2, 2, m, -0.3);
        for (int i = 0; i < 20; ++i) world.step(R(1.0 / 60));
        answers.push_back(world.velocity(last));
        answers.push_back(world.velocity(loose));
        names.push_back(solver.name);
    }
    ASSERT_GE(names.size(), 3u);
    for (std::size_t i = 1; i < names.size(); ++i) {
        EXPECT_LT((answers[2 * i] - answers[0]).norm(), tol<S>(1e-7, 1e-2)) << names[i];
        EXPECT_LT((answers[2 * i + 1] - answers[1]).norm(), tol<S>(1e-7, 1e-2)) << names[i];
    }
}

TYPED_TEST(Solvers, ResidualsFallAndWarmStartingHelps) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& solver : solverTable<S>()) {
        if (!traitsOf(solver.name).iterates) continue;
        const auto residuals = [&](bool warm, int steps) {
            WorldDef<S> def = earthWith<S>(solver.name);
            def.warmStarting = warm;
            def.velocityTolerance = 0;
            def.velocityIterations = 10;
            def.firstStepIterations = 100;
            World<S> world(def);
            const std::uint32_t m = world.addMaterial(R(0.5), 0);
            addGround<S>(world, m);
            for (int i = 0; i < 4; ++i) addCube<S>(world, 0, 0.5 + i, 0.5, 1, m);
            for (int i = 0; i < steps; ++i) world.step(R(1.0 / 60));
            const auto all = world.lastStep().residuals;
            return std::vector<double>(all.begin(), all.end());
        };
        const std::vector<double> first = residuals(true, 1);
        ASSERT_EQ(first.size(), 100u) << solver.name;
        EXPECT_NEAR(first.front(), kGravity / 60, 0.6 * kGravity / 60) << "the fall of a step is the error";
        for (std::size_t i = 20; i < first.size(); ++i)
            EXPECT_LT(first[i], 1.2 * first[i - 20] + tol<S>(1e-14, 1e-6)) << solver.name << " " << i;
        EXPECT_LT(first.back(), 0.05 * first.front()) << solver.name;
        const double warm = residuals(true, 20).back(), cold = residuals(false, 20).back();
        EXPECT_LT(warm, 0.2 * cold) << solver.name;
    }
}

}  // namespace
}  // namespace rigor::engine::test
