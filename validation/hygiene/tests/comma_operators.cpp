// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/hygiene/tests/comma_operators.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

struct Token {
    std::string_view text;
    std::size_t line = 0;
};

using Words = std::initializer_list<std::string_view>;

bool contains(Words words, std::string_view text) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

bool isName(const Token& token) {
    return isWordCharacter(token.text[0]) && std::isdigit(static_cast<unsigned char>(token.text[0])) == 0;
}

/// Splits `source` into tokens; comments and preprocessor lines fall away.
class Lexer {
  public:
    explicit Lexer(std::string_view source) : source_(source) {}

    std::vector<Token> tokens() {
        std::vector<Token> found;
        while (at_ < source_.size()) {
            if (skipBlank() || skipDirective() || skipComment()) continue;
            const std::size_t begin = at_;
            at_ = endOfToken();
            lineStart_ = false;
            const std::string_view text = source_.substr(begin, at_ - begin);
            found.push_back({text, line_});
            line_ += std::count(text.begin(), text.end(), '\n');
        }
        return found;
    }

  private:
    bool skipBlank() {
        if (std::isspace(static_cast<unsigned char>(source_[at_])) == 0) return false;
        if (source_[at_] == '\n') {
            ++line_;
            lineStart_ = true;
        }
        ++at_;
        return true;
    }

    bool skipDirective() {
        if (!lineStart_ || source_[at_] != '#') return false;
        while (at_ < source_.size() && (source_[at_] != '\n' || source_[at_ - 1] == '\\'))
            line_ += source_[at_++] == '\n';
        return true;
    }

    bool skipComment() {
        const bool block = source_.substr(at_, 2) == "/*";
        if (!block && source_.substr(at_, 2) != "//") return false;
        const std::size_t end = block ? source_.find("*/", at_) : source_.find('\n', at_);
        const std::size_t next =
            std::min(end == std::string_view::npos ? end : end + (block ? 2 : 0), source_.size());
        const std::string_view text = source_.substr(at_, next - at_);
        line_ += std::count(text.begin(), text.end(), '\n');
        at_ = next;
        return true;
    }

    std::size_t endOfToken() const {
        if (source_.substr(at_, 2) == "R\"") {
            const std::size_t open = source_.find('(', at_);
            const std::string close = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
            return source_.find(close, open) + close.size();
        }
        const char first = source_[at_];
        std::size_t end = at_ + 1;
        if (first == '"' || first == '\'') {
            while (source_[end] != first) end += source_[end] == '\\' ? 2 : 1;
            return end + 1;
        }
        if (isWordCharacter(first)) {
            const bool number = std::isdigit(static_cast<unsigned char>(first)) != 0;
            while (end < source_.size() && (isWordCharacter(source_[end]) ||
                                            (number && (source_[end] == '\'' || source_[end] == '.'))))
                ++end;
            return end;
        }
        static const Words pairs{"::", "->", "++", "--", "<=", ">=", "==", "!=", "&&", "||",
                                 "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<"};
        if (source_.substr(at_, 3) == "...") return at_ + 3;
        return contains(pairs, source_.substr(at_, 2)) ? at_ + 2 : end;
    }

    std::string_view source_;
    std::size_t at_ = 0, line_ = 1;
    bool lineStart_ = true;
};

/// The tokens of one file with the partner of each bracket.
class Source {
  public:
    explicit Source(std::vector<Token> tokens) : tokens_(std::move(tokens)), partner_(tokens_.size(), 0) {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, {"(", "[", "{"})) open.push_back(i);
            if (!is(i, {")", "]", "}"}) || open.empty()) continue;
            partner_[i] = open.back();
            partner_[open.back()] = i;
            open.pop_back();
        }
    }

    std::vector<CommaOperator> find() {
        readStatements(0, tokens_.size());
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, {"{"}) && partner_[i] > i) readStatements(i + 1, partner_[i]);
            if (is(i, {"("}) && partner_[i] > i) readParenthesis(i);
        }
        std::stable_sort(found_.begin(), found_.end(),
                         [](const CommaOperator& a, const CommaOperator& b) { return a.line < b.line; });
        return std::move(found_);
    }

  private:
    bool is(std::size_t i, Words texts) const { return contains(texts, tokens_[i].text); }

    /// The index behind the brackets, template arguments or token that begin at `i`.
    std::size_t next(std::size_t i) const {
        if (is(i, {"(", "[", "{"}) && partner_[i] > i) return partner_[i] + 1;
        if (is(i, {"<"}) && i > 0 && isName(tokens_[i - 1])) return behindTemplateArguments(i);
        return i + 1;
    }

    /// `i + 1` if the `<` at `i` compares.
    std::size_t behindTemplateArguments(std::size_t i) const {
        static const Words never{";", "{", "}", "]", ")", "&&", "||", "==", "!=", "<=", ">=", "?", "="};
        std::size_t depth = 0;
        for (std::size_t k = i; k < tokens_.size() && !is(k, never);) {
            if (is(k, {"<"})) ++depth;
            if (is(k, {">"}) && --depth == 0) return k + 1;
            k = is(k, {"(", "["}) && partner_[k] > k ? partner_[k] + 1 : k + 1;
        }
        return i + 1;
    }

    /// True if the braces that open at `i` hold statements and end the one before them.
    bool isBlock(std::size_t i) const {
        static const Words before{")", "}", "else", "do", "try", "const", "noexcept", "override"};
        if (i > 0 && is(i - 1, before)) return true;
        for (std::size_t k = i + 1; k < partner_[i]; k = next(k))
            if (is(k, {";"}) || (is(k, {"{"}) && isBlock(k))) return true;
        return false;
    }

    void readStatements(std::size_t begin, std::size_t end) {
        std::size_t start = begin;
        std::vector<std::size_t> commas;
        const auto restart = [&](std::size_t at) {
            start = at;
            commas.clear();
        };
        for (std::size_t i = begin; i < end;) {
            const std::size_t behind = next(i);
            if (is(i, {";"})) {
                if (!commas.empty() && commas.front() != start && !isDeclaration(start)) report(start, i);
                restart(behind);
            } else if ((is(i, {"{"}) && isBlock(i)) || is(i, {"else", "do"}) || isLabelEnd(start, i)) {
                restart(behind);
            } else if (is(i, {"("}) && isControl(i)) {
                restart(behind);
            } else if (is(i, {","})) {
                commas.push_back(i);
            }
            i = behind;
        }
    }

    bool isLabelEnd(std::size_t start, std::size_t i) const {
        return is(i, {":"}) && is(start, {"case", "default", "public", "private", "protected"});
    }

    bool isControl(std::size_t open) const {
        if (open == 0) return false;
        if (is(open - 1, {"constexpr"}) && open > 1) return is(open - 2, {"if"});
        return is(open - 1, {"if", "for", "while", "switch", "catch"});
    }

    /// True if the statement that starts at `i` has the form [specifiers] type name.
    bool isDeclaration(std::size_t i) const {
        static const Words declares{"using",     "typedef", "template", "friend",       "static_assert",
                                    "extern",    "struct",  "class",    "union",        "enum",
                                    "namespace", "const",   "static",   "constexpr",    "constinit",
                                    "auto",      "inline",  "mutable",  "public",       "private",
                                    "protected", "[",       "typename", "thread_local", "alignas"};
        static const Words expressions{"return",   "throw", "delete", "co_return",
                                       "co_yield", "goto",  "new",    "sizeof"};
        static const Words builtIn{"unsigned", "signed", "long",  "short", "int",
                                   "char",     "bool",   "float", "double"};
        if (is(i, declares)) return true;
        if (is(i, expressions)) return false;
        while (is(i, builtIn) && is(i + 1, builtIn)) ++i;
        if (is(i, {"::"})) ++i;
        for (bool qualified = true; qualified; i += qualified) {
            if (!isName(tokens_[i])) return false;
            ++i;
            if (is(i, {"<"})) i = next(i);
            qualified = is(i, {"::"});
        }
        while (is(i, {"*", "&", "&&", "const"})) ++i;
        return isName(tokens_[i]) || (is(i, {"["}) && is(i - 1, {"&", "&&"}));
    }

    void readParenthesis(std::size_t open) {
        static const Words callsNothing{"return", "if",        "while", "switch",
                                        "case",   "co_return", "throw", "for"};
        if (open > 0) {
            const bool named = isName(tokens_[open - 1]) && !is(open - 1, callsNothing);
            const bool operatorName = open > 1 && is(open - 2, {"operator"});
            if (named || operatorName || is(open - 1, {">", ")", "]", "}", "for"})) return;
        }
        for (std::size_t i = open + 1; i < partner_[open]; i = next(i))
            if (is(i, {","}) && !is(i + 1, {"..."}) && !is(i - 1, {"..."})) {
                report(open, partner_[open]);
                return;
            }
    }

    void report(std::size_t first, std::size_t last) {
        std::string statement;
        for (std::size_t i = first; i <= last; ++i)
            statement += (i == first ? "" : " ") + std::string(tokens_[i].text);
        found_.push_back({tokens_[first].line, std::move(statement)});
    }

    std::vector<Token> tokens_;
    std::vector<std::size_t> partner_;  ///< index of the matching bracket; 0 where there is none
    std::vector<CommaOperator> found_;
};

}  // namespace

std::vector<CommaOperator> commaOperators(const std::string& source) {
    return Source(Lexer(source).tokens()).find();
}

}  // namespace rigor::hygiene
