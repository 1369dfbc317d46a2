// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/text_table.hpp"

#include <algorithm>
#include <sstream>

namespace rigor::validation {
namespace {

using Row = std::vector<std::string>;

/// Characters on the screen: escapes take none.
std::size_t shownWidth(const std::string& text) {
    std::size_t width = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\033')
            while (i < text.size() && text[i] != 'm') ++i;
        else
            ++width;
    return width;
}

/// Words in lines of at most `width`.
Row brokenInto(const std::string& text, std::size_t width) {
    Row lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (lines.empty() || lines.back().size() + 1 + word.size() > width)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    }
    return lines;
}

std::size_t longestWord(const std::string& text) {
    std::size_t longest = 0;
    for (const auto& word : brokenInto(text, 0)) longest = std::max(longest, word.size());
    return longest;
}

std::vector<std::size_t> widthsOf(const Row& head, const std::vector<Row>& rows) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < head.size(); ++i) {
        widths.push_back(longestWord(head[i]));
        for (const Row& row : rows)
            if (i < row.size()) widths[i] = std::max(widths[i], shownWidth(row[i]));
    }
    return widths;
}

std::string lineOf(const Row& row, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string gap(widths[i] - shownWidth(row[i]), ' ');
        line += "  " + (i == 0 ? row[i] + gap : gap + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

/// The head's lines stand on the rows: what is short, in the last of them.
std::string headText(const Row& head, const std::vector<std::size_t>& widths) {
    std::vector<Row> broken;
    std::size_t height = 0;
    for (std::size_t i = 0; i < head.size(); ++i) {
        broken.push_back(brokenInto(head[i], widths[i]));
        height = std::max(height, broken.back().size());
    }
    std::string text;
    for (std::size_t line = 0; line < height; ++line) {
        Row row;
        for (const Row& lines : broken) {
            const std::size_t missing = height - lines.size();
            row.push_back(line < missing ? "" : lines[line - missing]);
        }
        text += lineOf(row, widths) + "\n";
    }
    return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
    std::string out;
    for (const auto& line : brokenInto(text, width - indent)) out += std::string(indent, ' ') + line + "\n";
    return out;
}

std::string tableText(const Row& head, const std::vector<Row>& rows) {
    std::vector<Row> cells;
    for (const Row& row : rows)
        cells.emplace_back(row.begin(), row.begin() + std::min(row.size(), head.size()));
    const auto widths = widthsOf(head, cells);
    std::string text = headText(head, widths);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string line = lineOf(cells[i], widths);
        const std::string remark = rows[i].size() > head.size() ? rows[i][head.size()] : "";
        if (remark.empty())
            text += line + "\n";
        else if (shownWidth(line) + 2 + shownWidth(remark) <= kTextWidth)
            text += line + "  " + remark + "\n";
        else
            text += line + "\n" + wrapped(remark, kTextWidth, 6);
    }
    return text;
}

}  // namespace rigor::validation
