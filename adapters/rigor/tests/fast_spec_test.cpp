// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The spec for large scenes in the engine's README says what engine::preferSpeed does, with either preset.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "adapters/interface/registry.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::adapter {
namespace {

std::string specOfReadme() {
    std::ifstream file(RIGOR_SOURCE_DIR "/engine/README.md");
    std::stringstream text;
    text << file.rdbuf();
    const std::string readme = text.str();
    const std::size_t begin = readme.find("`rigor:solver=wide") + 1, end = readme.find('`', begin);
    return readme.substr(begin, end - begin);
}

TEST(FastSpec, OfTheReadmeIsPreferSpeedWithEitherPreset) {
    engine::WorldDef<engine::Space3d> wanted;
    engine::preferSpeed(wanted);
    const LoadedEngine engine(RIGOR_MODULE);
    for (const char* preset : {",preset=default", ",preset=matched"}) {
        SCOPED_TRACE(preset);
        const Settings settings = resolveSettings(parseSpec(specOfReadme() + preset), *engine);
        EXPECT_EQ(textSetting(settings, "solver"), wanted.solver);
        EXPECT_EQ(textSetting(settings, "broad_phase"), wanted.broadPhase);
        EXPECT_EQ(integerSetting(settings, "substeps"), wanted.substeps);
        EXPECT_EQ(integerSetting(settings, "velocity_iterations"), wanted.velocityIterations);
        EXPECT_EQ(numberSetting(settings, "contact_frequency"), wanted.contactFrequency);
        EXPECT_EQ(numberSetting(settings, "reuse_distance"), wanted.reuseDistance);
        EXPECT_EQ(numberSetting(settings, "box_margin"), wanted.boxMargin);
        EXPECT_EQ(numberSetting(settings, "speculative_distance"), wanted.speculativeDistance);
        EXPECT_EQ(textSetting(settings, "curved_joints") == "on", wanted.curvedJoints);
    }
}

}  // namespace
}  // namespace rigor::adapter
