// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor draw` as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/tests/program.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

TEST(DrawCommand, DrawsShapesAndContactsOfAnyEngine) {
    const fs::path file = fs::path(RIGOR_BINARY_DIR) / ("drawn-" + std::to_string(getpid()) + ".svg");
    for (const std::string engine : {"rigor", "box2d", "bullet"}) {
        const auto drawn = rigor("draw box_stack_2d --at 0.5 --engine " + engine +
                                 " --show contact,outline --out " + file.string());
        ASSERT_EQ(drawn.code, 0) << drawn.out;
        EXPECT_THAT(drawn.out, HasSubstr("box_stack_2d at 0.5 s"));
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        EXPECT_THAT(text.str(), testing::StartsWith("<svg "));
        EXPECT_GE(count(text.str(), "class=\"outline\""), 40u) << "ten boxes of four edges";
        EXPECT_EQ(count(text.str(), "<circle "), 20u) << "two points between each two boxes, by " << engine;
        EXPECT_EQ(count(text.str(), "class=\"normal\""), 0u);
    }
    fs::remove(file);
}

/// Big-endian number of four bytes.
std::size_t numberAt(const std::string& bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[at + i]);
    return value;
}

TEST(DrawCommand, WritesPngFiles) {
    const fs::path file = fs::path(RIGOR_BINARY_DIR) / ("drawn-" + std::to_string(getpid()) + ".png");
    const auto drawn = rigor("draw box_stack --at 0.1 --width 300 --out " + file.string());
    ASSERT_EQ(drawn.code, 0) << drawn.out;
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    ASSERT_GT(bytes.size(), 500u);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(numberAt(bytes, 16), 300u);
    EXPECT_GT(numberAt(bytes, 20), 300u) << "a stack is higher than wide";
    fs::remove(file);
    const auto svg = rigor("draw box_stack --at 0.1 --width 300", false);
    EXPECT_THAT(svg.out, testing::StartsWith("<svg "));
}

TEST(DrawCommand, WritesPdfFiles) {
    const fs::path file = fs::path(RIGOR_BINARY_DIR) / ("drawn-" + std::to_string(getpid()) + ".pdf");
    const auto drawn = rigor("draw box_stack --at 0.1 --width 300 --out " + file.string());
    ASSERT_EQ(drawn.code, 0) << drawn.out;
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    EXPECT_THAT(text.str(), testing::StartsWith("%PDF-"));
    EXPECT_THAT(text.str(), HasSubstr("%%EOF"));
    EXPECT_THAT(text.str(), HasSubstr("/MediaBox [ 0 0 225 ")) << "300 pixels of 1/96 inch, in points";
    fs::remove(file);
}

TEST(DrawCommand, ShowsWhereTheBodiesAreAtThatTime) {
    const auto begin = rigor("draw free_flight --at 0 --show outline", false);
    const auto later = rigor("draw free_flight --at 0.5 --show outline,velocity", false);
    ASSERT_EQ(begin.code, 0) << begin.out;
    ASSERT_EQ(later.code, 0) << later.out;
    EXPECT_NE(begin.out, later.out);
    EXPECT_GE(count(later.out, "class=\"velocity\""), 1u);
    EXPECT_EQ(count(begin.out, "class=\"outline\""), count(later.out, "class=\"outline\""));
}

/// Boxes and islands are those of the engine where it shows them, else the least boxes and the islands of contacts.
TEST(DrawCommand, DrawsBoxesAndIslandsOfAnyEngine) {
    for (const std::string engine : {"rigor", "box2d"}) {
        const auto drawn = rigor("draw box_stack_2d --at 0.5 --show box,island --engine " + engine, false);
        ASSERT_EQ(drawn.code, 0) << drawn.out;
        EXPECT_GE(count(drawn.out, "class=\"box\""), 40u) << "ten boxes of four edges, by " << engine;
        EXPECT_EQ(count(drawn.out, "class=\"island\""), 10u) << "one island, by " << engine;
        EXPECT_EQ(count(drawn.out, "class=\"outline\""), 0u);
    }
}

TEST(DrawCommand, SaysWhatItDoesNotTake) {
    const auto kind = rigor("draw box_stack_2d --show outlines");
    EXPECT_EQ(kind.code, 2);
    EXPECT_THAT(kind.out, HasSubstr("did you mean 'outline'"));
    const auto late = rigor("draw box_stack_2d --at 1e6");
    EXPECT_EQ(late.code, 2);
    EXPECT_THAT(late.out, HasSubstr("--at"));
    const auto missing = rigor("draw box_stack_2d --engine fcl");
    EXPECT_EQ(missing.code, 4) << missing.out;
    const auto ending = rigor("draw box_stack_2d --out stack.tiff");
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.out,
                HasSubstr("--out: found 'stack.tiff', expected a name that ends in .svg, .png or .pdf"));
    const auto nowhere = rigor("draw box_stack_2d --out /nowhere/at/all.svg");
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_THAT(nowhere.out, HasSubstr("No such file"));
}

}  // namespace
}  // namespace rigor::cli_test
