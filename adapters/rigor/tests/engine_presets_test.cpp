// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The presets `fast` and `accurate` are the matched one with what engine::preferSpeed and engine::preferAccuracy set;
// the engine's README names them.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "adapters/interface/registry.hpp"
#include "engine/state/prefer_accuracy.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::adapter {
namespace {

TEST(FastPreset, IsTheMatchedOneWithWhatPreferSpeedSets) {
    engine::WorldDef<engine::Space3d> wanted;
    engine::preferSpeed(wanted);
    const LoadedEngine engine(RIGOR_MODULE);
    const Settings fast = resolveSettings(parseSpec("rigor:preset=fast"), *engine);
    EXPECT_EQ(textSetting(fast, "solver"), wanted.solver);
    EXPECT_EQ(textSetting(fast, "broad_phase"), wanted.broadPhase);
    EXPECT_EQ(integerSetting(fast, "substeps"), wanted.substeps);
    EXPECT_EQ(integerSetting(fast, "velocity_iterations"), wanted.velocityIterations);
    EXPECT_EQ(numberSetting(fast, "contact_frequency"), wanted.contactFrequency);
    EXPECT_EQ(numberSetting(fast, "reuse_distance"), wanted.cacheTolerance);
    EXPECT_EQ(numberSetting(fast, "box_margin"), wanted.boxMargin);
    EXPECT_EQ(numberSetting(fast, "speculative_distance"), wanted.speculativeDistance);
    EXPECT_EQ(textSetting(fast, "curved_joints") == "on", wanted.relinearizedJoints);

    Settings others = resolveSettings(parseSpec("rigor:preset=matched"), *engine);
    int changed = 0;
    for (auto& [key, value] : others)
        if (key != "preset" && value != fast.at(key)) ++changed;
    EXPECT_EQ(changed, 9) << "no more than the nine compared above";
}

TEST(AccuratePreset, IsTheMatchedOneWithWhatPreferAccuracySets) {
    engine::WorldDef<engine::Space3d> wanted;
    engine::preferAccuracy(wanted);
    const LoadedEngine engine(RIGOR_MODULE);
    const Settings accurate = resolveSettings(parseSpec("rigor:preset=accurate"), *engine);
    EXPECT_EQ(textSetting(accurate, "integrator"), wanted.integrator);
    EXPECT_EQ(textSetting(accurate, "solver"), wanted.solver);
    EXPECT_EQ(integerSetting(accurate, "velocity_iterations"), wanted.velocityIterations);
    EXPECT_EQ(numberSetting(accurate, "velocity_tolerance"), wanted.velocityTolerance);

    Settings others = resolveSettings(parseSpec("rigor:preset=matched"), *engine);
    int changed = 0;
    for (auto& [key, value] : others)
        if (key != "preset" && value != accurate.at(key)) ++changed;
    EXPECT_EQ(changed, 4) << "no more than the four compared above";
}

TEST(EnginePresets, AreNamedInTheReadme) {
    std::ifstream file(RIGOR_SOURCE_DIR "/engine/README.md");
    std::stringstream text;
    text << file.rdbuf();
    for (const char* name : {"`rigor:preset=fast`", "`rigor:preset=accurate`"})
        EXPECT_NE(text.str().find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace rigor::adapter
