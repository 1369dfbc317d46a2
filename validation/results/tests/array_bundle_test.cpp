// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/array_bundle.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace rigor::results {
namespace {

using nlohmann::ordered_json;

TEST(ArrayBundle, IsAHeadAndAlignedArrays) {
    ArrayBundle bundle;
    const double times[] = {0.25, -1e300};
    const std::int16_t turns[] = {-32768, 0, 7};
    const float last[] = {0.5f};
    bundle.add("t", times);
    bundle.add("q", turns);
    bundle.add("y", last);
    const std::string bytes = bundle.bytes({{"steps", 3}});

    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    const auto head = ordered_json::parse(bytes.substr(4, length));
    EXPECT_EQ(head["meta"]["steps"], 3);
    const std::size_t start = (4 + length + 7) / 8 * 8;
    ASSERT_EQ(head["arrays"].size(), 3u);
    for (const auto& entry : head["arrays"]) EXPECT_EQ(entry["offset"].get<std::size_t>() % 8, 0u);

    const auto at = [&](int i) {
        return bytes.data() + start + head["arrays"][i]["offset"].get<std::size_t>();
    };
    EXPECT_EQ(head["arrays"][0]["type"], "f64");
    EXPECT_EQ(std::memcmp(at(0), times, sizeof times), 0);
    EXPECT_EQ(head["arrays"][1]["type"], "i16");
    EXPECT_EQ(head["arrays"][1]["count"], 3);
    EXPECT_EQ(std::memcmp(at(1), turns, sizeof turns), 0);
    EXPECT_EQ(std::memcmp(at(2), last, sizeof last), 0);
    EXPECT_EQ(bytes.size() % 8, 0u);
}

TEST(ArrayBundle, IsReadBackAndTakenOver) {
    ArrayBundle bundle, all;
    const std::vector<double> times{1.5, -0.0, 1e-310};
    const std::vector<std::int32_t> bodies{-1, 7, 1 << 30};
    bundle.add("t", std::span(times));
    bundle.add("b", std::span(bodies));
    ordered_json meta;
    const ArrayBundle back = ArrayBundle::parse(bundle.bytes({{"steps", 3}}), meta);
    EXPECT_EQ(meta["steps"], 3);
    EXPECT_EQ(back.doubles("t"), times);
    all.add("b", std::span(bodies).first(1));
    all.take("0/", back);
    all.take("1/", back);
    const ArrayBundle twice = ArrayBundle::parse(all.bytes(nullptr), meta);
    EXPECT_EQ(twice.integers("1/b"), bodies);
    EXPECT_EQ(twice.doubles("0/t"), times);
    EXPECT_EQ(twice.integers("b"), std::vector<std::int32_t>{-1});
    EXPECT_FALSE(twice.has("t"));
    EXPECT_THROW((void)twice.doubles("t"), std::runtime_error);
    EXPECT_THROW((void)twice.doubles("b"), std::runtime_error) << "another type";
}

TEST(ArrayBundle, DamagedBytesAreRefused) {
    ArrayBundle bundle;
    const std::vector<double> times{1.5, 2.5};
    bundle.add("t", std::span(times));
    const std::string bytes = bundle.bytes("meta");
    ordered_json meta;
    for (const std::size_t length : {std::size_t{0}, std::size_t{6}, std::size_t{20}, bytes.size() - 1})
        EXPECT_THROW((void)ArrayBundle::parse(bytes.substr(0, length), meta), std::runtime_error) << length;
    EXPECT_THROW((void)ArrayBundle::parse("nonsense and more of it", meta), std::runtime_error);
    EXPECT_NO_THROW((void)ArrayBundle::parse(bytes, meta));
}

TEST(ArrayBundle, MayHoldNothing) {
    const std::string bytes = ArrayBundle().bytes(nullptr);
    EXPECT_EQ(bytes.size() % 8, 0u);
    EXPECT_NE(bytes.find("\"meta\":null"), std::string::npos);
}

}  // namespace
}  // namespace rigor::results
