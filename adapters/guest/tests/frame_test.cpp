// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rigor::guest {
namespace {

Frame sample() {
    Frame frame;
    frame.header["id"] = 7;
    frame.addTable("states", {2, 3, {1, 2, 3, 4, 5, -0.0}});
    frame.addBytes("snapshot", {1, 0, 255});
    frame.addTable("empty", {0, 19, {}});
    return frame;
}

TEST(Frames, ComeBackWhereverTheyAreCut) {
    const std::string bytes = encode(sample()) + encode(sample());
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
        FrameReader reader;
        reader.append(bytes.data(), cut);
        int frames = 0;
        while (reader.next()) ++frames;
        reader.append(bytes.data() + cut, bytes.size() - cut);
        while (const auto frame = reader.next()) {
            ++frames;
            EXPECT_EQ(frame->header["id"], 7);
            EXPECT_EQ(frame->table("states", 3).values, sample().table("states", 3).values);
            EXPECT_EQ(frame->bytes("snapshot"), (std::vector<unsigned char>{1, 0, 255}));
            EXPECT_EQ(frame->table("empty", 19).rows, 0u);
        }
        ASSERT_EQ(frames, 2) << cut;
        ASSERT_EQ(reader.pending(), 0u);
    }
}

/// The example of PROTOCOL.md.
TEST(Frames, HaveTheBytesOfThePage) {
    Frame frame;
    frame.header = Json{{"id", 3}};
    const std::string expected("RGF1\x08\0\0\0\0\0\0\0\0\0\0\0{\"id\":3}", 24);
    EXPECT_EQ(encode(frame), expected);
}

std::string problemOf(const std::string& header, std::uint64_t payload) {
    std::string bytes = "RGF1";
    const auto size = static_cast<std::uint32_t>(header.size());
    bytes.append(reinterpret_cast<const char*>(&size), 4);
    bytes.append(reinterpret_cast<const char*>(&payload), 8);
    bytes += header + std::string(payload < 100 ? payload : 0, 'x');
    FrameReader reader;
    reader.append(bytes.data(), bytes.size());
    try {
        return reader.next() ? "" : "incomplete";
    } catch (const BadFrame& error) {
        return error.what();
    }
}

TEST(Frames, AreHeldToTheirHeaders) {
    using testing::HasSubstr;
    EXPECT_EQ(problemOf("{}", 0), "");
    EXPECT_THAT(problemOf("{}", 8), HasSubstr("0 bytes, the frame has 8"));
    EXPECT_THAT(problemOf("[1]", 0), HasSubstr("no JSON object"));
    EXPECT_THAT(problemOf(R"({"arrays": 1})", 0), HasSubstr("expected a list"));
    EXPECT_THAT(problemOf(R"({"arrays": [{"name": "a"}]})", 0), HasSubstr("expected name and shape"));
    EXPECT_THAT(problemOf(R"({"arrays": [{"name": "a", "shape": [-1, 2]}]})", 0),
                HasSubstr("expected a count"));
    EXPECT_THAT(problemOf(R"({"arrays": [{"name": "a", "shape": [4294967296, 4096]}]})", 0),
                HasSubstr("larger"));
    EXPECT_THAT(problemOf(R"({"arrays": [{"name": "a", "shape": [1, 1], "type": "f32"}]})", 4),
                HasSubstr("expected f64 or u8"));
    EXPECT_THAT(problemOf("{}", std::uint64_t{1} << 40), HasSubstr("more than a frame may have"));
}

TEST(Frames, AreRefusedAtTheirFirstWrongByte) {
    FrameReader reader;
    reader.append("R", 1);
    EXPECT_FALSE(reader.next());
    reader.append("X", 1);
    EXPECT_THROW(reader.next(), BadFrame);
}

}  // namespace
}  // namespace rigor::guest
