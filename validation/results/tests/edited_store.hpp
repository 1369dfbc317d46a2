// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stores whose content is changed from outside.
#pragma once

#include <filesystem>
#include <string>

namespace rigor::results::sample {

/// Makes a store one of the last schema without checksums, so that changed values reach the readers of their columns.
void removeChecksums(const std::filesystem::path& store);

/// Runs the lines of `statements` that begin with UPDATE, DELETE FROM or INSERT INTO; those that mean nothing change nothing.
void changeStore(const std::filesystem::path& store, const std::string& statements);

}  // namespace rigor::results::sample
