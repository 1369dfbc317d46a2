// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/tests/shown_commands.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;

/// A command that runs the program, or one of those that prepare a file for it.
bool isCommand(const std::string& line) {
    static const std::regex pattern(R"(^([A-Z_]+=\S+ )*(\./rigor|sed) .*)");
    return std::regex_match(line, pattern);
}

std::string withoutNote(const std::string& line) {
    return line.substr(0, line.find("  #"));
}

}  // namespace

ShownCommands readShownCommands(const fs::path& document) {
    std::ifstream in(document);
    ShownCommands shown;
    std::string line, fence, body, fileName, part;
    while (std::getline(in, line)) {
        if (line.starts_with("```")) {
            if (fence == "json" && !fileName.empty()) shown.files.emplace_back(fileName, body);
            fence = fence.empty() ? line.substr(3) : "";
            body.clear();
            part.clear();
            if (fence.empty()) fileName.clear();
            continue;
        }
        if (fence == "exercise" && line.starts_with("--- ")) part = line.substr(4);
        const bool run = fence == "sh" || part == "answer" || part == "wrong";
        if (run && isCommand(line)) shown.commands.push_back({withoutNote(line), part != "wrong"});
        if (fence == "json") body += line + "\n";
        if (fence.empty() && line.starts_with("File `")) fileName = line.substr(6, line.find('`', 6) - 6);
    }
    return shown;
}

std::vector<ShownExercise> readShownExercises(const fs::path& document) {
    std::ifstream in(document);
    std::vector<ShownExercise> exercises;
    std::string line, part;
    bool inside = false, isJudged = false;
    while (std::getline(in, line)) {
        if (line.starts_with("```")) {
            inside = line == "```exercise";
            part.clear();
            isJudged = false;
        } else if (inside && line.starts_with("--- ")) {
            part = line.substr(4);
            if (part == "judge") exercises.emplace_back();
            isJudged |= part == "judge";
        } else if (isJudged && part != "solution" && isCommand(line)) {
            ShownExercise& exercise = exercises.back();
            (part == "judge"    ? exercise.judges
             : part == "answer" ? exercise.answers
                                : exercise.wrongs)
                .push_back(line);
        }
    }
    return exercises;
}

Ended runShownCommand(const fs::path& folder, const std::string& line) {
    const fs::path program = folder / "rigor", sources = RIGOR_SOURCE_DIR;
    if (!fs::exists(program)) fs::create_symlink(fs::path(RIGOR_BINARY_DIR) / "bin" / "rigor", program);
    for (const char* name : {"reports", "scenarios"})
        if (!fs::exists(folder / name)) fs::create_directory_symlink(sources / name, folder / name);
    // Servers run until they are interrupted.
    const bool serves = line.starts_with("./rigor view");
    const std::string whole = "cd '" + folder.string() + "' && " +
                              (serves ? "timeout --preserve-status -s INT 4 " : "") + line +
                              " > output.txt 2>&1";
    const int status = std::system(whole.c_str());
    std::ifstream output(folder / "output.txt");
    std::stringstream text;
    text << output.rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str().substr(0, 4000)};
}

}  // namespace rigor::cli_test
