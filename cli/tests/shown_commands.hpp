// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Commands that a document shows, and files that the reader is to write; run as a reader would.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rigor::cli_test {

/// A command and whether it ends well.
struct ShownCommand {
    std::string line;
    bool endsWell = true;  ///< exit code 0; false: any other
};

struct ShownCommands {
    std::vector<ShownCommand> commands;                      ///< in the order of the document
    std::vector<std::pair<std::string, std::string>> files;  ///< name and content
};

/// Lines of ```sh fences that run `./rigor`, without their notes; ```json fences after a line "File `NAME`:"; of the
/// handbook's ```exercise fences the commands of "--- answer", and of "--- wrong", which do not end well.
ShownCommands readShownCommands(const std::filesystem::path& document);

struct Ended {
    bool well = false;  ///< exit code 0
    std::string output;
};

/// Runs a command in a folder, in which `./rigor` stands for the program as built. Servers are interrupted.
Ended runShownCommand(const std::filesystem::path& folder, const std::string& line);

}  // namespace rigor::cli_test
