// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A symmetry is right when the exact motion has it: exact solutions of the transformed scenario, seen back,
// are those of the scenario. The inverses of the transformations are tested too.
#include "validation/symmetry/symmetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/references/reference.hpp"

namespace rigor::validation {
namespace {

using scenario::Quat;
using scenario::Scenario;
using scenario::Vec3;

Scenario libraryScenario(const std::string& name) {
    return scenario::loadScenario(scenario::findScenario(name)).scenario;
}

/// States that the exact solution does not determine are left at zero in both.
Trajectory exactTrajectory(const Scenario& s, const scenario::ReferenceSpec& spec, int frames) {
    Scenario with = s;
    with.reference = spec;
    const auto reference = findReference(spec.name)->make(with, spec);
    Trajectory t;
    t.dt = s.duration / frames;
    t.bodyCount = s.bodies.size();
    const std::vector<int> known = reference->bodies();
    for (int k = 0; k <= frames && t.dt * k <= reference->validUntil(); ++k) {
        t.times.push_back(k * t.dt);
        t.contacts.emplace_back();
        for (std::size_t i = 0; i < t.bodyCount; ++i) {
            const auto& b = s.bodies[i];
            BodyState state{b.pose.position, b.pose.orientation, b.velocity, b.angularVelocity};
            if (b.type == scenario::BodyType::Kinematic) state.position += t.times.back() * b.velocity;
            if (std::find(known.begin(), known.end(), static_cast<int>(i)) != known.end()) {
                const PartialState exact = reference->exact(i, t.times.back());
                state.position = exact.position.value_or(state.position);
                state.orientation = exact.orientation.value_or(state.orientation);
                state.velocity = exact.velocity.value_or(state.velocity);
                state.angularVelocity = exact.angularVelocity.value_or(state.angularVelocity);
            }
            t.states.push_back(state);
        }
    }
    return t;
}

struct Case {
    const char* scenario;
    std::set<std::string> obstacles;  ///< symmetries it has not
    std::set<std::string>
        unsupported;  ///< symmetries whose transformed scenario the reference does not accept
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.scenario;
}

class ExactMotion : public testing::TestWithParam<Case> {};

TEST_P(ExactMotion, HasTheSymmetry) {
    const Scenario s = libraryScenario(GetParam().scenario);
    ASSERT_TRUE(s.reference);
    constexpr int kFrames = 23;  // no impact falls on a frame
    const Trajectory first = exactTrajectory(s, *s.reference, kFrames);
    ASSERT_GT(first.frames(), 4u);
    for (const SymmetryEntry& entry : symmetryTable()) {
        if (entry.rerun != Rerun::Transformed) continue;
        SCOPED_TRACE(entry.name);
        EXPECT_EQ(!entry.obstacle(s).empty(), GetParam().obstacles.contains(entry.name)) << entry.obstacle(s);
        if (!entry.obstacle(s).empty() || GetParam().unsupported.contains(entry.name)) continue;
        const Transformed other = entry.apply(s, nullptr);
        const Scenario read =
            scenario::loadScenarioText(scenario::scenarioText(other.scenario), "t").scenario;
        const Trajectory back = other.back(exactTrajectory(read, *s.reference, kFrames));
        ASSERT_EQ(back.bodyCount, s.bodies.size());
        const Difference d = differenceOf(s, first, back);
        EXPECT_EQ(d.frames, first.frames());
        // Nine hundred metres away a double ends at 1e-13; references integrate to 1e-12.
        EXPECT_LT(d.position, 2e-11);
        EXPECT_LT(d.angle, 2e-10);
        for (std::size_t k = 0; k < first.states.size(); ++k) {
            EXPECT_LT(norm(first.states[k].velocity - back.states[k].velocity), 1e-10);
            EXPECT_LT(norm(first.states[k].angularVelocity - back.states[k].angularVelocity), 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Library, ExactMotion,
    testing::Values(Case{"free_flight", {"insertion_order"}, {}},
                    Case{"asymmetric_top", {"permutation", "insertion_order"}, {}},
                    Case{"two_sphere_impact", {"insertion_order"}, {}},
                    Case{"spherical_pendulum", {"permutation", "insertion_order"}, {"galilean"}},
                    Case{"physical_pendulum", {"permutation", "insertion_order"}, {"galilean"}},
                    Case{"slide_and_stop", {"permutation"}, {"galilean"}},
                    Case{"rolling_incline", {"permutation"}, {"galilean"}},
                    Case{"oblique_disc_impact_2d", {"rotation_vertical", "permutation"}, {"galilean"}},
                    Case{"double_pendulum_2d", {"rotation_vertical"}, {"galilean"}},
                    Case{"spring_oscillator", {"permutation", "insertion_order"}, {"galilean"}},
                    Case{"quadratic_drag", {"galilean", "permutation", "insertion_order"}, {}}),
    [](const auto& tested) { return tested.param.scenario; });

class EveryScenario : public testing::TestWithParam<scenario::LibraryEntry> {};

/// The transformed scenario can be written to a file, and its start transformed back is the original start.
TEST_P(EveryScenario, CanBeTransformedAndStartsAlike) {
    const Scenario s = scenario::loadScenario(GetParam().file).scenario;
    for (const SymmetryEntry& entry : symmetryTable()) {
        if (entry.rerun != Rerun::Transformed) continue;
        SCOPED_TRACE(entry.name);
        if (const std::string obstacle = entry.obstacle(s); !obstacle.empty()) {
            EXPECT_THROW(entry.apply(s, nullptr), std::invalid_argument) << obstacle;
            continue;
        }
        const Transformed other = entry.apply(s, nullptr);
        const Scenario read =
            scenario::loadScenarioText(scenario::scenarioText(other.scenario), "t").scenario;
        const auto start = [](const Scenario& of) {
            Trajectory t;
            t.dt = 1.0;
            t.bodyCount = of.bodies.size();
            t.times = {0.0};
            t.contacts = {{}};
            for (const auto& b : of.bodies)
                t.states.push_back({b.pose.position, b.pose.orientation, b.velocity, b.angularVelocity});
            return t;
        };
        const Trajectory first = start(s), back = other.back(start(read));
        ASSERT_EQ(back.bodyCount, first.bodyCount);
        for (std::size_t i = 0; i < first.states.size(); ++i) {
            const BodyState &a = first.states[i], &b = back.states[i];
            EXPECT_LT(norm(a.position - b.position), 1e-12 * (1.0 + norm(a.position))) << s.bodies[i].name;
            EXPECT_LT(rotationAngle(a.orientation, b.orientation), 1e-14) << s.bodies[i].name;
            EXPECT_LT(norm(a.angularVelocity - b.angularVelocity), 1e-12) << s.bodies[i].name;
            if (s.bodies[i].type != scenario::BodyType::Static) {
                EXPECT_LT(norm(a.velocity - b.velocity), 1e-13 * (1.0 + norm(a.velocity)))
                    << s.bodies[i].name;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Library, EveryScenario, testing::ValuesIn(scenario::listScenarios()),
                         [](const auto& tested) { return tested.param.name; });

/// Momentum, energy and forces under Froude's scaling: m g L s^4, and so on. The units are what is tested.
TEST(Froude, ScalesWeightEnergyAndSpringsAlike) {
    const Scenario s = libraryScenario("spring_pendulum");
    const Scenario f = findSymmetry("froude")->apply(s, nullptr).scenario;
    const auto& a = s.bodies.back();
    const auto& b = f.bodies.back();
    const double weight = b.massProperties.mass / a.massProperties.mass;
    EXPECT_EQ(weight, 64.0);
    for (std::size_t k = 0; k < s.forces.size(); ++k)
        if (const auto* spring = std::get_if<scenario::SpringForce>(&s.forces[k])) {
            const auto& other = std::get<scenario::SpringForce>(f.forces[k]);
            EXPECT_EQ(other.stiffness * other.restLength / (spring->stiffness * spring->restLength), weight);
            // sqrt(k/m) goes as 1/t
            EXPECT_EQ(other.stiffness / b.massProperties.mass * 4.0,
                      spring->stiffness / a.massProperties.mass);
        }
}

TEST(Mirror, TwiceIsNothing) {
    for (const char* name : {"pile", "pile_2d", "rod_pendulum", "slider_limit_2d", "motor_pair_2d"}) {
        const Scenario s = libraryScenario(name);
        const auto* mirror = findSymmetry("mirror");
        const Scenario once = mirror->apply(s, nullptr).scenario,
                       twice = mirror->apply(once, nullptr).scenario;
        bool moved = false;
        for (std::size_t i = 0; i < s.bodies.size(); ++i) {
            EXPECT_EQ(s.bodies[i].pose, twice.bodies[i].pose);
            EXPECT_EQ(s.bodies[i].massProperties.inertia, twice.bodies[i].massProperties.inertia);
            moved = moved || s.bodies[i].pose != once.bodies[i].pose;
        }
        EXPECT_TRUE(moved || !s.joints.empty()) << name;
        for (std::size_t i = 0; i < s.joints.size(); ++i) {
            EXPECT_EQ(s.joints[i].axisA, twice.joints[i].axisA);
            EXPECT_EQ(s.joints[i].axes[0].lower, twice.joints[i].axes[0].lower);
            EXPECT_EQ(s.joints[i].axes[0].motorSpeed, twice.joints[i].axes[0].motorSpeed);
        }
    }
}

TEST(Galilean, NeedsAWorldThatCanMove) {
    const auto* galilean = findSymmetry("galilean");
    EXPECT_NE(galilean->obstacle(libraryScenario("linear_drag")), "");
    EXPECT_NE(galilean->obstacle(libraryScenario("slide_on_height_field")), "");
    const Scenario slide = galilean->apply(libraryScenario("slide_and_stop"), nullptr).scenario;
    EXPECT_EQ(slide.bodies[0].type, scenario::BodyType::Kinematic) << "the floor is a belt";
    EXPECT_GT(norm(slide.bodies[0].velocity), 1.0);
    const Scenario swing = galilean->apply(libraryScenario("spherical_pendulum"), nullptr).scenario;
    ASSERT_EQ(swing.bodies.size(), 2u) << "what it hangs on";
    EXPECT_EQ(swing.joints[0].bodyA, 1);
}

/// Nothing but the order changes, and all of the order that is said to.
TEST(Orders, MoveWhatTheySay) {
    const Scenario s = libraryScenario("pile_2d");
    const Transformed shuffled = findSymmetry("permutation")->apply(s, nullptr);
    const Transformed other = findSymmetry("insertion_order")->apply(s, nullptr);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        if (s.bodies[i].type == scenario::BodyType::Static) {
            EXPECT_EQ(shuffled.scenario.bodies[i].name, s.bodies[i].name);
        } else if (shuffled.scenario.bodies[i].name != s.bodies[i].name) {
            ++moved;
        }
    }
    EXPECT_GT(moved, 30u);
    std::vector<std::string> dynamic, others;
    for (const auto& b : s.bodies)
        if (b.type == scenario::BodyType::Dynamic) dynamic.push_back(b.name);
    for (const auto& b : other.scenario.bodies)
        if (b.type == scenario::BodyType::Dynamic) others.push_back(b.name);
    EXPECT_EQ(dynamic, others);
    EXPECT_EQ(other.scenario.bodies.back().name, "floor");
}

/// A contact of bodies 1 and 3 comes back as one of the bodies that were there before, from the lower to the
/// higher.
TEST(Orders, BringContactsBack) {
    const Scenario s = libraryScenario("pile_2d");
    const Transformed shuffled = findSymmetry("permutation")->apply(s, nullptr);
    Trajectory t;
    t.dt = 1.0;
    t.bodyCount = s.bodies.size();
    t.times = {0.0};
    t.states.resize(t.bodyCount);
    ContactPoint c;
    c.bodyA = 4;
    c.bodyB = 9;
    c.normal = {0, 1, 0};
    c.pointA = {1, 0, 0};
    c.pointB = {2, 0, 0};
    t.contacts = {{c}};
    const ContactPoint back = shuffled.back(t).contacts[0][0];
    EXPECT_LT(back.bodyA, back.bodyB);
    const auto& names = shuffled.scenario.bodies;
    std::set<std::string> expected{names[4].name, names[9].name};
    EXPECT_EQ(expected, (std::set<std::string>{s.bodies[back.bodyA].name, s.bodies[back.bodyB].name}));
    const bool flipped = s.bodies[back.bodyA].name == names[9].name;
    EXPECT_EQ(back.normal.y, flipped ? -1.0 : 1.0);
    EXPECT_EQ(back.pointA.x, flipped ? 2.0 : 1.0);
}

/// Symplectic Euler in free flight for N steps, turned round, for N more: g h T beside the start (exact).
TEST(TimeReversal, OfSymplecticEulerIsOffByOneStepOfGravity) {
    Scenario s = libraryScenario("free_flight");
    const auto* reversal = findSymmetry("time_reversal");
    for (auto& b : s.bodies) b.collides = true;
    EXPECT_NE(reversal->obstacle(s), "") << "the bodies could meet";
    for (auto& b : s.bodies) b.collides = false;
    ASSERT_EQ(reversal->obstacle(s), "");
    const double h = 1.0 / 64.0;
    const int steps = std::lround(s.duration / h);
    const auto fly = [&](const Scenario& of, int count) {
        Trajectory t;
        t.dt = h;
        t.bodyCount = of.bodies.size();
        std::vector<BodyState> now;
        for (const auto& b : of.bodies) now.push_back({b.pose.position, {}, b.velocity, {}});
        for (int k = 0; k <= count; ++k) {
            t.times.push_back(k * h);
            t.contacts.emplace_back();
            t.states.insert(t.states.end(), now.begin(), now.end());
            for (const auto& e : of.events)
                if (e.time == k * h) {
                    const auto body = static_cast<std::size_t>(e.body);
                    now[body].velocity += e.impulse / of.bodies[body].massProperties.mass;
                }
            for (std::size_t i = 0; i < now.size(); ++i) {
                if (of.bodies[i].type != scenario::BodyType::Dynamic) continue;
                now[i].velocity += h * of.gravity;
                now[i].position += h * now[i].velocity;
            }
        }
        return t;
    };
    Scenario there = s;
    there.duration = steps * h;
    const Trajectory first = fly(there, steps);
    const Transformed back = reversal->apply(there, &first);
    EXPECT_EQ(back.scenario.duration, 2.0 * there.duration);
    const Difference d = differenceOf(there, first, back.back(fly(back.scenario, 2 * steps)));
    EXPECT_NEAR(d.position, norm(s.gravity) * h * there.duration, 1e-12);
    EXPECT_EQ(d.positionAt, 0.0) << "where the film ends";
    for (const char* lossy : {"slide_and_stop", "linear_drag", "bouncing_ball", "motor_pair", "hinge_limit"})
        EXPECT_NE(reversal->obstacle(libraryScenario(lossy)), "") << lossy;
    EXPECT_EQ(reversal->obstacle(libraryScenario("elastic_collision")), "");
}

TEST(DifferenceOf, IsWhatWasPutIn) {
    const Scenario s = libraryScenario("free_flight");
    Trajectory a;
    a.dt = 0.5;
    a.bodyCount = s.bodies.size();
    for (int k = 0; k < 5; ++k) {
        a.times.push_back(0.5 * k);
        a.states.resize(a.states.size() + a.bodyCount);
    }
    Trajectory b = a;
    EXPECT_EQ(differenceOf(s, a, b).differing, 0u);
    const std::size_t dynamic = a.bodyCount - 1;
    b.states[3 * b.bodyCount + dynamic].position = {3, 4, 0};
    b.states[4 * b.bodyCount + dynamic].orientation = scenario::fromAxisAngle({0, 1, 0}, 0.25);
    const Difference d = differenceOf(s, a, b);
    EXPECT_EQ(d.position, 5.0);
    EXPECT_EQ(d.positionAt, 1.5);
    EXPECT_NEAR(d.angle, 0.25, 1e-15);
    EXPECT_EQ(d.differing, 2u);
    EXPECT_EQ(d.firstDiffering, 1.5);
    EXPECT_EQ(d.body, static_cast<int>(dynamic));
    b.times = {0.0, 0.4, 0.9, 1.4, 1.9};
    EXPECT_THROW(differenceOf(s, a, b), std::invalid_argument) << "no common frame";
}

}  // namespace
}  // namespace rigor::validation
