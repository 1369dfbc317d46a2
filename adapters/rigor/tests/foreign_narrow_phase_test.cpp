// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The rigor module as a whole: collision queries by every algorithm it lists, and worlds whose contacts come
// from another engine's narrow phase, where that engine is installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "adapters/interface/tests/scenes.hpp"

namespace rigor::test {
namespace {

/// Modules of this build, also those that are loaded by name.
const bool kModulePathSet = setenv("RIGOR_ADAPTER_PATH", RIGOR_BINARY_DIR "/bin/adapters", 1) == 0;

std::vector<std::string> narrowPhaseValues() {
    for (const auto& option : engine().options())
        if (option.key == "narrow_phase") return option.values;
    return {};
}
bool installed(const std::string& name) {
    const auto engines = adapter::availableEngines();
    return std::find(engines.begin(), engines.end(), name) != engines.end();
}

TEST(RigorCollision, EveryAlgorithmReportsDepthAndDistance) {
    ASSERT_TRUE(kModulePathSet);
    EXPECT_EQ(engine().collision()->algorithms(), narrowPhaseValues());
    const Geometry a = Box{{0.5, 0.5, 0.5}}, b = boxHull({0.25, 0.5, 0.75});
    for (const std::string& algorithm : engine().collision()->algorithms()) {
        SCOPED_TRACE(algorithm);
        for (const double gap : {-0.1, 0.2}) {
            adapter::CollisionQuery query;
            query.algorithm = algorithm;
            query.a = {&a, {{1, 2, 3}, {}}};
            query.b = {&b, {{1.75 + gap, 2.1, 3.2}, {}}};
            const auto answer = engine().collision()->collide(query);
            EXPECT_EQ(answer.overlap, gap < 0);
            ASSERT_TRUE(answer.signedDistance);
            EXPECT_NEAR(*answer.signedDistance, gap, 1e-6);
            ASSERT_TRUE(answer.witnessA && answer.witnessB);
            EXPECT_NEAR(answer.witnessA->x, 1.5, 1e-6);
            EXPECT_NEAR(answer.witnessB->x, 1.5 + gap, 1e-6);
            EXPECT_EQ(answer.contacts.empty(), gap > 0);
            for (const ContactPoint& c : answer.contacts) EXPECT_NEAR(c.normal.x, 1, 1e-6);
        }
    }
    adapter::CollisionQuery query;
    query.algorithm = "magic";
    query.a = query.b = {&a, {}};
    EXPECT_THROW((void)engine().collision()->collide(query), adapter::BadInput);
}

class ForeignNarrowPhase : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Engines, ForeignNarrowPhase, testing::Values("bullet", "fcl"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(ForeignNarrowPhase, HoldsAStackThatTheInHouseSolverSolves) {
    const std::string name = GetParam(), key = std::string("narrow_phase=") + name;
    if (!installed(name)) {
        EXPECT_THROW(Simulation(scene(), 0.01, key), adapter::BadInput);
        GTEST_SKIP() << name << " is not installed";
    }
    Scenario s = scene(0.5);
    s.gravity = {0, -9.81, 0};
    addStatic(s, Box{{5, 1, 5}}, {0, -1, 0});
    const int lower = addBody(s, Box{{0.5, 0.5, 0.5}}, {0, 0.5, 0}, 1, even(1.0 / 6));
    const int upper = addBody(s, boxHull({0.5, 0.5, 0.5}), {0.1, 1.5, 0.05}, 1, even(1.0 / 6));
    const int ball = addBody(s, Sphere{0.3}, {2, 0.5, 0}, 1, even(0.036));
    Simulation run(s, 1.0 / 240, key);
    run.seconds(1.5);
    // Contacts are reported for overlaps only, and EPA of none below 1e-7 m.
    EXPECT_NEAR(run.state(lower).position.y, 0.5, 2e-3);
    EXPECT_NEAR(run.state(upper).position.y, 1.5, 4e-3);
    EXPECT_NEAR(run.state(ball).position.y, 0.3, 2e-3);
    EXPECT_LT(norm(run.state(upper).velocity), 0.1);
    EXPECT_GE(run.contacts().size(), 3u);
}

TEST_P(ForeignNarrowPhase, IsRefusedInThePlane) {
    const std::string name = GetParam();
    if (!installed(name)) GTEST_SKIP() << name << " is not installed";
    EXPECT_THROW(Simulation(scene(0, 0, 2), 0.01, "narrow_phase=" + name), adapter::Unsupported);
}

}  // namespace
}  // namespace rigor::test
