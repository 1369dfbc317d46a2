// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stores whose content is changed from outside.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>

namespace rigor::results::sample {

/// Gives a store the tables of schema 14, in which metrics have no lower bounds.
void takeBackLowerBounds(SQLite::Database& database);

/// Gives a store the tables of schema 12, in which every case has its settings, ledger and read-back to itself.
void takeBackSharedLists(SQLite::Database& database);

/// Makes a store one of the last schema without checksums, so that changed values reach the readers of their columns.
void removeChecksums(const std::filesystem::path& store);

/// Runs the lines of `statements` that begin with UPDATE, DELETE FROM or INSERT INTO; those that mean nothing change nothing.
void changeStore(const std::filesystem::path& store, const std::string& statements);

}  // namespace rigor::results::sample
