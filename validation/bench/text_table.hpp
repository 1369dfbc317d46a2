// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A table for a terminal.
#pragma once

#include <string>
#include <vector>

namespace rigor::validation {

/// [characters] What is said in words is broken there: remarks of rows, and notes.
inline constexpr std::size_t kTextWidth = 118;

/// Rows below `head`, two spaces between columns; escapes that colour a cell take no room. The first column
/// and the last are set to the left. A head is broken at its spaces into lines no wider than the cells below
/// it (or its longest word). The last column has no head: remarks, which go to lines of their own below the
/// row where they would stand beyond kTextWidth. Rows may be shorter than the head.
std::string tableText(const std::vector<std::string>& head,
                      const std::vector<std::vector<std::string>>& rows);

/// `text` in lines of at most `width` characters (single words may be longer), each after `indent` spaces.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

}  // namespace rigor::validation
