// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No choice in name only: two choices of a stage that gave the same bits in every one of these scenes would
// be one. Choices that promise the same motion (broad phases, what is only measured) are distinguished by
// what they count.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <map>
#include <set>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

const bool kPathSet = setenv("RIGOR_ADAPTER_PATH", RIGOR_BINARY_DIR "/bin/adapters", 1) == 0;

struct Scene {
    std::string name;
    Scenario scenario;
    double dt;
    int steps;
};

scenario::Scenario floored(double friction, double restitution) {
    Scenario s = scene(friction, restitution);
    s.gravity = {0, -9.81, 0};
    addStatic(s, Box{{20, 0.5, 20}}, {0, -0.5, 0});
    return s;
}
Body& last(Scenario& s) {
    return s.bodies.back();
}

std::vector<Scene> scenes() {
    std::vector<Scene> all;
    {  // a tumbling pile: contacts of every kind, friction, stacking
        Scenario s = floored(0.5, 0.0);
        for (int i = 0; i < 4; ++i) {
            addBody(s, Box{{0.3, 0.2, 0.25}}, {0.1 * i, 0.3 + 0.55 * i, 0.05 * i}, 2,
                    boxMoments(2, {0.3, 0.2, 0.25}));
            last(s).angularVelocity = {1.0, 0.5 * i, 2.0 - i};
            last(s).velocity = {0.5, 0, 0.7};
        }
        all.push_back({"pile", s, 1.0 / 120, 160});
    }
    {  // two materials, a hard oblique bounce with spin: restitution, combine rules, static friction
        Scenario s = floored(0.3, 0.8);
        s.materials.push_back({"other", 0.9, 0.4, 1000.0});
        addBody(s, Box{{0.2, 0.3, 0.2}}, {0, 1, 0}, 1, boxMoments(1, {0.2, 0.3, 0.2}));
        last(s).shapes[0].material = 1;
        last(s).velocity = {2, -3, 0.3};
        last(s).angularVelocity = {1, 2, -3};
        all.push_back({"bounce", s, 1.0 / 240, 200});
    }
    {  // a top on a spring in free space: integrators, rotations, orientation updates
        Scenario s = scene();
        s.gravity = {0, -1, 0};
        const int b = addBody(s, Sphere{0.1}, {1, 0, 0}, 1, {0.1, 0.2, 0.3});
        last(s).angularVelocity = {3, 1, -2};
        s.forces.push_back(scenario::SpringForce{scenario::kNone, b, {}, {}, 30, 0.1, 0.5});
        all.push_back({"top", s, 1.0 / 100, 100});
    }
    {  // a fast ball and a thin wall, and a slow one that comes to rest: continuous collision, sleeping
        Scenario s = scene(0.5, 0.0);
        s.gravity = {0, -9.81, 0};
        addStatic(s, HalfSpace{{0, 1, 0}, 0});
        addStatic(s, Box{{0.002, 2, 2}}, {3, 2, 0});
        addBody(s, Sphere{0.1}, {0, 1, 0}, 1, even(sphereMoment(1, 0.1)));
        last(s).velocity = {100, 0, 0};
        addBody(s, Box{{0.2, 0.2, 0.2}}, {-3, 0.25, 0}, 1, boxMoments(1, {0.2, 0.2, 0.2}));
        all.push_back({"bullet", s, 1.0 / 60, 150});
    }
    {  // overlap and coincidence: position corrections, guards; far bodies: broad phases
        Scenario s = floored(0.5, 0.0);
        for (int i = 0; i < 2; ++i) addBody(s, Sphere{0.3}, {0, 0.25, 0}, 1, even(sphereMoment(1, 0.3)));
        for (int i = 0; i < 12; ++i) {
            addBody(s, Sphere{0.3}, {3.0 + i, 0.28, 0.2 * i}, 1, even(sphereMoment(1, 0.3)));
            last(s).velocity = {0.4 * i, 0, 0.3};
        }
        all.push_back({"overlap", s, 1.0 / 60, 60});
    }
    {  // a double pendulum: joints
        Scenario s = scene();
        s.gravity = {0, -9.81, 0};
        for (int i = 0; i < 2; ++i) {
            const int b =
                addBody(s, Box{{0.5, 0.05, 0.05}}, {0.5 + i, 0, 0}, 1, boxMoments(1, {0.5, 0.05, 0.05}));
            Joint j;
            j.name = "joint" + std::to_string(i);
            j.type = JointType::Hinge;
            j.bodyA = i == 0 ? scenario::kNone : b - 1;
            j.bodyB = b;
            j.anchorA = {i == 0 ? 0.0 : 0.5, 0, 0};
            j.anchorB = {-0.5, 0, 0};
            j.axisA = j.axisB = {0, 0, 1};
            s.joints.push_back(j);
        }
        all.push_back({"pendulum", s, 1.0 / 120, 100});
    }
    {  // a row of balls that press on each other, 130 contacts: a large island
        Scenario s = floored(0.5, 0.0);
        for (int i = 0; i < 66; ++i)
            addBody(s, Sphere{0.3}, {0.599 * i - 19.5, 0.299, 0}, 1, even(sphereMoment(1, 0.3)));
        all.push_back({"row", s, 1.0 / 60, 3});
    }
    {  // two balls beside each other across their boxes' corners
        Scenario s = floored(0.5, 0.0);
        for (int i = 0; i < 2; ++i)
            addBody(s, Sphere{0.3}, {0.55 * i, 3 + 0.55 * i, 0}, 1, even(sphereMoment(1, 0.3)));
        all.push_back({"corners", s, 1.0 / 60, 3});
    }
    return all;
}

struct Signature {
    std::uint64_t motion = 1469598103934665603ULL, work = 1469598103934665603ULL;
    static void mix(std::uint64_t& hash, double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL;
    }
};

Signature signatureOf(const std::string& options) {
    Signature result;
    for (const Scene& each : scenes()) {
        Simulation run(each.scenario, each.dt, options);
        for (int i = 0; i < each.steps; ++i) {
            run.steps(1);
            for (std::size_t b = 0; b < each.scenario.bodies.size(); ++b) {
                const BodyState x = run.state(b);
                for (const double v :
                     {x.position.x, x.position.y, x.position.z, x.orientation.w, x.orientation.x,
                      x.orientation.y, x.orientation.z, x.velocity.x, x.velocity.y, x.velocity.z,
                      x.angularVelocity.x, x.angularVelocity.y, x.angularVelocity.z})
                    Signature::mix(result.motion, v);
            }
            const auto counted = run.world->counters();
            Signature::mix(result.work, counted.pairTests);
            Signature::mix(result.work, counted.pairs);
            Signature::mix(result.work, counted.narrowPhaseQueries);
            Signature::mix(result.work, counted.solverIterations);
            Signature::mix(result.work, counted.residual);
        }
    }
    return result;
}

TEST(Choices, NoTwoOfAStageAreTheSame) {
    ASSERT_TRUE(kPathSet);
    // Promise the same bits of motion and differ in what they do for it.
    const std::set<std::string> sameMotion{"bounding_volume", "broad_phase", "measure_residuals"};
    for (const auto& option : engine().options()) {
        if (option.values.empty()) continue;
        std::map<std::uint64_t, std::string> motions, works;
        for (const std::string& value : option.values) {
            SCOPED_TRACE(option.key + "=" + value);
            // Rows are measured where contacts are rows, of large islands too.
            const bool measures = option.key == "measure_residuals", ofWide = option.key == "second_search";
            const Signature found = signatureOf(option.key + "=" + value +
                                                (measures ? ",solver=block"
                                                 : ofWide ? ",solver=wide"
                                                          : ""));
            const auto& [work, isNewWork] = works.emplace(found.work, value);
            const auto& [motion, isNewMotion] = motions.emplace(found.motion, value);
            if (sameMotion.contains(option.key))
                EXPECT_TRUE(isNewWork) << "the same work as " << work->second;
            else if (value == "no_cheap_rejection" || motion->second == "no_cheap_rejection")
                EXPECT_TRUE(isNewWork) << "slow, not wrong: the same work as " << work->second;
            else
                EXPECT_TRUE(isNewMotion) << "the same bits as " << motion->second;
        }
        if (sameMotion.contains(option.key)) {
            EXPECT_EQ(motions.size(), 1u) << option.key;
        }
    }
}

}  // namespace
}  // namespace rigor::test
