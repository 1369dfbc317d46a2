// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checksums of what is in results.sqlite: SQLite notices a broken structure, but not a changed value. The table `seals`
// has one row per case (over its rows in every table) and one per table that belongs to the whole run.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <set>
#include <string>
#include <vector>

namespace rigor::results {

inline constexpr int kFirstSchemaWithSeals = 12;
/// Table of the checksums.
inline constexpr const char* kSealsTable =
    "CREATE TABLE seals (name TEXT PRIMARY KEY, crc32 INTEGER) WITHOUT ROWID;";

/// To be called in the transaction that has written the rows.
void sealCase(SQLite::Database& database, const std::string& caseId);
/// Every case but those that are `skipped`.
void sealCases(SQLite::Database& database, const std::set<std::string>& skipped);
void sealHeader(SQLite::Database& database);
void sealAnalysis(SQLite::Database& database);
void removeSealsOfMissingCases(SQLite::Database& database);

struct Damage {
    std::set<std::string> cases;      ///< ids whose rows do not fit their checksum, or are not there
    std::vector<std::string> tables;  ///< tables of the whole run that do not fit theirs
};
Damage findDamage(SQLite::Database& database);

}  // namespace rigor::results
