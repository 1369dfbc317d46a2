// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/tests/edited_store.hpp"

#include <sstream>

#include "validation/results/seals.hpp"

namespace rigor::results::sample {
namespace {

bool isChange(const std::string& statement) {
    for (const char* allowed : {"UPDATE ", "DELETE FROM ", "INSERT INTO "})
        if (statement.starts_with(allowed)) return true;
    return false;
}

}  // namespace

void takeBackLowerBounds(SQLite::Database& database) {
    database.exec("ALTER TABLE metrics DROP COLUMN bound_min");
}

void takeBackSharedLists(SQLite::Database& database) {
    takeBackLowerBounds(database);
    for (const std::string name : {"settings", "ledger", "read_back"}) {
        database.exec("CREATE TABLE own AS SELECT * FROM " + name);
        database.exec("DROP VIEW " + name);
        database.exec("ALTER TABLE own RENAME TO " + name);
        database.exec("DROP TABLE shared_" + name);
        database.exec("ALTER TABLE cases DROP COLUMN " + name + "_list");
    }
    database.exec("DELETE FROM seals WHERE name LIKE 'bench%'");
}

void removeChecksums(const std::filesystem::path& store) {
    SQLite::Database database(store.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA journal_mode = DELETE");
    takeBackSharedLists(database);
    database.exec("DROP TABLE seals; PRAGMA user_version = " + std::to_string(kFirstSchemaWithSeals - 1));
}

void changeStore(const std::filesystem::path& store, const std::string& statements) {
    SQLite::Database database(store.string(), SQLite::OPEN_READWRITE);
    std::istringstream lines(statements);
    for (std::string line; std::getline(lines, line);) {
        try {
            if (isChange(line)) (void)SQLite::Statement(database, line).exec();
        } catch (const SQLite::Exception&) {
            // A statement that means nothing changes nothing.
        }
    }
}

}  // namespace rigor::results::sample
