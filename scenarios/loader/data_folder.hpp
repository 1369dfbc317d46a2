// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The folder share/rigor: scenarios, schemas, and the templates of `rigor new`. In a build folder it has links into the
// source tree (cmake/RigorInstall.cmake).
#pragma once

#include <filesystem>
#include <string>

namespace rigor::scenario {

/// The folder share/rigor nearest above the file that holds this code: the program, or the module of Python. A moved
/// installation thus finds its own data. An empty path if there is none.
std::filesystem::path dataFolder();

/// File or folder of the source tree that `rigor new` copies from; `path` as in the tree.
std::filesystem::path templateFile(const std::filesystem::path& path);

/// The source tree that this program was built from; empty for an installed program.
std::filesystem::path sourceFolder();

/// The command that starts this program: the launcher of the source tree, or, installed, the program itself.
std::string programName();

}  // namespace rigor::scenario
