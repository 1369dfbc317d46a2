// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/json/json_text.hpp"

#include <algorithm>
#include <set>

#include "scenarios/model/printable.hpp"

namespace rigor::scenario {
namespace {

int lineAt(const std::string& text, std::size_t offset) {
    return 1 + static_cast<int>(std::count(
                   text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())),
                   '\n'));
}

/// The parser's words without its "[json.exception.parse_error.101] parse error at ".
std::string withoutPrefix(std::string message) {
    if (const auto end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
    const std::string words = "parse error at ";
    if (message.starts_with(words)) message.erase(0, words.size());
    return message;
}

struct Extent {
    int depth = 0;            ///< levels of brackets outside strings
    std::size_t deepest = 0;  ///< offset of the innermost bracket
    std::size_t values = 1;   ///< number of values, at most
};

/// The parser recurses, and each value takes a hundred bytes: this comes before it.
Extent extentOf(const std::string& text) {
    Extent extent;
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            ++extent.values;
            if (++depth > extent.depth) {
                extent.depth = depth;
                extent.deepest = i;
            }
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',') {
            ++extent.values;
        }
    }
    return extent;
}

/// Walks text that is known to be valid JSON and notes where each value starts and which keys come twice.
class Locator {
  public:
    Locator(const std::string& text, const std::string& file) : text_(text), file_(file) {}
    std::map<std::string, int> lines;
    std::vector<Problem> problems;

    /// `lineAround`: where what the value stands in has its line. A value on the same line needs none of its own:
    /// millions of numbers would take more memory for their places than for themselves.
    void value(const std::string& pointer, int lineAround) {
        skipSpace();
        if (line_ != lineAround) lines.emplace(pointer, line_);
        const int here = line_;
        const char c = text_[at_];
        if (c == '{')
            object(pointer, here);
        else if (c == '[')
            array(pointer, here);
        else if (c == '"')
            refuseControl(string(), Lines::Keep, pointer, line_);
        else
            while (at_ < text_.size() &&
                   std::string_view(",]} \t\r\n").find(text_[at_]) == std::string_view::npos)
                ++at_;
    }

  private:
    void skipSpace() {
        for (; at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos;
             ++at_)
            if (text_[at_] == '\n') ++line_;
    }
    std::string string() {
        const std::size_t begin = at_++;
        while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
        ++at_;
        return Json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
    }
    /// Names and texts of a file reach terminals, pages and C interfaces of libraries.
    void refuseControl(const std::string& text, Lines allowed, const std::string& pointer, int line) {
        if (const std::string found = controlCharacter(text, allowed); !found.empty())
            problems.push_back(
                {"json.control_character", file_, pointer, line,
                 "the control character " + found + (allowed == Lines::Escape ? " in a key" : " in a string"),
                 allowed == Lines::Escape ? "keys without control characters"
                                          : "text without control characters but line breaks and tabs"});
    }
    void object(const std::string& pointer, int here) {
        std::set<std::string> keys;
        ++at_;
        for (skipSpace(); text_[at_] != '}'; skipSpace()) {
            if (text_[at_] == ',') {
                ++at_;
                skipSpace();
            }
            const int line = line_;
            const std::string key = string();
            const std::string child = pointer + "/" + escapeToken(key);
            refuseControl(key, Lines::Escape, child, line);
            if (!keys.insert(key).second)
                problems.push_back({"json.duplicate_key", file_, child, line,
                                    "the key '" + key + "' a second time", "each key once"});
            skipSpace();
            ++at_;  // the colon
            value(child, here);
        }
        ++at_;
    }
    void array(const std::string& pointer, int here) {
        std::size_t index = 0;
        ++at_;
        for (skipSpace(); text_[at_] != ']'; skipSpace()) {
            if (text_[at_] == ',') ++at_;
            value(pointer + "/" + std::to_string(index++), here);
        }
        ++at_;
    }

    const std::string& text_;
    const std::string& file_;
    std::size_t at_ = 0;
    int line_ = 1;
};

}  // namespace

std::string escapeToken(const std::string& token) {
    std::string escaped;
    for (const char c : token)
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    return escaped;
}

std::string describe(const Json& value) {
    switch (value.type()) {
        case Json::value_t::object:
            return "object with " + std::to_string(value.size()) + " keys";
        case Json::value_t::array:
            return "array of " + std::to_string(value.size());
        case Json::value_t::null:
            return "null";
        default:
            break;
    }
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return std::string(value.type_name()) + " " + text;
}

int JsonDocument::lineOf(std::string pointer) const {
    for (;;) {
        if (const auto it = lines.find(pointer); it != lines.end()) return it->second;
        const auto slash = pointer.rfind('/');
        if (slash == std::string::npos) return 0;
        pointer.resize(slash);
    }
}

JsonDocument parseDocument(const std::string& text, const std::string& fileName) {
    const auto refuse = [&](const char* id, std::size_t offset, const std::string& found,
                            const std::string& expected) {
        throw LoadError({{id, fileName, "", lineAt(text, offset), found, expected}});
    };
    if (text.size() > kMaxBytes)
        refuse("json.size", 0, std::to_string(text.size()) + " bytes",
               "at most " + std::to_string(kMaxBytes));
    const Extent extent = extentOf(text);
    if (extent.depth > kMaxDepth)
        refuse("json.depth", extent.deepest, std::to_string(extent.depth) + " levels of brackets",
               "at most " + std::to_string(kMaxDepth));
    if (extent.values > kMaxValues)
        refuse("json.values", 0, std::to_string(extent.values) + " values",
               "at most " + std::to_string(kMaxValues));
    JsonDocument document;
    try {
        document.value = Json::parse(text);
    } catch (const Json::parse_error& error) {
        refuse("json.syntax", error.byte > 0 ? error.byte - 1 : 0, withoutPrefix(error.what()),
               "JSON (RFC 8259)");
    } catch (const Json::out_of_range& error) {
        // "number overflow parsing '1e999'": the parser gives no place, its token does.
        const std::string message = withoutPrefix(error.what());
        const auto quote = message.find('\'');
        const std::string token =
            quote == std::string::npos ? "" : message.substr(quote + 1, message.size() - quote - 2);
        const auto place = token.empty() ? std::string::npos : text.find(token);
        refuse("json.number", place == std::string::npos ? 0 : place, message, "numbers in double range");
    }
    Locator locator(text, fileName);
    locator.value("", 0);
    if (!locator.problems.empty()) throw LoadError(std::move(locator.problems));
    document.lines = std::move(locator.lines);
    return document;
}

}  // namespace rigor::scenario
