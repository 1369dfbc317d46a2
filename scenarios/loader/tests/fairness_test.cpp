// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No engine is let off: a bound that names an engine may be tighter than everyone's, never looser. Who cannot
// keep it needs a recorded deviation with a reason, which every report shows.
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

TEST(Fairness, NamedEnginesHaveNoLooserBounds) {
    int compared = 0;
    for (const auto& entry : listScenarios()) {
        const Scenario s = loadScenario(entry.file).scenario;
        for (const Bound& named : s.accept) {
            if (named.engine == "*") continue;
            for (const Bound& common : s.accept) {
                if (common.engine != "*" || common.metric != named.metric) continue;
                ++compared;
                EXPECT_LE(named.max, common.max) << s.name << " " << named.engine << " " << named.metric;
                EXPECT_GE(named.order, common.order) << s.name << " " << named.engine << " " << named.metric;
            }
        }
    }
    EXPECT_GT(compared, 40);
}

TEST(Fairness, EveryScenarioDemandsSomethingOfEverybody) {
    for (const auto& entry : listScenarios()) {
        const Scenario s = loadScenario(entry.file).scenario;
        bool common = false;
        for (const Bound& bound : s.accept) common = common || (bound.engine == "*" && bound.preset.empty());
        EXPECT_TRUE(common) << s.name;
    }
}

}  // namespace
}  // namespace rigor::scenario
