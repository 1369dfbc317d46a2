// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A bench as the report shows it: data of its section on the page, and tables.
#pragma once

#include "reports/encoding/json.hpp"
#include "reports/tables/table.hpp"

namespace rigor::report {

/// null for a run without a bench.
Json benchJson(const results::Run& run);

/// `bench`: a row for each case; `bench_phases`, `bench_quality`; `bench_changes` where there was a baseline.
std::vector<Table> benchTables(const ViewModel& view);

/// A section of the summary; "" without a bench.
std::string benchMarkdown(const results::Run& run);

}  // namespace rigor::report
