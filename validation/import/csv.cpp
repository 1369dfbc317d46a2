// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "scenarios/loader/overrides.hpp"

namespace rigor::validation {
namespace {

using scenario::LoadError;
using scenario::Problem;

std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> values;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        std::string_view value = line.substr(begin, end - begin);
        while (!value.empty() && value.front() == ' ') value.remove_prefix(1);
        while (!value.empty() && value.back() == ' ') value.remove_suffix(1);
        values.emplace_back(value);
        begin = end + 1;
    }
    return values;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, const std::vector<std::string>& required)
    : file_(file.string()) {
    const std::string text = scenario::readTextFile(file);
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = std::string_view(text).substr(begin, end - begin);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        begin = end + 1;
        ++number;
        if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
        std::vector<std::string> values = split(line);
        if (columns_.empty()) {
            columns_ = std::move(values);
            continue;
        }
        if (values.size() != columns_.size())
            throw LoadError({problem("csv.fields", number, std::to_string(values.size()) + " values",
                                     std::to_string(columns_.size()) + ", as many as the header has")});
        rows_.push_back({number, std::move(values)});
    }
    if (rows_.empty()) throw LoadError({problem("csv.empty", 0, "no line of values", "a header and values")});
    for (const std::string& name : required) {
        const auto count = std::count(columns_.begin(), columns_.end(), name);
        if (count != 1)
            throw LoadError({problem("csv.column", 1, "the columns " + joined(columns_),
                                     (count == 0 ? "a column '" : "one column '") + name + "'")});
    }
}

bool CsvTable::has(const std::string& column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::size_t CsvTable::index(const std::string& column) const {
    const auto it = std::find(columns_.begin(), columns_.end(), column);
    if (it == columns_.end()) throw std::invalid_argument("no column " + column);
    return it - columns_.begin();
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
    return rows_[row].values[index(column)];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
    const std::string& value = text(row, column);
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(number))
        throw LoadError(
            {problem("csv.number", line(row), "'" + value + "' in column " + column, "a finite number")});
    return number;
}

int CsvTable::integer(std::size_t row, const std::string& column) const {
    const double value = number(row, column);
    if (value != std::floor(value) || std::abs(value) > 1e9)
        throw LoadError({problem("csv.number", line(row), "'" + text(row, column) + "' in column " + column,
                                 "a whole number")});
    return static_cast<int>(value);
}

Problem CsvTable::problem(const std::string& id, int line, const std::string& found,
                          const std::string& expected) const {
    return {id, file_, "", line, found, expected};
}

}  // namespace rigor::validation
