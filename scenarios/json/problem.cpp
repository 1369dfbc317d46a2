// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/json/problem.hpp"

#include <utility>

#include "scenarios/model/printable.hpp"

namespace rigor::scenario {

std::string Problem::text() const {
    std::string text = file;
    if (line > 0) text += ":" + std::to_string(line);
    if (!pointer.empty())
        text += ": " + pointer;
    else if (line > 0)
        text += ": (document)";  // without a line there may be no document at all
    return printable(text + ": found " + found + ", expected " + expected + " [" + id + "]");
}

LoadError::LoadError(std::vector<Problem> problems)
    : std::runtime_error(problems.empty() ? "no problem" : problems.front().text()),
      problems_(std::move(problems)) {}

}  // namespace rigor::scenario
