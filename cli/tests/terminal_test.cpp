// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Output of `rigor validate` while it works and at its end: at a terminal, at one without colours, at one
// that can not take a line back, and through a pipe.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include "cli/tests/program.hpp"

namespace {

using rigor::cli_test::Result;
using rigor::cli_test::rigor;

constexpr int kColumns = 100;

/// True if this system has pseudo-terminals: a bare container may have none.
bool hasTerminals() {
    int terminal = -1, other = -1;
    if (openpty(&terminal, &other, nullptr, nullptr, nullptr) != 0) return false;
    close(terminal);
    close(other);
    return true;
}

/// The program with a terminal of kColumns columns as its input, output and error.
Result atTerminal(const std::string& arguments, const std::string& environment) {
    winsize size{};
    size.ws_row = 50;
    size.ws_col = kColumns;
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        const std::string command = environment + " exec " + RIGOR_BINARY_DIR "/bin/rigor " + arguments;
        execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    Result result;
    std::array<char, 4096> buffer;
    for (ssize_t n; (n = read(terminal, buffer.data(), buffer.size())) > 0;)
        result.out.append(buffer.data(), static_cast<std::size_t>(n));
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

std::string folder(const char* name) {
    const auto path = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(path);
    return path.string();
}

std::string validation(const std::string& folder) {
    return "validate bouncing_ball incline_slip free_flight slide_and_stop --engines rigor,ode --no-audit "
           "--out " +
           folder;
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

/// The table at the end: at most 40 lines, none wider than the terminal but the paths.
void expectTable(const std::string& text) {
    const auto start = text.find(" cases");
    ASSERT_NE(start, std::string::npos) << text;
    std::istringstream in(text.substr(text.rfind('\n', start) + 1));
    int lines = 0;
    for (std::string line; std::getline(in, line); ++lines) {
        std::string plain;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '\x1b')
                i = line.find_first_of("mK", i);
            else if ((static_cast<unsigned char>(line[i]) & 0xC0) != 0x80 && line[i] != '\r')
                plain += line[i];
        }
        if (line.find("Report: ") == std::string::npos && line.find("Replay: ") == std::string::npos) {
            EXPECT_LE(plain.size(), static_cast<std::size_t>(kColumns) + 20) << line;
        }
    }
    EXPECT_LE(lines, 40);
    EXPECT_NE(text.find("Who to trust for what"), std::string::npos);
    EXPECT_NE(text.find("Report: "), std::string::npos);
}

TEST(Terminal, ShowsALiveLineWithEtaAndColours) {
    if (!hasTerminals()) GTEST_SKIP() << "no pseudo-terminal can be opened here";
    const auto result = atTerminal(validation(folder("rigor-terminal")), "TERM=xterm");
    EXPECT_GT(count(result.out, "\r\x1b[K["), 4u) << "one line, written again and again";
    EXPECT_GT(count(result.out, "  ETA "), 2u);
    EXPECT_GT(count(result.out, "\x1b[3"), 2u) << "grades have colours";
    expectTable(result.out);
}

TEST(Terminal, NoColorLeavesTheLiveLine) {
    if (!hasTerminals()) GTEST_SKIP() << "no pseudo-terminal can be opened here";
    const auto result = atTerminal(validation(folder("rigor-no-color")), "NO_COLOR=1 TERM=xterm");
    EXPECT_GT(count(result.out, "\r\x1b[K["), 4u);
    EXPECT_EQ(count(result.out, "m✓"), 0u);
    EXPECT_EQ(count(result.out, "\x1b["), count(result.out, "\x1b[K")) << "nothing but clearing the line";
    expectTable(result.out);
}

TEST(Terminal, ADumbOneGetsPlainLines) {
    if (!hasTerminals()) GTEST_SKIP() << "no pseudo-terminal can be opened here";
    const auto result = atTerminal(validation(folder("rigor-dumb")), "TERM=dumb");
    EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
    EXPECT_GT(count(result.out, "  ETA "), 2u);
    expectTable(result.out);
}

TEST(Terminal, APipeGetsALineForEachCase) {
    const auto result = rigor(validation(folder("rigor-pipe")));
    EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(result.out.find('\r'), std::string::npos);
    std::size_t cases = 0, withEta = 0;
    std::istringstream in(result.out);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("[")) continue;
        ++cases;
        withEta += line.find("  ETA 0:") != std::string::npos;
    }
    EXPECT_GE(cases, 8u) << result.out;
    EXPECT_EQ(withEta, cases - 1) << "the last has nothing to wait for";
    expectTable(result.out);
}

}  // namespace
