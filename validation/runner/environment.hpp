// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <map>
#include <string>

namespace rigor::validation {

/// Environment of a timing: processor, cores, caches, how its clock is governed, load (mean number of running
/// processes in the minute before), kernel, system, compiler, flags, libraries, version, date.
std::map<std::string, std::string> describeEnvironment();

/// Now, UTC, "2026-01-31T12:00:00Z".
std::string isoTime();

}  // namespace rigor::validation
