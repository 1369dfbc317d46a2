// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Processes that a child started and that have left its process group (setsid, daemons).
#pragma once

#include <sys/types.h>

#include <string>

namespace rigor::validation {

/// Environment variable by which the descendants of a child are recognised: they inherit it, wherever they go.
inline constexpr const char* kAncestorVariable = "RIGOR_ANCESTOR";

/// Value of that variable: process ids of the parent and of the child. Its length is always the same, so that the
/// child can be written into the memory of an environment that is in use.
std::string ancestorMark(pid_t parent, pid_t child);

/// Writes the child into such a value. Safe between fork and exec.
void setMarkedChild(char* mark, pid_t child);

/// Makes processes whose parent died children of this process, and not of init.
void adoptOrphans();

/// Kills and collects the descendants of a child that has ended and whose process group has been killed.
void killDescendants(pid_t child);

}  // namespace rigor::validation
