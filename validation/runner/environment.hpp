// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <map>
#include <string>

namespace rigor::validation {

/// What a timing needs beside it: processor, cores, kernel, system, compiler, flags, version, date.
std::map<std::string, std::string> describeEnvironment();

/// Now, UTC, "2026-01-31T12:00:00Z".
std::string isoTime();

}  // namespace rigor::validation
