// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of the store to and from the structs of types.hpp.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <set>
#include <string>

#include "validation/results/seals.hpp"
#include "validation/results/types.hpp"

namespace rigor::results {

/// Replaces run, environment, engines and scenarios; the caller holds the transaction.
void writeHeaderRows(SQLite::Database& database, const Run& run);
/// Replaces the case and its rows; the caller holds the transaction.
void writeCaseRows(SQLite::Database& database, const CaseRow& row);
/// Replaces orders and fairness; the caller holds the transaction.
void writeAnalysisRows(SQLite::Database& database, const Run& run);

/// The rows that belong to the run as a whole, without its cases.
Run readHeaderRows(SQLite::Database& database);
/// The whole store, cases in the order of the plan, without what is damaged.
Run readRows(SQLite::Database& database, const Damage& damage = {});

}  // namespace rigor::results
