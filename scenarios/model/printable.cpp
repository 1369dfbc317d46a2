// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/printable.hpp"

#include <cstdint>
#include <cstdio>

namespace rigor::scenario {
namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t length = 1;
    bool valid = false;
};

/// The character at the start of `text`, which is not empty. Overlong forms and surrogates are not valid.
Character firstOf(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {lead, 1, true};
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {lead, 1, false};
    std::uint32_t code = lead & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) return {lead, 1, false};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < kLeast[length] || code > 0x10ffff || surrogate) return {lead, 1, false};
    return {code, length, true};
}

bool isControl(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code <= 0x9f);
}

bool turnsDirection(std::uint32_t code) {
    return (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0x200e ||
           code == 0x200f;
}

std::string formatted(const char* format, std::uint32_t code) {
    char text[16];
    std::snprintf(text, sizeof text, format, static_cast<unsigned>(code));
    return text;
}

std::string escaped(const Character& c) {
    if (c.valid && c.code == '\n') return "\\n";
    if (c.valid && c.code == '\r') return "\\r";
    return formatted(c.valid && c.code >= 0x80 ? "\\u%04x" : "\\x%02x", c.code);
}

bool isShown(const Character& c, Lines lines) {
    if (!c.valid) return false;
    if (c.code == '\t') return true;
    if (c.code == '\n') return lines == Lines::Keep;
    return !isControl(c.code) && !turnsDirection(c.code);
}

}  // namespace

std::string printable(std::string_view text, Lines lines) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const Character c = firstOf(text);
        if (isShown(c, lines))
            shown += text.substr(0, c.length);
        else
            shown += escaped(c);
        text.remove_prefix(c.length);
    }
    return shown;
}

std::string boundedText(std::string_view text, std::size_t most, Lines lines) {
    if (text.size() <= most) return printable(text, lines);
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;
    return printable(text.substr(0, end), lines) + " ... (cut: " + std::to_string(text.size()) +
           " bytes, at most " + std::to_string(most) + " are kept)";
}

std::string controlCharacter(std::string_view text, Lines lines) {
    while (!text.empty()) {
        const Character c = firstOf(text);
        const bool spaces = c.code == '\n' || c.code == '\r' || c.code == '\t';
        if (c.valid && isControl(c.code) && !(spaces && lines == Lines::Keep))
            return formatted("U+%04X", c.code);
        text.remove_prefix(c.length);
    }
    return "";
}

}  // namespace rigor::scenario
