// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A child process of this program: it leads its own process group, has no core dump and no input, and dies
// with this process, however this process ends.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace rigor::validation {

inline constexpr std::size_t kOutputTailBytes = 4096;

bool isSanitized();  ///< this build: slower, and it reserves terabytes of addresses

/// Runs `arguments` (the first is the program's file) with stdout and stderr going to `output`. `memoryMiB`:
/// limit of its address space, 0: none; not set in sanitizer builds. `keepOpen`: files that it gets under the
/// same numbers. `variable`: an entry for its environment ("NAME=value"), or "". The child dies with the thread
/// that calls this. Throws results::EnvironmentError.
pid_t startProgram(const std::vector<std::string>& arguments, int output, std::size_t memoryMiB,
                   const std::vector<int>& keepOpen = {}, const std::string& variable = "");

/// The first steps of a child of `parent`: a process group of its own, its death with that of the parent, no core
/// dump, the limit of its address space (0: none). Safe between fork and exec.
void settleChild(pid_t parent, std::size_t memoryMiB);

/// Appends what is there to read of a child's output, of which the last few KiB are kept; false at its end.
bool drainOutput(int file, std::string& tail);

/// Last message of a child: the last line of its output that is not blank, or "".
std::string lastLine(const std::string& output);

/// "SIGSEGV (Segmentation fault)", "exit code 3" for a status as of waitpid.
std::string endingOf(int status);

}  // namespace rigor::validation
