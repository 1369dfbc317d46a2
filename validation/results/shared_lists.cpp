// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/shared_lists.hpp"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "validation/results/columns.hpp"
#include "validation/results/store.hpp"

namespace rigor::results {
namespace {

constexpr const char* kSharedNames[] = {"settings", "ledger", "read_back"};

/// Bytes that are equal for equal lists alone. Every NaN is the same: the store keeps no other.
class Content {
  public:
    template <class Row>
    explicit Content(const std::vector<Row>& rows) {
        for (const Row& row : rows) eachField(row, *this);
    }
    template <class T>
    void operator()(const char*, const T& value, int = 1, const char* = nullptr) {
        add(value);
    }
    const std::string& bytes() const { return bytes_; }
    std::int64_t checksum() const {
        return static_cast<std::int64_t>(
            crc32_z(0, reinterpret_cast<const Bytef*>(bytes_.data()), bytes_.size()));
    }

  private:
    void add(const std::string& text) {
        add(static_cast<double>(text.size()));
        bytes_ += text;
    }
    void add(bool value) { bytes_ += value ? '1' : '0'; }
    void add(double value) {
        if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();
        const auto bits = std::bit_cast<std::uint64_t>(value);
        bytes_.append(reinterpret_cast<const char*>(&bits), sizeof bits);
    }
    std::string bytes_;
};

/// Rows of `table` where `key` has a value, in their order.
template <class Row, class Value>
std::vector<Row> rowsWhere(SQLite::Database& database, const std::string& table, const char* key,
                           const Value& value) {
    ColumnList columns(kSchemaVersion);
    const Row like{};
    eachField(like, columns);
    SQLite::Statement select(database, "SELECT " + columns.text.substr(2) + nonFiniteOf(database, table) +
                                           " FROM " + table + " WHERE " + key + " = ? ORDER BY ordinal");
    select.bind(1, value);
    std::vector<Row> rows;
    while (select.executeStep()) {
        Taker taker(select);
        eachField(rows.emplace_back(), TakeFields{taker});
    }
    return rows;
}

template <class Row>
void insertList(SQLite::Database& database, const std::string& table, std::int64_t list,
                const std::vector<Row>& rows) {
    const auto names = tableColumns(database, table);
    SQLite::Statement insert(database, insertInto(table, names.size()));
    int ordinal = 0;
    for (const Row& row : rows) {
        Binder binder(insert, names);
        binder << list << ordinal++;
        eachField(row, BindFields{binder});
        binder.run();
    }
}

/// The number of a list is the checksum of its content, or the next one that no other content has.
template <class Row>
std::optional<std::int64_t> numberOf(SQLite::Database& database, const char* name,
                                     const std::vector<Row>& rows) {
    if (rows.empty()) return std::nullopt;
    const std::string table = std::string("shared_") + name;
    const Content content(rows);
    for (std::int64_t list = content.checksum();; ++list) {
        const auto present = rowsWhere<Row>(database, table, "list", list);
        if (present.empty()) insertList(database, table, list, rows);
        if (present.empty() || Content(present).bytes() == content.bytes()) return list;
    }
}

}  // namespace

const char* const kSharedListTables = R"sql(
CREATE TABLE shared_settings (
    list INTEGER, ordinal INTEGER, key TEXT, value TEXT, PRIMARY KEY (list, ordinal)) WITHOUT ROWID;
CREATE TABLE shared_ledger (
    list INTEGER, ordinal INTEGER, topic TEXT, requested TEXT, resolved TEXT, realisation TEXT, reason TEXT,
    PRIMARY KEY (list, ordinal)) WITHOUT ROWID;
CREATE TABLE shared_read_back (
    list INTEGER, ordinal INTEGER, quantity TEXT, subject TEXT, expected, found, error, ok INTEGER,
    non_finite TEXT, PRIMARY KEY (list, ordinal)) WITHOUT ROWID;
CREATE VIEW settings AS
    SELECT cases.id AS case_id, s.ordinal AS ordinal, s.key AS key, s.value AS value
    FROM cases CROSS JOIN shared_settings AS s ON s.list = cases.settings_list;
CREATE VIEW ledger AS
    SELECT cases.id AS case_id, s.ordinal AS ordinal, s.topic AS topic, s.requested AS requested,
        s.resolved AS resolved, s.realisation AS realisation, s.reason AS reason
    FROM cases CROSS JOIN shared_ledger AS s ON s.list = cases.ledger_list;
CREATE VIEW read_back AS
    SELECT cases.id AS case_id, s.ordinal AS ordinal, s.quantity AS quantity, s.subject AS subject,
        s.expected AS expected, s.found AS found, s.error AS error, s.ok AS ok, s.non_finite AS non_finite
    FROM cases CROSS JOIN shared_read_back AS s ON s.list = cases.read_back_list;
)sql";

SharedLists storeSharedLists(SQLite::Database& database, const CaseRow& row) {
    std::vector<SettingRow> settings;
    for (const auto& [key, value] : row.settings) settings.push_back({key, value});
    return {numberOf(database, "settings", settings), numberOf(database, "ledger", row.ledger),
            numberOf(database, "read_back", row.readBack)};
}

void removeUnusedLists(SQLite::Database& database) {
    for (const std::string name : kSharedNames)
        database.exec("DELETE FROM shared_" + name + " WHERE list NOT IN (SELECT " + name +
                      "_list FROM cases WHERE " + name + "_list IS NOT NULL)");
}

void shareLists(SQLite::Database& database) {
    for (const std::string name : kSharedNames) {
        database.exec("ALTER TABLE " + name + " RENAME TO own_" + name);
        database.exec("ALTER TABLE cases ADD COLUMN " + name + "_list INTEGER");
    }
    database.exec(kSharedListTables);
    SQLite::Statement update(
        database, "UPDATE cases SET settings_list = ?, ledger_list = ?, read_back_list = ? WHERE id = ?");
    for (const std::string& id : idsOfCases(database)) {
        const auto settings = rowsWhere<SettingRow>(database, "own_settings", "case_id", id);
        const auto ledger = rowsWhere<LedgerRow>(database, "own_ledger", "case_id", id);
        const auto readBack = rowsWhere<ReadBackRow>(database, "own_read_back", "case_id", id);
        (Binder(update) << numberOf(database, "settings", settings) << numberOf(database, "ledger", ledger)
                        << numberOf(database, "read_back", readBack) << id)
            .run();
    }
    for (const std::string name : kSharedNames) database.exec("DROP TABLE own_" + name);
}

}  // namespace rigor::results
