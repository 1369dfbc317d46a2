// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ctrl-C ends a command where its work can be resumed.
#pragma once

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace rigor::cli {

/// Makes these signals set the flag that is returned, instead of ending the program.
const std::atomic<bool>& catchInterrupts(std::initializer_list<int> signals = {SIGINT, SIGTERM});

/// Makes them end the program again, where the work is stored and what follows can be done anew.
void releaseInterrupts(std::initializer_list<int> signals = {SIGINT, SIGTERM});

}  // namespace rigor::cli
