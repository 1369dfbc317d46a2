// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A comment is a sentence with a subject, or a noun phrase that names the thing. A comment that begins with
// "Of", "What" or "Whose" leaves its subject to the code beside it, which a reader has to understand first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

/// First words of a comment that has left out its subject.
const std::set<std::string> kFirstWords{"and",   "but",  "by",    "for",   "from", "how",   "of",  "that",
                                        "those", "what", "where", "which", "who",  "whose", "with"};

/// Comment of a line, without its marks.
struct LineComment {
    bool afterCode = false;
    std::size_t column = 0;
    std::string text;
};

/// Empty if the line has no comment.
std::optional<LineComment> commentOf(const std::string& line) {
    std::size_t at = line.find("//");
    if (at == std::string::npos) at = line.find("/**");
    if (at == std::string::npos) return std::nullopt;
    LineComment comment;
    comment.column = at;
    comment.afterCode = line.find_first_not_of(" \t") != at;
    const std::size_t text = line.find_first_not_of("/*!< ", at);
    if (text != std::string::npos) comment.text = line.substr(text);
    return comment;
}

/// First word in small letters; "" if the text begins with a formula, as in "by = A x".
std::string firstWord(const std::string& text) {
    std::string word;
    std::size_t end = 0;
    for (; end < text.size() && std::isalpha(static_cast<unsigned char>(text[end])) != 0; ++end)
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(text[end])));
    return text.compare(end, 1, " ") == 0 && text.compare(end, 3, " = ") != 0 ? word : "";
}

/// A message for each comment of `text` that begins with one of the words.
std::vector<std::string> commentsWithoutSubject(const std::string& file, const std::string& text) {
    std::vector<std::string> found;
    std::optional<std::size_t> column;  // that of the comment in the line before
    bool license = false;  // the comment has begun with the licence, and its text is still to come
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::optional<LineComment> comment = commentOf(text.substr(at, end - at));
        at = end + 1;
        ++number;
        if (!comment) {
            column.reset();
            license = false;
            continue;
        }
        const bool begins =
            comment->afterCode || comment->column != column || (license && !comment->text.empty());
        column = comment->column;
        license = comment->text.starts_with("SPDX") || (license && comment->text.empty());
        if (begins && kFirstWords.contains(firstWord(comment->text)))
            found.push_back(file + ":" + std::to_string(number) + ": \"" + comment->text + "\"");
    }
    return found;
}

TEST(Comments, BeginWithASubject) {
    std::size_t read = 0;
    for (const std::string& file : sourceFiles({".cpp", ".hpp", ".ts"})) {
        if (file.starts_with("validation/hygiene/")) continue;  // it quotes such comments
        ++read;
        for (const std::string& message : commentsWithoutSubject(file, readFile(file)))
            ADD_FAILURE() << message << " names no subject";
    }
    EXPECT_GT(read, 1400u);
}

TEST(Comments, TheRuleReadsTheirFirstWords) {
    const auto found = [](const std::string& text) { return commentsWithoutSubject("a", text).size(); };
    EXPECT_EQ(found("int a;  ///< of the body\n/// What it is.\nint b;\n/** Whose it is. */"), 3u);
    EXPECT_EQ(found("// SPDX\n//\n// What it is.\n"), 1u);
    EXPECT_EQ(found("// Rows of a joint,\n// of a contact.\nint a;  // rows\n        // of a joint\n"), 0u);
    EXPECT_EQ(found("int a;  // of a joint\nint b;  // of a contact\n"), 2u);
    EXPECT_EQ(found("// by = 2\n// Bytes.\n// Office.\n"), 0u);
    EXPECT_EQ(commentsWithoutSubject("a", "\n/// Of a body.").at(0), "a:2: \"Of a body.\"");
}

}  // namespace
}  // namespace rigor::hygiene
