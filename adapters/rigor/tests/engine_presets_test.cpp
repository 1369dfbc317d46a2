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

/// Number of settings in which a preset differs from the matched one.
int changesToMatched(const Settings& preset, const Engine& engine) {
    int changed = 0;
    for (const auto& [key, value] : resolveSettings(parseSpec("rigor:preset=matched"), engine))
        if (key != "preset" && value != preset.at(key)) ++changed;
    return changed;
}

TEST(FastPreset, IsTheMatchedOneWithWhatPreferSpeedSets) {
    engine::WorldDef<engine::Space3d> wanted;
    engine::preferSpeed(wanted);
    const LoadedEngine engine(RIGOR_MODULE);
    const Settings fast = resolveSettings(parseSpec("rigor:preset=fast"), *engine);
    EXPECT_EQ(textSetting(fast, "solver"), wanted.solver);
    EXPECT_EQ(textSetting(fast, "integrator"), wanted.integrator);
    EXPECT_EQ(textSetting(fast, "broad_phase"), wanted.broadPhase);
    EXPECT_EQ(integerSetting(fast, "substeps"), wanted.substeps);
    EXPECT_EQ(integerSetting(fast, "velocity_iterations"), wanted.velocityIterations);
    EXPECT_EQ(numberSetting(fast, "contact_frequency"), wanted.contactFrequency);
    EXPECT_EQ(numberSetting(fast, "reuse_distance"), wanted.cacheTolerance);
    EXPECT_EQ(numberSetting(fast, "box_margin"), wanted.boxMargin);
    EXPECT_EQ(numberSetting(fast, "speculative_distance"), wanted.speculativeDistance);
    EXPECT_EQ(textSetting(fast, "curved_joints") == "on", wanted.relinearizedJoints);
    EXPECT_EQ(changesToMatched(fast, *engine), 10) << "no more than the ten compared above";
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
    EXPECT_EQ(changesToMatched(accurate, *engine), 3) << "no more than the settings compared above";
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
