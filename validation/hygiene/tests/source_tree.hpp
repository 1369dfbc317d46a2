// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The repository as the hygiene tests see it: paths relative to the root, build output and hidden folders
// left out.
#pragma once

#include <string>
#include <vector>

namespace rigor::hygiene {

/// Files whose names end in one of `endings`, sorted. An empty ending takes every file.
std::vector<std::string> sourceFiles(const std::vector<std::string>& endings);

std::string readFile(const std::string& relativePath);
bool exists(const std::string& relativePath);

/// True for letters, digits and underscores.
bool isWordCharacter(char c);

}  // namespace rigor::hygiene
