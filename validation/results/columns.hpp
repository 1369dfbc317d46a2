// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One C++ value to one SQLite column and back, without loss; records by the lists of fields.hpp.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "validation/results/fields.hpp"
#include "validation/results/values.hpp"

namespace rigor::results {

/// The column that says which numbers of a row are not finite. They themselves are NULL: SQLite has no NaN,
/// and a text among numbers makes a program that reads the column take all of it for text.
inline constexpr const char* kNonFiniteColumn = "non_finite";

/// Names of a table's columns, in their order.
inline std::vector<std::string> tableColumns(SQLite::Database& database, const std::string& table) {
    std::vector<std::string> names;
    SQLite::Statement info(database, "PRAGMA table_info(" + table + ")");
    while (info.executeStep()) names.push_back(info.getColumn(1).getString());
    return names;
}

inline constexpr const char* kBenchCases = "bench_cases";

inline std::vector<std::string> idsOfCases(SQLite::Database& database, const std::string& table = "cases") {
    std::vector<std::string> ids;
    SQLite::Statement select(database, "SELECT id FROM " + table);
    while (select.executeStep()) ids.push_back(select.getColumn(0).getString());
    return ids;
}

inline bool hasNonFiniteColumn(SQLite::Database& database, const std::string& table) {
    for (const std::string& name : tableColumns(database, table))
        if (name == kNonFiniteColumn) return true;
    return false;
}

/// The end of a list of columns to select: ", non_finite" where the table has it.
inline std::string nonFiniteOf(SQLite::Database& database, const std::string& table) {
    return hasNonFiniteColumn(database, table) ? std::string(", ") + kNonFiniteColumn : "";
}

inline std::string insertInto(const std::string& table, std::size_t columns) {
    std::string text = "INSERT INTO " + table + " VALUES (?";
    for (std::size_t i = 1; i < columns; ++i) text += ",?";
    return text + ")";
}

/// ", name, subject, ..." with what stands for the columns that a store of this schema does not have.
class ColumnList {
  public:
    explicit ColumnList(int schema) : schema_(schema) {}

    template <class T>
    void operator()(const char* column, const T&, int since = 1, const char* before = nullptr) {
        constexpr bool isText = std::is_same_v<T, std::string> || std::is_enum_v<T>;
        if (before == nullptr) before = isText ? "''" : "NULL";
        text += std::string(", ") + (schema_ >= since ? column : before);
    }
    std::string text;

  private:
    int schema_;
};

/// Binds values to the parameters of a statement from left to right, then runs it.
class Binder {
  public:
    explicit Binder(SQLite::Statement& statement) : statement_(statement) { statement_.reset(); }
    /// `names`: of the table's columns, all of which are bound but for kNonFiniteColumn, which binds itself.
    Binder(SQLite::Statement& statement, const std::vector<std::string>& names)
        : statement_(statement), names_(&names) {
        statement_.reset();
    }

    Binder& operator<<(const std::string& text) {
        statement_.bind(place(), text);
        return *this;
    }
    Binder& operator<<(const char* text) { return *this << std::string(text); }
    Binder& operator<<(std::int64_t value) {
        statement_.bind(place(), value);
        return *this;
    }
    Binder& operator<<(int value) { return *this << static_cast<std::int64_t>(value); }
    Binder& operator<<(bool value) { return *this << static_cast<std::int64_t>(value); }
    Binder& operator<<(double value) {
        const int at = place();
        if (std::isfinite(value)) {
            statement_.bind(at, value);
            return *this;
        }
        statement_.bind(at);
        if (names_ == nullptr) return *this;
        if (!nonFinite_.empty()) nonFinite_ += "; ";
        nonFinite_ += (*names_)[at - 1] + " is " + nonFiniteWords(value);
        return *this;
    }
    Binder& operator<<(const std::optional<double>& value) {
        if (value) return *this << *value;
        statement_.bind(place());
        return *this;
    }
    Binder& operator<<(const std::optional<std::int64_t>& value) {
        if (value) return *this << *value;
        statement_.bind(place());
        return *this;
    }
    template <class Enumeration>
    requires std::is_enum_v<Enumeration> Binder& operator<<(Enumeration value) {
        return *this << textOf(value);
    }
    template <class T>
    Binder& operator<<(const std::vector<T>& list) {
        return *this << nlohmann::json(list).dump();
    }
    void run() {
        if (isReason(next_)) reasonAt_ = next_;
        if (reasonAt_ > 0) statement_.bind(reasonAt_, nonFinite_);
        statement_.exec();
    }

  private:
    bool isReason(int at) const {
        const auto index = static_cast<std::size_t>(at - 1);
        return names_ != nullptr && index < names_->size() && (*names_)[index] == kNonFiniteColumn;
    }
    int place() {
        if (isReason(next_)) reasonAt_ = next_++;
        return next_++;
    }

    SQLite::Statement& statement_;
    const std::vector<std::string>* names_ = nullptr;
    std::string nonFinite_;
    int next_ = 1, reasonAt_ = 0;
};

/// Takes the columns of the current row from left to right. If the last one is kNonFiniteColumn, a NULL that
/// it names becomes the number it was. In stores of older schemas NaN is a text.
class Taker {
  public:
    explicit Taker(SQLite::Statement& statement) : statement_(statement) {
        const int last = statement_.getColumnCount() - 1;
        if (std::string(statement_.getColumnName(last)) == kNonFiniteColumn)
            nonFinite_ = statement_.getColumn(last).getString();
    }

    Taker& operator>>(std::string& text) {
        text = statement_.getColumn(next_++).getString();
        return *this;
    }
    Taker& operator>>(std::int64_t& value) {
        value = statement_.getColumn(next_++).getInt64();
        return *this;
    }
    Taker& operator>>(int& value) {
        value = statement_.getColumn(next_++).getInt();
        return *this;
    }
    Taker& operator>>(bool& value) {
        value = statement_.getColumn(next_++).getInt() != 0;
        return *this;
    }
    Taker& operator>>(double& value) {
        const SQLite::Column column = statement_.getColumn(next_);
        value = column.isText() || column.isNull() ? nonFiniteHere() : column.getDouble();
        ++next_;
        return *this;
    }
    Taker& operator>>(std::optional<double>& value) {
        if (statement_.getColumn(next_).isNull() && reasonHere().empty()) {
            value.reset();
            ++next_;
            return *this;
        }
        return *this >> value.emplace();
    }
    Taker& operator>>(std::optional<std::int64_t>& value) {
        if (!statement_.getColumn(next_).isNull()) return *this >> value.emplace();
        value.reset();
        ++next_;
        return *this;
    }
    template <class Enumeration>
    requires std::is_enum_v<Enumeration> Taker& operator>>(Enumeration& value) {
        std::string text;
        *this >> text;
        fromText(text, value);
        return *this;
    }
    template <class T>
    Taker& operator>>(std::vector<T>& list) {
        std::string text;
        *this >> text;
        list = nlohmann::json::parse(text).get<std::vector<T>>();
        return *this;
    }

  private:
    /// Text after "NAME is " of the current column; "" if it is not named.
    std::string reasonHere() const {
        const std::string begin = std::string(statement_.getColumnName(next_)) + " is ";
        const std::string all = "; " + nonFinite_;
        const auto at = all.find("; " + begin);
        if (at == std::string::npos) return "";
        const auto from = at + 2 + begin.size();
        return all.substr(from, all.find(';', from) - from);
    }
    double nonFiniteHere() const {
        for (const double value :
             {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            if (reasonHere() == nonFiniteWords(value)) return value;
        return std::numeric_limits<double>::quiet_NaN();
    }

    SQLite::Statement& statement_;
    std::string nonFinite_;
    int next_ = 0;
};

/// Binds every field of a record.
struct BindFields {
    Binder& binder;
    template <class T>
    void operator()(const char*, const T& value, int = 1, const char* = nullptr) {
        binder << value;
    }
};
/// Takes every field of a record.
struct TakeFields {
    Taker& taker;
    template <class T>
    void operator()(const char*, T& value, int = 1, const char* = nullptr) {
        taker >> value;
    }
};

}  // namespace rigor::results
