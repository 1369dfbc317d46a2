// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every setting: its default is what WorldDef has, its range is what worlds accept, its names are in a table.
#include "engine/state/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "engine/core/error.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::engine {
namespace {

/// Gives every setting its default, but one number.
struct Given {
    std::string key;
    double value = 0;
    std::string text(const char* k) const { return setting(k).byDefault; }
    double real(const char* k) const { return k == key ? value : std::stod(setting(k).byDefault); }
    int integer(const char* k) const { return static_cast<int>(real(k)); }
    bool on(const char* k) const { return setting(k).byDefault == "on"; }
};

/// The id of what a world with this number is refused for; empty where it is accepted.
template <class S>
std::string refusal(const std::string& key, double value) {
    WorldDef<S> def;
    assignSettings(def, Given{key, value});
    try {
        checkSettings<S>(def);
    } catch (const EngineError& error) {
        return error.id();
    }
    return "";
}

template <class S>
class EverySetting : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(EverySetting, Spaces);

TYPED_TEST(EverySetting, HasTheDefaultOfWorldDef) {
    using S = TypeParam;
    const WorldDef<S> plain;
    WorldDef<S> assigned;
    assignSettings(assigned, Given{});
#define CHOICE(member, key, byDefault, help) EXPECT_EQ(assigned.member, plain.member) << key;
#define INTEGER(member, key, byDefault, min, max, help) EXPECT_EQ(assigned.member, plain.member) << key;
#define REAL(member, key, byDefault, min, max, help) EXPECT_EQ(assigned.member, plain.member) << key;
#define SWITCH(member, key, byDefault, help) EXPECT_EQ(assigned.member, plain.member) << key;
#include "engine/state/settings.def"
    EXPECT_NO_THROW(World<S>{assigned});
}

TYPED_TEST(EverySetting, IsAcceptedWithinItsRangeAlone) {
    using S = TypeParam;
    for (const SettingInfo& info : settings()) {
        if (info.kind != SettingKind::Integer && info.kind != SettingKind::Real) continue;
        EXPECT_EQ(refusal<S>(info.key, info.min), "") << info.key;
        EXPECT_EQ(refusal<S>(info.key, info.max), "") << info.key;
        const double more = info.kind == SettingKind::Integer ? 1 : 0.01 * (1 + info.max);
        EXPECT_EQ(refusal<S>(info.key, info.min - more), info.key);
        EXPECT_EQ(refusal<S>(info.key, info.max + more), info.key);
        if (info.kind == SettingKind::Integer) continue;
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
            EXPECT_EQ(refusal<S>(info.key, bad), info.key) << bad;
    }
}

TYPED_TEST(EverySetting, IsCheckedByTheWorld) {
    using S = TypeParam;
    WorldDef<S> def;
    def.slop = -1;
    EXPECT_THROW(World<S>{def}, EngineError);
    def = {};
    def.pyramidDirections = 5;
    EXPECT_THROW(World<S>{def}, EngineError);
}

TEST(Settings, HaveOneKeyEachAndAHelp) {
    std::set<std::string> keys;
    for (const SettingInfo& info : settings()) {
        EXPECT_TRUE(keys.insert(info.key).second) << info.key;
        EXPECT_FALSE(info.help.empty()) << info.key;
    }
    EXPECT_THROW(setting("velocity_iteration"), EngineError);
}

TEST(Settings, NamedAlgorithmsAreThoseOfTheTables) {
    std::map<std::string, std::set<std::string>> tables;
    for (const AlgorithmFamily& family : algorithmFamilies())
        for (const AlgorithmInfo& algorithm : family.algorithms) tables[family.name].insert(algorithm.name);
    std::size_t algorithms = 0;
    for (const SettingInfo& info : settings()) {
        if (info.kind != SettingKind::Algorithm) continue;
        ++algorithms;
        EXPECT_TRUE(tables[info.key].contains(info.byDefault)) << info.key << " = " << info.byDefault;
    }
    EXPECT_EQ(algorithms, algorithmFamilies().size());
}

}  // namespace
}  // namespace rigor::engine
