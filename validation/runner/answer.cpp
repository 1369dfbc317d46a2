// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/answer.hpp"

#include <cerrno>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "validation/results/fields.hpp"
#include "validation/results/files.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using namespace results;

/// Appends every field of a record to an array.
struct SendFields {
    json& list;

    void operator()(const char*, double value, int = 1, const char* = nullptr) {
        list.push_back(numberToJson(value));
    }
    template <class T>
    void operator()(const char* column, const std::optional<T>& value, int = 1, const char* = nullptr) {
        if (value)
            (*this)(column, *value);
        else
            list.push_back(nullptr);
    }
    template <class T>
    void operator()(const char*, const T& value, int = 1, const char* = nullptr) {
        if constexpr (std::is_enum_v<T>)
            list.push_back(textOf(value));
        else
            list.push_back(value);
    }
};

/// Takes them from the array, in the same order.
struct ReceiveFields {
    const json& list;
    std::size_t next = 0;

    void operator()(const char*, double& value, int = 1, const char* = nullptr) {
        value = numberFromJson(list.at(next++));
    }
    template <class T>
    void operator()(const char* column, std::optional<T>& value, int = 1, const char* = nullptr) {
        if (!list.at(next).is_null()) {
            (*this)(column, value.emplace());
            return;
        }
        value.reset();
        ++next;
    }
    template <class T>
    void operator()(const char*, T& value, int = 1, const char* = nullptr) {
        if constexpr (std::is_enum_v<T>)
            fromText(list.at(next++).get<std::string>(), value);
        else
            value = list.at(next++).get<T>();
    }
};

template <class Row>
json recordToJson(const Row& row) {
    json list = json::array();
    eachField(row, SendFields{list});
    return list;
}
template <class Row>
Row recordFromJson(const json& list) {
    Row row{};
    eachField(row, ReceiveFields{list});
    return row;
}

}  // namespace

json numberToJson(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    return value;
}

nlohmann::json finiteToJson(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

double numberFromJson(const json& j) {
    if (!j.is_string()) return j.get<double>();
    const auto text = j.get<std::string>();
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf") return std::numeric_limits<double>::infinity();
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    throw std::runtime_error("result of a child: found '" + text + "', expected a number");
}

json auditToJson(const AuditRow& a) {
    return recordToJson(a);
}

AuditRow auditFromJson(const json& j) {
    return recordFromJson<AuditRow>(j);
}

json caseToJson(const CaseRow& c) {
    json out{{"case", recordToJson(c)}, {"settings", c.settings}};
    eachList(c, [&](const char* table, const auto& rows) {
        json& list = out[table] = json::array();
        for (const auto& row : rows) list.push_back(recordToJson(row));
    });
    return out;
}

CaseRow caseFromJson(const json& j) {
    CaseRow c = recordFromJson<CaseRow>(j.at("case"));
    c.settings = j.at("settings").get<std::map<std::string, std::string>>();
    eachList(c, [&](const char* table, auto& rows) {
        using Row = typename std::remove_reference_t<decltype(rows)>::value_type;
        for (const json& row : j.at(table)) rows.push_back(recordFromJson<Row>(row));
    });
    return c;
}

void writeJsonFile(const std::filesystem::path& file, const json& content) {
    results::replaceScratchFile(file, content.dump(-1, ' ', false, json::error_handler_t::replace));
}

std::optional<json> readJsonFile(const std::filesystem::path& file) {
    std::string text;
    try {
        text = results::readFile(file);
    } catch (const results::EnvironmentError& error) {
        if (error.code() == ENOENT) return std::nullopt;
        throw;
    }
    json content = json::parse(text, nullptr, false);
    if (content.is_discarded()) return std::nullopt;
    return content;
}

}  // namespace rigor::validation
