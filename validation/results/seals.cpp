// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/seals.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>

#include "validation/results/columns.hpp"

namespace rigor::results {
namespace {

constexpr const char* kTablesOfCases[] = {"settings",  "metrics", "quantities", "ledger",
                                          "read_back", "audit",   "timings"};
constexpr const char* kTablesOfHeader[] = {"run", "environment", "engines", "scenarios"};
constexpr const char* kTablesOfAnalysis[] = {"orders", "fairness"};

/// Checksum of rows: names, types and values of all columns, bit for bit. Readers take a column that is not there for one
/// of a newer schema, so that a damaged name counts.
class Checksum {
  public:
    void add(const void* bytes, std::size_t count) {
        sum_ = crc32_z(sum_, static_cast<const Bytef*>(bytes), count);
    }
    void addRows(SQLite::Statement& select) {
        for (int i = 0; i < select.getColumnCount(); ++i) {
            const char* name = select.getColumnName(i);
            add(name, std::strlen(name) + 1);
        }
        while (select.executeStep())
            for (int i = 0; i < select.getColumnCount(); ++i) addValue(select.getColumn(i));
    }
    std::int64_t value() const { return static_cast<std::int64_t>(sum_); }

  private:
    void addValue(const SQLite::Column& column) {
        const int type = column.getType();
        add(&type, sizeof type);
        if (column.isInteger()) {
            const std::int64_t value = column.getInt64();
            add(&value, sizeof value);
        } else if (column.isFloat()) {
            const double value = column.getDouble();
            add(&value, sizeof value);
        } else {
            const std::int64_t count = column.getBytes();
            add(&count, sizeof count);
            if (count > 0) add(column.getBlob(), static_cast<std::size_t>(count));
        }
    }
    uLong sum_ = 0;
};

/// The statements that read all rows of a case, prepared once.
class CaseReader {
  public:
    explicit CaseReader(SQLite::Database& database) {
        selects_.emplace_back(database, "SELECT * FROM cases WHERE id = ?");
        for (const char* table : kTablesOfCases)
            selects_.emplace_back(
                database, std::string("SELECT * FROM ") + table + " WHERE case_id = ? ORDER BY ordinal");
    }
    std::int64_t checksum(const std::string& id) {
        Checksum sum;
        for (SQLite::Statement& select : selects_) {
            select.reset();
            select.bind(1, id);
            sum.addRows(select);
        }
        return sum.value();
    }

  private:
    std::vector<SQLite::Statement> selects_;
};

std::int64_t checksumOfTable(SQLite::Database& database, const std::string& table) {
    SQLite::Statement select(database, "SELECT * FROM " + table + " ORDER BY 1");
    Checksum sum;
    sum.addRows(select);
    return sum.value();
}

void storeSeal(SQLite::Database& database, const std::string& name, std::int64_t sum) {
    SQLite::Statement insert(database, "INSERT OR REPLACE INTO seals VALUES (?, ?)");
    (Binder(insert) << name << sum).run();
}

template <std::size_t n>
void sealTables(SQLite::Database& database, const char* const (&tables)[n]) {
    for (const char* table : tables) storeSeal(database, table, checksumOfTable(database, table));
}

}  // namespace

void sealCase(SQLite::Database& database, const std::string& caseId) {
    storeSeal(database, caseId, CaseReader(database).checksum(caseId));
}

void sealCases(SQLite::Database& database, const std::set<std::string>& skipped) {
    CaseReader reader(database);
    for (const std::string& id : idsOfCases(database))
        if (!skipped.contains(id)) storeSeal(database, id, reader.checksum(id));
}

void sealHeader(SQLite::Database& database) {
    sealTables(database, kTablesOfHeader);
}

void sealAnalysis(SQLite::Database& database) {
    sealTables(database, kTablesOfAnalysis);
}

void removeSealsOfMissingCases(SQLite::Database& database) {
    std::string tables;
    for (const char* table : kTablesOfHeader) tables += std::string("'") + table + "', ";
    for (const char* table : kTablesOfAnalysis) tables += std::string("'") + table + "', ";
    database.exec("DELETE FROM seals WHERE name NOT IN (" + tables +
                  "'') AND name NOT IN (SELECT id FROM cases)");
}

Damage findDamage(SQLite::Database& database) {
    std::map<std::string, std::int64_t> expected;
    SQLite::Statement select(database, "SELECT name, crc32 FROM seals");
    while (select.executeStep()) expected[select.getColumn(0).getString()] = select.getColumn(1).getInt64();
    Damage damage;
    const auto checkTable = [&](const char* table) {
        const auto it = expected.find(table);
        if (it == expected.end() || it->second != checksumOfTable(database, table))
            damage.tables.push_back(table);
        if (it != expected.end()) expected.erase(it);
    };
    for (const char* table : kTablesOfHeader) checkTable(table);
    for (const char* table : kTablesOfAnalysis) checkTable(table);
    CaseReader reader(database);
    for (const std::string& id : idsOfCases(database)) {
        const auto it = expected.find(id);
        if (it == expected.end() || it->second != reader.checksum(id)) damage.cases.insert(id);
        if (it != expected.end()) expected.erase(it);
    }
    for (const auto& [id, sum] : expected) damage.cases.insert(id);
    return damage;
}

}  // namespace rigor::results
