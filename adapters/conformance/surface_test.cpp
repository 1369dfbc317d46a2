// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rolling and torsional friction and surfaces that move over their bodies: as much as the pair and the shape say, or
// refused by name.
#include <cmath>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

constexpr double kSurfaceGravity = 9.81, kRollerRadius = 0.2, kRollerMass = 1.5, kRollerMoment = 0.03;
constexpr double kSurfaceStep = 1.0 / 240.0;

class Surface : public DynamicsTest {
  protected:
    /// Materials 0 and 1 whose pair has the friction mu; a floor of material 0.
    Scenario floorScene(double mu) const {
        Scenario s = scene(0.9);
        s.gravity = {0, -kSurfaceGravity, 0};
        s.materials.push_back({"other", 0.1, 0.0, 1000.0});
        s.pairs.push_back({1, 0, mu, 0.0});
        addStatic(s, block({20, 1, 20}), {0, -1, 0});
        return s;
    }
    int addRoller(Scenario& s) const {
        const int index = addBody(s, ball(kRollerRadius), {0, kRollerRadius, 0}, kRollerMass,
                                  {kRollerMoment, kRollerMoment, kRollerMoment});
        s.bodies.back().shapes[0].material = 1;
        return index;
    }
    int addSlider(Scenario& s) const {
        const Vec3 half{0.5, 0.1, 0.5};
        const int index = addBody(s, block(half), {0, 0.1, 0}, 2.0, boxMoments(2.0, half));
        s.bodies.back().shapes[0].material = 1;
        return index;
    }
    /// An engine without the feature refuses it by name. One without shapes need not: the kit's bodies do not collide there,
    /// and what a surface does has no effect.
    void expectRefusal(const Scenario& s, const char* what) const {
        const bool anyTouch = !engine().capabilities().shapes.empty();
        try {
            build(s, kSurfaceStep);
            EXPECT_FALSE(anyTouch) << "built without " << what;
        } catch (const adapter::Unsupported& refused) {
            EXPECT_NE(std::string(refused.what()).find(what), std::string::npos) << refused.what();
        }
    }
};
INSTANTIATE_TEST_SUITE_P(Kit, Surface, testing::ValuesIn(dynamicsArenas()), arenaName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Surface);

TEST_P(Surface, RollingFrictionIsThatOfThePair) {
    for (const double rho : {0.01, 0.02}) {
        SCOPED_TRACE(rho);
        Scenario s = floorScene(0.5);
        s.pairs.back().rollingFriction = rho;
        const int roller = addRoller(s);
        s.bodies.back().velocity = {1, 0, 0};
        s.bodies.back().angularVelocity = {0, 0, -1 / kRollerRadius};
        if (!engine().capabilities().rollingFriction) {
            expectRefusal(s, "rolling friction");
            return;
        }
        auto world = build(s, kSurfaceStep);
        run(*world, 120);
        const double a = rho * kRollerMass * kSurfaceGravity / kRollerRadius /
                         (kRollerMass + kRollerMoment / (kRollerRadius * kRollerRadius));
        within("rolling_friction", std::abs((1 - stateOf(*world, s, roller).velocity.x) / (0.5 * a) - 1),
               2e-2);
        run(*world, static_cast<int>(1 / (a * kSurfaceStep)));
        within("rolling_stops", norm(stateOf(*world, s, roller).velocity), 1e-3);
    }
}

TEST_P(Surface, TorsionalFrictionIsThatOfThePair) {
    if (is2d()) return;
    for (const double rho : {0.004, 0.008}) {
        SCOPED_TRACE(rho);
        Scenario s = floorScene(0.5);
        s.pairs.back().torsionalFriction = rho;
        const int roller = addRoller(s);
        s.bodies.back().angularVelocity = {0, 3, 0};
        if (!engine().capabilities().torsionalFriction) {
            expectRefusal(s, "torsional friction");
            return;
        }
        auto world = build(s, kSurfaceStep);
        run(*world, 60);
        const double braking = rho * kRollerMass * kSurfaceGravity / kRollerMoment;
        const double lost = 3 - stateOf(*world, s, roller).angularVelocity.y;
        within("torsional_friction", std::abs(lost / (0.25 * braking) - 1), 2e-2);
        run(*world, static_cast<int>(3 / (braking * kSurfaceStep)));
        within("torsional_stops", norm(stateOf(*world, s, roller).angularVelocity), 1e-3);
    }
}

TEST_P(Surface, ABeltTakesWhatLiesOnItAlong) {
    if (!hasShape("box")) GTEST_SKIP() << "no boxes";
    const double angle = is2d() ? 0.0 : 0.6, mu = 0.3, speed = 1.2;
    const Vec3 belt{speed * std::cos(angle), 0, speed * std::sin(angle)};
    for (const bool floorFirst : {true, false})
        for (const double turn : {0.0, 0.4}) {
            SCOPED_TRACE(std::to_string(floorFirst) + ", turned by " + std::to_string(turn));
            if (turn != 0.0 && is2d()) continue;
            Scenario s = floorScene(mu);
            const int slider = addSlider(s);
            s.bodies[0].pose.orientation = fromAxisAngle({0, 1, 0}, turn);
            s.bodies[0].shapes[0].surfaceVelocity.linear = rotateInverse(s.bodies[0].pose.orientation, belt);
            if (!floorFirst) std::swap(s.bodies[0], s.bodies[1]);
            if (!engine().capabilities().surfaceVelocity) {
                expectRefusal(s, "velocity of a surface");
                return;
            }
            auto world = build(s, kSurfaceStep);
            run(*world, 48);
            const int which = floorFirst ? slider : 0;
            const Vec3 half = stateOf(*world, s, which).velocity;
            within("belt_pulls", norm(half - 0.2 * mu * kSurfaceGravity / speed * belt) / speed, 2e-2);
            run(*world, 192);
            within("belt_carries", norm(stateOf(*world, s, which).velocity - belt) / speed, 1e-2);
        }
}

/// A surface that turns about a point beside the body's origin carries a block round.
TEST_P(Surface, ATurningSurfaceTurnsWhatLiesOnIt) {
    if (is2d() || !engine().capabilities().surfaceVelocity) return;
    const double rate = 0.8;
    Scenario s = floorScene(0.6);
    const int slider = addSlider(s);
    s.bodies[0].pose.position = {1, -1, 0.5};
    s.bodies[0].shapes[0].surfaceVelocity = {{0, 0, 0.3}, {0, rate, 0}};
    auto world = build(s, kSurfaceStep);
    run(*world, 240);
    const BodyState state = stateOf(*world, s, slider);
    const Vec3 field = Vec3{0, 0, 0.3} + cross({0, rate, 0}, state.position - Vec3{1, 0.1, 0.5});
    within("turning_surface_speed", norm(state.velocity - field), 2e-2);
    within("turning_surface_rate", std::abs(state.angularVelocity.y - rate), 2e-2);
}

}  // namespace
}  // namespace rigor::conformance
