// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The formats that are read, and the packages that their readers are built with.
#pragma once

#include <string>
#include <vector>

namespace rigor::models {

struct Format {
    const char* name;      ///< "mjcf"
    const char* title;     ///< a line of the help
    const char* packages;  ///< Debian packages of its reader
};
const std::vector<Format>& formats();
/// Null for another word.
const Format* findFormat(const std::string& name);

}  // namespace rigor::models
