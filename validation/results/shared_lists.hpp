// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lists that many cases have alike, stored once: settings, ledger, read-back. The table shared_NAME has the rows of every
// distinct list, the column NAME_list of a case says which one is its own (NULL: none), and the view NAME has the rows of
// every case, as the table of that name had before schema 13.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>

#include "validation/results/types.hpp"

namespace rigor::results {

inline constexpr int kFirstSchemaWithSharedLists = 13;

/// The tables of the lists, and the views of them.
extern const char* const kSharedListTables;

/// The lists of one case, in the order of their columns.
struct SharedLists {
    std::optional<std::int64_t> settings, ledger, readBack;
};

/// Stores the lists of a case that are not there yet. To be called in the transaction that writes the case.
SharedLists storeSharedLists(SQLite::Database& database, const CaseRow& row);

/// Removes the lists that no case has any more.
void removeUnusedLists(SQLite::Database& database);

/// Makes shared lists of the tables of a store before schema 13, whose cases do not have the columns yet.
void shareLists(SQLite::Database& database);

}  // namespace rigor::results
