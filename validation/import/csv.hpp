// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables of numbers as data sets come: a header line, values between commas. Errors are reported with file,
// line, the text found and the one expected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {

class CsvTable {
  public:
    /// Reads the whole file; columns may stand in any order and beside others. Throws LoadError:
    /// "file.unreadable", "csv.empty", "csv.column" (one is missing or there twice), "csv.fields" (a line
    /// with more or fewer values than the header).
    CsvTable(const std::filesystem::path& file, const std::vector<std::string>& required);

    std::size_t size() const { return rows_.size(); }
    const std::string& file() const { return file_; }
    int line(std::size_t row) const { return rows_[row].line; }
    bool has(const std::string& column) const;
    const std::string& text(std::size_t row, const std::string& column) const;
    /// A finite number. Throws LoadError ("csv.number").
    double number(std::size_t row, const std::string& column) const;
    int integer(std::size_t row, const std::string& column) const;

    /// A problem in a line of this file (0: of the whole file), for a LoadError.
    scenario::Problem problem(const std::string& id, int line, const std::string& found,
                              const std::string& expected) const;

  private:
    struct Row {
        int line;
        std::vector<std::string> values;
    };
    std::size_t index(const std::string& column) const;

    std::string file_;
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
};

}  // namespace rigor::validation
