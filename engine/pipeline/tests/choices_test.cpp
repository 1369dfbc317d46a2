// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Algorithms by constants, and presets by name.
#include "engine/pipeline/choices.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/tests/scene.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::test {
namespace {

TEST(Choices, SetTheMemberOfTheirFamily) {
    WorldDef<Space3d> def;
    choose(def, choices::solver_nsgs, choices::friction_pyramid, choices::rotation_explicit);
    EXPECT_EQ(def.solver, "nsgs");
    EXPECT_EQ(def.friction, "pyramid");
    EXPECT_EQ(def.rotation, "explicit");
    def.broadPhase = choices::broad_phase_octree;
    EXPECT_EQ(def.broadPhase, "octree");
    choose(def, choices::restitution_combine_max);
    EXPECT_EQ(def.restitutionCombine, "max");
    EXPECT_EQ(def.frictionCombine, "geometric_mean");
}

/// A family that is added to the settings has constants: settings.def names each, choices.hpp includes its table.
TEST(Choices, EveryFamilyOfTheSettingsHasSome) {
    const std::vector<std::string> known{
#define CHOICE_FAMILY(key, member) #key,
#include "engine/pipeline/choice_families.def"
    };
    std::vector<std::string> families;
    for (const AlgorithmFamily& family : algorithmFamilies()) families.push_back(family.name);
    EXPECT_EQ(known, families);
}

TEST(Presets, AreWhatTheirFunctionsMake) {
    const auto fast = WorldDef<Space3f>::preset("fast");
    WorldDef<Space3f> wanted;
    preferSpeed(wanted);
    EXPECT_EQ(fast.solver, wanted.solver);
    EXPECT_EQ(fast.substeps, wanted.substeps);
    EXPECT_EQ(fast.contactFrequency, wanted.contactFrequency);
    EXPECT_EQ(WorldDef<Space2d>::preset("default").solver, WorldDef<Space2d>{}.solver);
    EXPECT_THROW(WorldDef<Space2d>::preset("fastest"), EngineError);
    for (const PresetInfo& preset : presets())
        EXPECT_NO_THROW(World<Space3d>(WorldDef<Space3d>::preset(preset.name)));
}

/// A ball on a slope of friction rolls without slipping: a = g sin / (1 + 2/5). The midpoint rule makes its way exact;
/// that of `fast` is of first order.
TEST(Presets, AreOfSecondOrderButFast) {
    const auto error = [](const char* preset, double h) {
        auto def = WorldDef<Space3d>::preset(preset);
        const double slope = 0.3;
        def.gravity = {kGravity * std::sin(slope), -kGravity * std::cos(slope), 0};
        World<Space3d> world(def);
        addGround<Space3d>(world, kUsualMaterial);
        const BodyId ball = addBall<Space3d>(world, 0, 0.5, 0.5, 1, kUsualMaterial);
        const int steps = static_cast<int>(1 / h + 0.5);
        for (int i = 0; i < steps; ++i) world.step(h);
        return std::abs(world.pose(ball).p.x() - 0.5 * kGravity * std::sin(slope) / 1.4);
    };
    EXPECT_LT(error("accurate", 1.0 / 60), 1e-6);
    EXPECT_LT(error("default", 1.0 / 60), 1e-6);
    EXPECT_GT(error("fast", 1.0 / 60), 1e-3);
}

}  // namespace
}  // namespace rigor::engine::test
