// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of a bench to and from the structs of bench_types.hpp. The caller holds the transaction.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "validation/results/bench_types.hpp"
#include "validation/results/seals.hpp"

namespace rigor::results {

/// Tables of a bench, since schema 5.
extern const char* const kBenchTables;

/// Replaces settings and cases. Repetitions of cases that stay are kept, those of others are forgotten.
void writeBenchPlan(SQLite::Database& database, const Bench& bench);
/// Replaces the repetition of the same round.
void writeBenchRepetition(SQLite::Database& database, const std::string& caseId,
                          const BenchRepetition& repetition);
/// Replaces what is computed from the repetitions: summaries and changes.
void writeBenchAnalysis(SQLite::Database& database, const Bench& bench);

/// Without the damaged cases; without summaries and changes if one of these tables is damaged.
Bench readBench(SQLite::Database& database, const Damage& damage);

}  // namespace rigor::results
