// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Here is what the programs of this folder share. There are two: `rigor` has every command; `rigor-validate` has those
// that run scenarios and report, so that a first `./rigor validate` compiles no more than it needs.
#pragma once

#include <vector>

#include "cli/command.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {

using AddCommand = void (*)(CLI::App& app, Action& action);

struct Program {
    std::vector<AddCommand> commands;     ///< in the order of `--help`
    validation::ChildEntries children{};  ///< calls of the program by itself, beside those of the runner
};

/// Parses the command line and runs its command. Exceptions become messages. Returns the exit code.
int runProgram(int argc, char** argv, const Program& program);

}  // namespace rigor::cli
