// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers and escapes of all report formats, in one place.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rigor::report {

/// Seventeen significant digits: parses back to the same bits. "nan", "inf" and "-inf" where not finite.
std::string fullNumber(double value);

/// The same for a finite value, "" for any other: what a cell of a CSV file holds.
std::string finiteText(double value);
/// "value is not a number", "bound is infinite": what the CSV's column of reasons says of such a cell.
std::string nonFiniteText(const std::string& column, double value);

/// Four significant digits for reading: "0.01234", "1.234e-07", "NaN", "∞".
std::string shortNumber(double value);

/// A time step as people write it: "1/240 s" when it is one, else "0.0033 s".
std::string timeStepLabel(double dt);

/// Seconds with a fitting unit: "12.3 µs", "4.56 ms", "1.2 s".
std::string durationLabel(double seconds);

/// The character at the start of UTF-8 text.
struct Utf8Character {
    std::size_t length = 0;  ///< number of its bytes; 0: the text starts with no well-formed character
    char32_t point = 0;
};
Utf8Character firstCharacter(std::string_view text);

/// Text in which characters that XML 1.0 can not hold, and bytes that are not UTF-8, are U+FFFD.
std::string validText(std::string_view text);

/// Text inside HTML and XML elements and quoted attributes, from validText().
std::string escapeMarkup(std::string_view text);

/// An RFC 4180 field: quoted when it holds a comma, a quote or a line break.
std::string csvField(std::string_view text);

/// A cell of a Markdown table: no line breaks, pipes and HTML neutralised.
std::string markdownCell(std::string_view text);

/// Letters, digits, '.', '_' and '-'; everything else becomes '_'. Never empty, never starts with a dot.
std::string fileNamePart(std::string_view text);

/// Columns a terminal uses for UTF-8 text of single-width characters.
std::size_t displayWidth(std::string_view text);

/// Replaces the file at once: a reader sees the old one or the whole new one. Throws
/// results::EnvironmentError.
void writeFile(const std::filesystem::path& file, std::string_view content);

}  // namespace rigor::report
