// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <string>

#include "engine/contacts/material_table.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine::test {
namespace {

MaterialTable<Space3d> table() {
    MaterialTable<Space3d> materials;
    const auto rule = [](const char* name) {
        return findAlgorithm(combineTable<double>(), "combine", std::string(name)).make;
    };
    materials.setCombineRules(rule("geometric_mean"), rule("min"));
    return materials;
}

TEST(MaterialTable, CombinesByItsRulesInBothOrders) {
    MaterialTable<Space3d> materials = table();
    const std::uint32_t a = materials.add({0.25, 0.5, 0});
    const std::uint32_t b = materials.add({0.64, 0.2, 0.81});
    EXPECT_EQ(materials.size(), 4u) << "with kFrictionless and kUsualMaterial";
    for (const auto& pair : {materials.pair(a, b), materials.pair(b, a)}) {
        EXPECT_DOUBLE_EQ(pair.friction, 0.4);
        EXPECT_DOUBLE_EQ(pair.restitution, 0.2);
        EXPECT_DOUBLE_EQ(pair.staticFriction, 0.45);
    }
    EXPECT_EQ(materials.pair(kFrictionless, b).friction, 0);
    EXPECT_DOUBLE_EQ(materials.pair(kUsualMaterial, kUsualMaterial).friction, 0.6);
}

TEST(MaterialTable, KeepsPairsThatWereSetWhenMaterialsAreAdded) {
    MaterialTable<Space3d> materials = table();
    const std::uint32_t a = materials.add({0.25, 0.5, 0});
    const std::uint32_t b = materials.add({0.64, 0.2, 0});
    materials.setPair(b, a, {0.9, 0.1, 0});
    const std::uint64_t before = materials.revision();
    materials.add({1, 1, 0});
    EXPECT_NE(materials.revision(), before);
    EXPECT_EQ(materials.pair(a, b).friction, 0.9);
    EXPECT_EQ(materials.pair(b, a).restitution, 0.1);
    EXPECT_EQ(materials.pair(a, a).friction, 0.25);
}

}  // namespace
}  // namespace rigor::engine::test
