// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {

TEST(IdTable, SlotsAreReusedButNeverTheHandle) {
    IdTable<BodyTag> table;
    const BodyId a = table.add(10), b = table.add(11);
    EXPECT_TRUE(a) << "index 0 is null";
    EXPECT_FALSE(table.contains(BodyId{}));
    table.remove(a);
    EXPECT_FALSE(table.contains(a));
    const BodyId c = table.add(12);
    EXPECT_EQ(c.index, a.index);
    EXPECT_NE(c.generation, a.generation);
    EXPECT_EQ(table.dense(b), 11u);
    EXPECT_EQ(table.dense(c), 12u);
    table.move(b, 3);
    EXPECT_EQ(table.dense(b), 3u);
}

/// The message of the EngineError that a call throws.
template <class F>
std::string refusal(const F& call) {
    try {
        call();
    } catch (const EngineError& error) {
        return error.what();
    }
    return "";
}

TEST(IdTable, TellsWhatIsWrongWithAHandle) {
    using testing::HasSubstr;
    IdTable<JointTag> table;
    const JointId a = table.add(0), b = table.add(1);
    EXPECT_THAT(refusal([&] { table.dense(JointId{}); }),
                HasSubstr("null_handle: the handle of a joint is null"));
    EXPECT_THAT(
        refusal([&] {
            table.dense({3, 0});
        }),
        HasSubstr("stale_handle: joint 3, generation 0: this world has never had it; its indices end at 2"));
    EXPECT_THAT(refusal([&] {
                    table.dense({2, 1});
                }),
                HasSubstr("joint 2, generation 1: this world has never"));
    table.remove(a);
    const std::string removed = "stale_handle: joint 1, generation 0: it has been removed";
    for (const std::string& text : {refusal([&] { table.dense(a); }), refusal([&] { table.move(a, 5); }),
                                    refusal([&] { table.remove(a); })}) {
        EXPECT_THAT(text, HasSubstr(removed + ". World::contains()"));
    }
    EXPECT_THAT(refusal([&] { table.dense({1, 1}); }), HasSubstr("has never had it"));
    table.add(0);
    EXPECT_THAT(refusal([&] { table.dense(a); }),
                HasSubstr(removed + ", and joint 1, generation 1 has its place"));
    EXPECT_EQ(table.dense(b), 1U);
}

TEST(IdTable, CopiesGiveOutTheSameHandles) {
    IdTable<BodyTag> table;
    std::vector<BodyId> ids;
    for (std::uint32_t i = 0; i < 20; ++i) ids.push_back(table.add(i));
    for (const std::size_t i : {3u, 17u, 5u}) table.remove(ids[i]);
    IdTable<BodyTag> copy = table;
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(table.add(i), copy.add(i));
}

TEST(Hasher, IsFnv1a) {
    Hasher hash;
    EXPECT_EQ(hash.value(), 0xcbf29ce484222325ull);
    hash.bytes("a", 1);
    EXPECT_EQ(hash.value(), 0xaf63dc4c8601ec8cull);  // published test vector
    hash.bytes("b", 1);
    EXPECT_NE(hash.value(), 0xaf63dc4c8601ec8cull);
}

}  // namespace
}  // namespace rigor::engine
