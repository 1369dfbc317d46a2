// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Look-up in the tables that are made from .def files: metrics, scales, symmetries, importers. Such a file is
// included twice, once with a macro that declares the functions of a line and once with one that makes the
// line an entry. The macros differ from table to table, because their lines do, and no macro can contain an
// #include; the queries of a table are the same for all and are here.
#pragma once

#include <string>
#include <vector>

namespace rigor::validation {

/// The entry whose name is `name`, or null. `key` is the member that holds the name.
template <class Entry, class Key = decltype(&Entry::name)>
const Entry* findEntry(const std::vector<Entry>& table, const std::string& name, Key key = &Entry::name) {
    for (const Entry& entry : table)
        if (name == entry.*key) return &entry;
    return nullptr;
}

/// The names of a table in its order, separated by ", ", for messages.
template <class Entry>
std::string namesOf(const std::vector<Entry>& table) {
    std::string names;
    for (const Entry& entry : table) names += (names.empty() ? "" : ", ") + std::string(entry.name);
    return names;
}

}  // namespace rigor::validation
