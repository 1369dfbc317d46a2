// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Text of others (files, modules, guests) on its way to a terminal or a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rigor::scenario {

enum class Lines { Escape, Keep };

/// The text with everything escaped that a terminal would obey rather than show: control characters (C0, DEL, C1),
/// bytes that are no UTF-8, and marks that turn the direction of writing. "\x1b" and "\u009b" stand in their places. A
/// line break becomes "\n" unless lines are kept; a tab stays.
std::string printable(std::string_view text, Lines lines = Lines::Escape);

/// Longest text that a module may hand over for a message [bytes]; a longer one is cut, and its length is said.
inline constexpr std::size_t kLongestMessage = 4096;

/// printable() of the first `most` bytes, with a note where there are more.
std::string boundedText(std::string_view text, std::size_t most = kLongestMessage, Lines lines = Lines::Keep);

/// First control character of a text of a file, as "U+001B"; "" if there is none. Line breaks and tabs are none if lines
/// are kept.
std::string controlCharacter(std::string_view text, Lines lines);

}  // namespace rigor::scenario
