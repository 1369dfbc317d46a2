// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "reports/tables/table.hpp"

namespace rigor::report {

/// The table of that name. Throws std::runtime_error if there is none.
inline const Table& named(const std::vector<Table>& tables, const std::string& name) {
    for (const Table& table : tables)
        if (table.name == name) return table;
    throw std::runtime_error("no table " + name);
}

}  // namespace rigor::report
