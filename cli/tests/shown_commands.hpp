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

/// An ```exercise fence of the handbook that a command judges.
struct ShownExercise {
    std::vector<std::string>
        judges;  ///< the first with a place in capitals that the reader fills in, or none
    std::vector<std::string> answers, wrongs;  ///< commands that end well, and commands that do not
};

/// Lines of ```sh fences that run `./rigor`, without their notes; ```json fences after a line "File `NAME`:"; of the
/// handbook's ```exercise fences the commands of "--- answer", and of "--- wrong", which do not end well.
ShownCommands readShownCommands(const std::filesystem::path& document);

/// The ```exercise fences with "--- judge"; those with "--- look" judge nothing.
std::vector<ShownExercise> readShownExercises(const std::filesystem::path& document);

struct Ended {
    int code = -1;  ///< exit code; -1: ended by a signal
    std::string output;
};

/// Runs a command in a folder, in which `./rigor` stands for the program as built. Servers are interrupted.
Ended runShownCommand(const std::filesystem::path& folder, const std::string& line);

}  // namespace rigor::cli_test
