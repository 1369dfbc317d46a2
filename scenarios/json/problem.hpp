// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Problems of a file: a list of them, and the exception that carries it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rigor::scenario {

/// One error in a file.
struct Problem {
    std::string id;  ///< stable: "schema.type", "reference.unknown_body", ...
    std::string file;
    std::string pointer;  ///< JSON pointer to the value, "" the whole document
    int line = 0;         ///< 1-based; 0 unknown
    std::string found, expected;
    /// "file:line: pointer: found X, expected Y [id]"; "(document)" stands for an empty pointer, and neither is
    /// there where the line is unknown, too.
    std::string text() const;
};

class LoadError : public std::runtime_error {
  public:
    explicit LoadError(std::vector<Problem> problems);
    const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
};

}  // namespace rigor::scenario
