// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checksums of what is in results.sqlite: SQLite notices a broken structure, but not a changed value. The table `seals`
// has one row per case (over its rows in every table), one per case of a bench, and one per table that belongs to the whole
// run.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>

namespace rigor::results {

inline constexpr int kFirstSchemaWithSeals = 12;
inline constexpr int kFirstSchemaWithBenchSeals = 14;
inline constexpr const char* kBenchSettings = "bench_settings";
inline constexpr const char* kBenchSummaries = "bench_summaries";
inline constexpr const char* kBenchChanges = "bench_changes";

/// Table of the checksums.
inline constexpr const char* kSealsTable =
    "CREATE TABLE seals (name TEXT PRIMARY KEY, crc32 INTEGER) WITHOUT ROWID;";

/// To be called in the transaction that has written the rows.
void sealCase(SQLite::Database& database, const std::string& caseId);
/// Every case but those that are `skipped`.
void sealCases(SQLite::Database& database, const std::set<std::string>& skipped);
void sealHeader(SQLite::Database& database);
void sealAnalysis(SQLite::Database& database);
/// One case of a bench, with its repetitions.
void sealBenchCase(SQLite::Database& database, const std::string& caseId);
/// The settings of a bench and all of its cases.
void sealBenchPlan(SQLite::Database& database);
void sealBenchAnalysis(SQLite::Database& database);
void removeSealsOfMissingCases(SQLite::Database& database);

struct Damage {
    std::set<std::string> cases;       ///< ids whose rows do not fit their checksum, or are not there
    std::set<std::string> benchCases;  ///< the same of the cases of a bench
    std::set<std::string> tables;      ///< tables of the whole run that do not fit theirs

    bool hits(std::initializer_list<const char*> names) const {
        return std::any_of(names.begin(), names.end(),
                           [&](const char* name) { return tables.contains(name); });
    }
};
Damage findDamage(SQLite::Database& database);

}  // namespace rigor::results
