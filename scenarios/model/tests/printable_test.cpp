// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/printable.hpp"

#include <gtest/gtest.h>

namespace rigor::scenario {
namespace {

TEST(Printable, OrdinaryTextStays) {
    const std::string text = "a\tb \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80 [31m";
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable("one\ntwo", Lines::Keep), "one\ntwo");
}

TEST(Printable, WhatATerminalObeysIsEscaped) {
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\x1b[2J\x07\x7f"), "\\x1b[2J\\x07\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\u009b31m");
    EXPECT_EQ(printable("one\r\ntwo"), "one\\r\\ntwo");
    EXPECT_EQ(printable("one\rtwo\n", Lines::Keep), "one\\rtwo\n");
    EXPECT_EQ(printable("\xe2\x80\xae"), "\\u202e") << "from right to left";
}

TEST(Printable, BytesThatAreNoUtf8AreEscaped) {
    EXPECT_EQ(printable("\x9b"
                        "1m"),
              "\\x9b1m");
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "an overlong form";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
}

TEST(BoundedText, IsCutBetweenCharacters) {
    EXPECT_EQ(boundedText("short"), "short");
    EXPECT_EQ(boundedText("ab\xc3\xa9", 3), "ab ... (cut: 4 bytes, at most 3 are kept)");
    EXPECT_LT(boundedText(std::string(1000000, '\x1b')).size(), 4 * kLongestMessage + 100);
}

TEST(ControlCharacter, IsNamed) {
    EXPECT_EQ(controlCharacter("plain \xc3\xa9", Lines::Escape), "");
    EXPECT_EQ(controlCharacter("a\nb\t", Lines::Keep), "");
    EXPECT_EQ(controlCharacter("a\nb", Lines::Escape), "U+000A");
    EXPECT_EQ(controlCharacter("a\x1b", Lines::Keep), "U+001B");
    EXPECT_EQ(controlCharacter("\xc2\x9b", Lines::Keep), "U+009B");
    EXPECT_EQ(controlCharacter(std::string_view("\0", 1), Lines::Keep), "U+0000");
}

}  // namespace
}  // namespace rigor::scenario
