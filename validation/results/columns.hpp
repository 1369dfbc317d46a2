// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One C++ value to one SQLite column and back, without loss.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rigor::results {

inline constexpr const char* kNan = "nan";

/// Binds values to the parameters of a statement from left to right, then runs it.
class Binder {
  public:
    explicit Binder(SQLite::Statement& statement) : statement_(statement) { statement_.reset(); }

    Binder& operator<<(const std::string& text) {
        statement_.bind(next_++, text);
        return *this;
    }
    Binder& operator<<(const char* text) { return *this << std::string(text); }
    Binder& operator<<(std::int64_t value) {
        statement_.bind(next_++, value);
        return *this;
    }
    Binder& operator<<(int value) { return *this << static_cast<std::int64_t>(value); }
    Binder& operator<<(bool value) { return *this << static_cast<std::int64_t>(value); }
    Binder& operator<<(double value) {
        if (std::isnan(value))
            statement_.bind(next_++, kNan);
        else
            statement_.bind(next_++, value);
        return *this;
    }
    Binder& operator<<(const std::optional<double>& value) {
        if (value) return *this << *value;
        statement_.bind(next_++);
        return *this;
    }
    template <class T>
    Binder& operator<<(const std::vector<T>& list) {
        return *this << nlohmann::json(list).dump();
    }
    void run() { statement_.exec(); }

  private:
    SQLite::Statement& statement_;
    int next_ = 1;
};

/// Takes the columns of the current row from left to right.
class Taker {
  public:
    explicit Taker(SQLite::Statement& statement) : statement_(statement) {}

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
        const SQLite::Column column = statement_.getColumn(next_++);
        value = column.isText() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
        return *this;
    }
    Taker& operator>>(std::optional<double>& value) {
        if (statement_.getColumn(next_).isNull()) {
            value.reset();
            ++next_;
            return *this;
        }
        return *this >> value.emplace();
    }
    template <class T>
    Taker& operator>>(std::vector<T>& list) {
        std::string text;
        *this >> text;
        list = nlohmann::json::parse(text).get<std::vector<T>>();
        return *this;
    }

  private:
    SQLite::Statement& statement_;
    int next_ = 0;
};

}  // namespace rigor::results
