// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/encoding/text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "validation/results/files.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

std::string print(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

}  // namespace

Utf8Character firstCharacter(std::string_view text) {
    if (text.empty()) return {};
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return {1, first};
    const std::size_t length = first >= 0xF0 && first < 0xF5   ? 4
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xC2 && first < 0xE0 ? 2
                                                               : 0;
    if (length == 0 || text.size() < length) return {};
    char32_t point = first & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {};
        point = (point << 6) | (byte(i) & 0x3F);
    }
    constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
    if (point < kLeast[length] || surrogate || point > 0x10FFFF) return {};
    return {length, point};
}

namespace {

bool allowedInXml(char32_t c) {
    return c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c != 0xFFFE && c != 0xFFFF);
}

}  // namespace

std::string finiteText(double value) {
    return std::isfinite(value) ? fullNumber(value) : "";
}

std::string nonFiniteText(const std::string& column, double value) {
    return column + " is " + results::nonFiniteWords(value);
}

std::string fullNumber(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    return print("%.17g", value);
}

std::string shortNumber(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
    const double size = std::abs(value);
    if (size != 0.0 && (size < 1e-3 || size >= 1e5)) return print("%.2e", value);
    return print("%.4g", value);
}

std::string timeStepLabel(double dt) {
    const double rate = 1.0 / dt;
    const double whole = std::round(rate);
    if (whole >= 2.0 && std::abs(rate - whole) < 1e-9 * whole) return print("1/%.0f s", whole);
    return print("%.4g s", dt);
}

std::string durationLabel(double seconds) {
    if (!std::isfinite(seconds)) return shortNumber(seconds);
    if (seconds < 1e-3) return print("%.3g µs", seconds * 1e6);
    if (seconds < 1.0) return print("%.3g ms", seconds * 1e3);
    return print("%.3g s", seconds);
}

std::string validText(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Utf8Character c = firstCharacter(text);
        const bool isValid = c.length > 0 && allowedInXml(c.point);
        out += isValid ? text.substr(0, c.length) : "\xEF\xBF\xBD";
        text.remove_prefix(std::max<std::size_t>(1, c.length));
    }
    return out;
}

std::string escapeMarkup(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : validText(text)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            case '\n':
                out += "&#10;";
                break;
            case '\r':
                out += "&#13;";
                break;
            case '\t':
                out += "&#9;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string csvField(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

std::string markdownCell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '\n':
            case '\r':
                out += ' ';
                break;
            case '|':
            case '*':
            case '_':
            case '`':
            case '[':
            case ']':
            case '\\':
                out += '\\';
                out += c;
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '@':
                out += "@\u200b";
                break;  // a pasted summary must notify no account
            default:
                out += c;
        }
    }
    return out;
}

std::string fileNamePart(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '_' || c == '-' || (c == '.' && !out.empty());
        out += plain ? c : '_';
    }
    if (out.size() > 120) out.resize(120);
    return out.empty() ? "_" : out;
}

std::size_t displayWidth(std::string_view text) {
    std::size_t width = 0;
    for (const char c : text) width += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return width;
}

void writeFile(const std::filesystem::path& file, std::string_view content) {
    results::replaceScratchFile(file, content);
}

}  // namespace rigor::report
