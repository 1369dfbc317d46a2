// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "cli/command.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "scenarios/model/printable.hpp"
#include "scenarios/model/time_step.hpp"
#include "validation/results/files.hpp"

namespace rigor::cli {

std::filesystem::path ownBinary() {
    return std::filesystem::read_symlink("/proc/self/exe");
}

std::string ownCommandLine() {
    std::ifstream in("/proc/self/cmdline", std::ios::binary);
    std::string text, argument;
    while (std::getline(in, argument, '\0')) {
        if (text.empty()) {
            text = scenario::programName();
            continue;
        }
        const bool plain =
            argument.find_first_of(" \t\n\"'\\$&|;<>()*?[]{}!#~`") == std::string::npos && !argument.empty();
        std::string quoted = "'";
        for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += " " + (plain ? argument : quoted + "'");
    }
    return text;
}

bool isTerminal(int fileDescriptor) {
    return isatty(fileDescriptor) == 1;
}

bool canRewriteLines(int fileDescriptor) {
    const char* term = std::getenv("TERM");
    return isTerminal(fileDescriptor) && (term == nullptr || std::string_view(term) != "dumb");
}

bool wantsColour(int fileDescriptor) {
    const char* noColour = std::getenv("NO_COLOR");
    return canRewriteLines(fileDescriptor) && (noColour == nullptr || *noColour == '\0');
}

int terminalColumns(int fileDescriptor) {
    winsize size{};
    if (ioctl(fileDescriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    return 120;
}

void say(const std::string& message) {
    std::fprintf(stderr, "rigor: %s\n", scenario::printable(message, scenario::Lines::Keep).c_str());
}

int withOutputWritten(int code) {
    errno = 0;
    const bool flushed = std::fflush(stdout) == 0;
    const int error = flushed ? 0 : errno;  // unknown if an earlier call has met it
    std::cout.flush();
    if (flushed && std::ferror(stdout) == 0 && std::cout.good()) return code;
    say(results::EnvironmentError("standard output", "cannot be written", error).what());
    return kEnvironment;
}

double parseTimeStep(const std::string& text) {
    const std::optional<double> dt = scenario::parseTimeStep(text);
    if (!dt)
        throw std::invalid_argument("--dt: found '" + text + "', expected seconds such as 0.004 or 1/240");
    if (!(*dt >= 1e-7 && *dt <= 1.0))
        throw std::invalid_argument("--dt: found '" + text + "', expected 1e-7 to 1 s");
    return *dt;
}

}  // namespace rigor::cli
