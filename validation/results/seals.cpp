// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/seals.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>

#include "validation/results/columns.hpp"
#include "validation/results/schema.hpp"

namespace rigor::results {
namespace {

constexpr const char* kTablesOfCases[] = {"settings",  "metrics", "quantities", "ledger",
                                          "read_back", "audit",   "timings"};
constexpr const char* kTablesOfHeader[] = {"run", "environment", "engines", "scenarios"};
constexpr const char* kTablesOfAnalysis[] = {"orders", "fairness"};
constexpr const char* kTablesOfBench[] = {kBenchSettings};
constexpr const char* kTablesOfBenchAnalysis[] = {kBenchSummaries, kBenchChanges};
constexpr const char* kBenchCase =
    "bench case ";  ///< the seal of a case of a bench has this before the case's id

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
    CaseReader(SQLite::Database& database, const std::vector<std::string>& selects) {
        for (const std::string& select : selects) selects_.emplace_back(database, select);
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

CaseReader readerOfCases(SQLite::Database& database) {
    std::vector<std::string> selects{"SELECT * FROM cases WHERE id = ?"};
    for (const char* table : kTablesOfCases)
        selects.push_back(std::string("SELECT * FROM ") + table + " WHERE case_id = ? ORDER BY ordinal");
    return {database, selects};
}

CaseReader readerOfBenchCases(SQLite::Database& database) {
    return {database,
            {"SELECT * FROM bench_cases WHERE id = ?",
             "SELECT * FROM bench_repetitions WHERE case_id = ? ORDER BY round",
             "SELECT * FROM bench_values WHERE case_id = ? ORDER BY round, ordinal"}};
}

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

/// The checksums in the store that are still to be compared.
class Expected {
  public:
    explicit Expected(SQLite::Database& database) {
        SQLite::Statement select(database, "SELECT name, crc32 FROM seals");
        while (select.executeStep()) sums_[select.getColumn(0).getString()] = select.getColumn(1).getInt64();
    }
    /// True if the checksum of that name is there and is `sum`; it is not compared again.
    bool fits(const std::string& name, std::int64_t sum) {
        const auto it = sums_.find(name);
        if (it == sums_.end()) return false;
        const bool isSame = it->second == sum;
        sums_.erase(it);
        return isSame;
    }
    const std::map<std::string, std::int64_t>& rest() const { return sums_; }

  private:
    std::map<std::string, std::int64_t> sums_;
};

}  // namespace

void sealCase(SQLite::Database& database, const std::string& caseId) {
    storeSeal(database, caseId, readerOfCases(database).checksum(caseId));
}

void sealCases(SQLite::Database& database, const std::set<std::string>& skipped) {
    CaseReader reader = readerOfCases(database);
    for (const std::string& id : idsOfCases(database))
        if (!skipped.contains(id)) storeSeal(database, id, reader.checksum(id));
}

void sealHeader(SQLite::Database& database) {
    sealTables(database, kTablesOfHeader);
}

void sealAnalysis(SQLite::Database& database) {
    sealTables(database, kTablesOfAnalysis);
}

void sealBenchCase(SQLite::Database& database, const std::string& caseId) {
    storeSeal(database, kBenchCase + caseId, readerOfBenchCases(database).checksum(caseId));
}

void sealBenchPlan(SQLite::Database& database) {
    sealTables(database, kTablesOfBench);
    CaseReader reader = readerOfBenchCases(database);
    for (const std::string& id : idsOfCases(database, kBenchCases))
        storeSeal(database, kBenchCase + id, reader.checksum(id));
}

void sealBenchAnalysis(SQLite::Database& database) {
    sealTables(database, kTablesOfBenchAnalysis);
}

void removeSealsOfMissingCases(SQLite::Database& database) {
    std::set<std::string> kept;
    for (const char* table : kTablesOfHeader) kept.insert(table);
    for (const char* table : kTablesOfAnalysis) kept.insert(table);
    for (const char* table : kTablesOfBench) kept.insert(table);
    for (const char* table : kTablesOfBenchAnalysis) kept.insert(table);
    for (const std::string& id : idsOfCases(database)) kept.insert(id);
    for (const std::string& id : idsOfCases(database, kBenchCases)) kept.insert(kBenchCase + id);
    const Expected present(database);
    SQLite::Statement forget(database, "DELETE FROM seals WHERE name = ?");
    for (const auto& [name, sum] : present.rest())
        if (!kept.contains(name)) (Binder(forget) << name).run();
}

Damage findDamage(SQLite::Database& database) {
    Expected expected(database);
    Damage damage;
    const auto checkTables = [&](const auto& tables) {
        for (const char* table : tables)
            if (!expected.fits(table, checksumOfTable(database, table))) damage.tables.insert(table);
    };
    checkTables(kTablesOfHeader);
    checkTables(kTablesOfAnalysis);
    CaseReader cases = readerOfCases(database);
    for (const std::string& id : idsOfCases(database))
        if (!expected.fits(id, cases.checksum(id))) damage.cases.insert(id);
    if (schemaVersionOf(database) >= kFirstSchemaWithBenchSeals) {
        checkTables(kTablesOfBench);
        checkTables(kTablesOfBenchAnalysis);
        CaseReader benchCases = readerOfBenchCases(database);
        for (const std::string& id : idsOfCases(database, kBenchCases))
            if (!expected.fits(kBenchCase + id, benchCases.checksum(id))) damage.benchCases.insert(id);
    }
    for (const auto& [name, sum] : expected.rest())
        if (name.starts_with(kBenchCase))
            damage.benchCases.insert(name.substr(std::strlen(kBenchCase)));
        else
            damage.cases.insert(name);
    return damage;
}

}  // namespace rigor::results
