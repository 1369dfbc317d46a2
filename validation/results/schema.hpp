// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Opening results.sqlite, and its schema. README.md describes every table for readers of the file with other
// tools.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace rigor::results {

/// Creates the tables in a new file. Throws SQLite::Exception.
SQLite::Database createDatabase(const std::filesystem::path& file);

/// Opens an existing store. Throws std::runtime_error naming the file when it is no store, damaged, or of a
/// newer schema. Opened for writing, an older one is brought up to date.
SQLite::Database openDatabase(const std::filesystem::path& file, bool forWriting);

/// Schema version in the open file: kSchemaVersion, or that of an older rigor.
int schemaVersionOf(SQLite::Database& database);

}  // namespace rigor::results
