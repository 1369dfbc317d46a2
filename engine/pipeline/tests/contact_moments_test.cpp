// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rolling and torsional friction, and surfaces that move over their bodies, against closed forms, for every solver
// that has them, in both dimensions and precisions.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"
#include "engine/solvers/traits.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Moments : public testing::Test {};
template <class S>
class Moments3d : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
using Solids = testing::Types<Space3f, Space3d>;
TYPED_TEST_SUITE(Moments, Spaces);
TYPED_TEST_SUITE(Moments3d, Solids);

constexpr double kStep = 1.0 / 120;

/// All solvers, `fast` for wide with its own settings.
std::vector<std::string> solvers() {
    std::vector<std::string> names{"fast"};
    for (const auto& entry : solverTraitsTable()) names.emplace_back(entry.name);
    return names;
}
template <class S>
WorldDef<S> worldWith(const std::string& solver) {
    WorldDef<S> def = earth<S>();
    if (solver == "fast")
        preferSpeed(def);
    else
        def.solver = solver;
    return def;
}
/// Rounding, and what springs of contacts and few iterations leave. `single_pass` solves friction before the moment, which
/// friction answers in the next step: it is behind by one step.
template <class S>
double tolerance(const std::string& solver) {
    if (solver == "single_pass") return 0.01;
    const SolverTraits& traits = solverTraits(solver == "fast" ? "wide" : solver);
    const bool exact = traits.errors == ErrorHandling::Correction && std::is_same_v<typename S::Real, double>;
    return exact ? 1e-5 : 4e-3;
}

template <class S>
struct Roller {
    using R = typename S::Real;
    World<S> world;
    ShapeId ground;
    BodyId ball;
    static constexpr double mass = 3, radius = 0.2, inertia = 0.05;

    Roller(const WorldDef<S>& def, const PairCoefficients<S>& pair, const Velocity<S>& surface = {})
        : world(def) {
        const std::uint32_t material = world.addMaterial(pair);
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        const HalfSpace<S> half{S::Vec::Unit(1), 0};
        ShapeDef<S> floor{half, {}, material, surface};
        ground = world.addShape(world.addBody(fixed), floor);
        BodyDef<S> body;
        body.pose.p = at<S>(0, radius);
        body.mass = R(mass);
        if constexpr (S::dim == 2)
            body.inertia = R(inertia);
        else
            body.inertia = S::Inertia::Identity() * R(inertia);
        ball = world.addBody(body);
        world.addShape(ball, {Sphere<S>{R(radius)}, {}, material});
    }
    void roll(double speed) { world.setVelocity(ball, at<S>(speed, 0), spin<S>(-speed / radius)); }
    void run(double seconds) {
        for (int i = 0; i < std::lround(seconds / kStep); ++i) world.step(R(kStep));
    }
    double speed() const { return static_cast<double>(world.velocity(ball)[0]); }
    double turning() const { return spinOf<S>(world.angularVelocity(ball)); }
};

template <class S>
PairCoefficients<S> pairOf(double mu, double rolling, double torsional = 0) {
    using R = typename S::Real;
    return {R(mu), R(0), R(0), R(rolling), R(torsional)};
}

/// (m + I/r^2) v' = -rho N / r.
TYPED_TEST(Moments, ARollingBallSlowsDownAndStops) {
    using S = TypeParam;
    using B = Roller<S>;
    const double rho = 0.011;
    const double a = rho * B::mass * kGravity / B::radius / (B::mass + B::inertia / (B::radius * B::radius));
    for (const std::string& solver : solvers()) {
        Roller<S> roller(worldWith<S>(solver), pairOf<S>(0.5, rho));
        roller.roll(1);
        roller.run(1);
        EXPECT_NEAR(roller.speed(), 1 - a, tolerance<S>(solver)) << solver;
        EXPECT_NEAR(roller.turning(), -(1 - a) / B::radius, 5 * tolerance<S>(solver)) << solver;
        roller.run(1 / a - 1 + 0.5);
        EXPECT_NEAR(roller.speed(), 0, 1e-3 * tolerance<S>(solver) + 1e-6) << solver;
        EXPECT_NEAR(static_cast<double>(roller.world.pose(roller.ball).p[0]), 1 / (2 * a),
                    2 * kStep + 2 * tolerance<S>(solver))
            << solver;
    }
}

TYPED_TEST(Moments, ABallOnASlopeStartsToRollWhereItsTangentIsRhoOverRadius) {
    using S = TypeParam;
    for (const std::string& solver : solvers())
        for (const double over : {0.9, 1.1}) {
            WorldDef<S> def = worldWith<S>(solver);
            def.gravity = at<S>(over * 0.05 * kGravity, -kGravity);
            Roller<S> roller(def, pairOf<S>(0.5, 0.05 * Roller<S>::radius));
            roller.run(1);
            using B = Roller<S>;
            const double k = B::inertia / (B::mass * B::radius * B::radius);
            const double a = std::max(0.0, (over - 1) * 0.05 * kGravity / (1 + k));
            EXPECT_NEAR(roller.speed(), a, tolerance<S>(solver)) << solver << " " << over;
        }
}

TYPED_TEST(Moments3d, ASpinningBallStopsByTorsionalFrictionAlone) {
    using S = TypeParam;
    using R = typename S::Real;
    using B = Roller<S>;
    const double rho = 0.004, braking = rho * B::mass * kGravity / B::inertia;
    for (const std::string& solver : solvers()) {
        Roller<S> roller(worldWith<S>(solver), pairOf<S>(0.5, 0, rho));
        roller.world.setVelocity(roller.ball, S::Vec::Zero(), typename S::Ang(R(0), R(3), R(0)));
        roller.run(0.5);
        EXPECT_NEAR(static_cast<double>(roller.world.angularVelocity(roller.ball)[1]), 3 - 0.5 * braking,
                    5 * tolerance<S>(solver))
            << solver;
        roller.run(1.5);
        EXPECT_NEAR(static_cast<double>(roller.world.angularVelocity(roller.ball)[1]), 0, 1e-5) << solver;
    }
}

/// A belt pulls the ball along: slip to rolling takes k/(1+k) of the belt's speed.
TYPED_TEST(Moments, ABallOnABeltRollsAgainstIt) {
    using S = TypeParam;
    using B = Roller<S>;
    const double k = B::inertia / (B::mass * B::radius * B::radius), belt = 1.3;
    for (const auto& entry : solverTraitsTable()) {
        Roller<S> roller(worldWith<S>(std::string(entry.name)), pairOf<S>(0.4, 0),
                         {at<S>(belt, 0), zeroAng<S>()});
        roller.run(1.5);
        const double close = entry.traits.warmStarts ? tolerance<S>(std::string(entry.name)) : 0.02;
        EXPECT_NEAR(roller.speed(), k / (1 + k) * belt, close) << entry.name;
    }
}

TYPED_TEST(Moments, ABoxOnABeltSlidesAndThenRidesAndStopsWithTheBelt) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : solverTraitsTable()) {
        const std::string solver(entry.name);
        World<S> world(worldWith<S>(solver));
        const std::uint32_t material = world.addMaterial(pairOf<S>(0.3, 0));
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        const HalfSpace<S> half{S::Vec::Unit(1), 0};
        const ShapeId belt =
            world.addShape(world.addBody(fixed), {half, {}, material, {at<S>(-2, 0), zeroAng<S>()}});
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, material);
        const double close = solver == "xpbd" || solver == "single_pass" ? 0.05 : tolerance<S>(solver);
        for (int i = 0; i < 60; ++i) world.step(R(kStep));
        EXPECT_NEAR(static_cast<double>(world.velocity(box)[0]), -0.5 * 0.3 * kGravity, close) << solver;
        for (int i = 0; i < 60; ++i) world.step(R(kStep));
        EXPECT_NEAR(static_cast<double>(world.velocity(box)[0]), -2, close) << solver;
        world.setSurfaceVelocity(belt, {at<S>(0, 0), zeroAng<S>()});
        for (int i = 0; i < 120; ++i) world.step(R(kStep));
        EXPECT_NEAR(static_cast<double>(world.velocity(box)[0]), 0, close) << solver;
    }
}

/// Friction has the impulse mu N at the impact as well: v = mu g t, whenever the box has landed.
TYPED_TEST(Moments, ABoxThatLandsOnABeltGetsTheImpulseOfFriction) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = earth<S>();
    def.integrator = "moreau_midpoint";
    World<S> world(def);
    const std::uint32_t material = world.addMaterial(pairOf<S>(0.25, 0));
    BodyDef<S> fixed;
    fixed.type = BodyType::Static;
    const HalfSpace<S> half{S::Vec::Unit(1), 0};
    world.addShape(world.addBody(fixed), {half, {}, material, {at<S>(2, 0), zeroAng<S>()}});
    const BodyId box = addCube<S>(world, 0, 0.25 + 0.3, 0.25, 1, material);
    for (int i = 0; i < 48; ++i) world.step(R(kStep));
    EXPECT_NEAR(static_cast<double>(world.velocity(box)[0]), 0.25 * kGravity * 48 * kStep, 1e-3);
}

/// A turning surface is a turning body to what lies on it, for torsional friction as well.
TYPED_TEST(Moments3d, ABoxRidesOnATurningSurfaceAsOnATurningBody) {
    using S = TypeParam;
    using R = typename S::Real;
    using Vec = typename S::Vec;
    const auto ride = [](const std::string& solver, bool surface) {
        World<S> world(worldWith<S>(solver));
        const std::uint32_t material = world.addMaterial(pairOf<S>(0.8, 0.01, 0.01));
        BodyDef<S> table;
        table.type = surface ? BodyType::Static : BodyType::Kinematic;
        table.pose.p = Vec(R(1), R(-0.5), R(0));
        table.centerOfMass = Vec(R(0), R(0), R(0));
        if (!surface) table.angularVelocity = Vec(0, R(0.7), 0);
        ShapeDef<S> top{Box<S>{Vec(2, R(0.5), 2)}, {}, material};
        if (surface) top.surfaceVelocity = {Vec::Zero(), Vec(0, R(0.7), 0)};
        world.addShape(world.addBody(table), top);
        const BodyId box = addCube<S>(world, 0, 0.25, 0.25, 1, material);
        for (int i = 0; i < 120; ++i) world.step(R(kStep));
        return std::pair(Vec(world.velocity(box)), Vec(world.angularVelocity(box)));
    };
    for (const std::string solver : {"by_island", "pgs", "nsgs", "wide"}) {
        const auto [v, w] = ride(solver, true);
        const auto [vBody, wBody] = ride(solver, false);
        EXPECT_NEAR(static_cast<double>(w[1]), 0.7, 0.02) << solver;
        EXPECT_LT(static_cast<double>((v - vBody).norm() + (w - wBody).norm()), 0.02) << solver;
    }
}

TYPED_TEST(Moments, NegativeOnesAreRefused) {
    using S = TypeParam;
    World<S> world(earth<S>());
    EXPECT_THROW(world.addMaterial(pairOf<S>(0.5, -0.01)), EngineError);
    EXPECT_THROW(world.addMaterial(pairOf<S>(0.5, 0, -0.01)), EngineError);
}

TYPED_TEST(Moments, ASnapshotHasThem) {
    using S = TypeParam;
    for (const std::string solver : {"by_island", "wide"}) {
        const auto make = [&] {
            return Roller<S>(worldWith<S>(solver), pairOf<S>(0.5, 0.011), {at<S>(0.2, 0), zeroAng<S>()});
        };
        Roller<S> roller = make(), other = make();
        roller.roll(1);
        roller.run(0.2);
        roller.world.setSurfaceVelocity(roller.ground, {at<S>(-0.3, 0), zeroAng<S>()});
        std::vector<unsigned char> bytes;
        roller.world.saveSnapshot(bytes);
        other.world.restoreSnapshot(bytes);
        EXPECT_EQ(roller.world.stateHash(), other.world.stateHash()) << solver;
        EXPECT_EQ(other.world.surfaceVelocity(other.ground).v, roller.world.surfaceVelocity(roller.ground).v);
        roller.run(0.2);
        other.run(0.2);
        EXPECT_EQ(roller.world.stateHash(), other.world.stateHash()) << solver;
    }
}

}  // namespace
}  // namespace rigor::engine::test
