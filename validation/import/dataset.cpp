// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/dataset.hpp"

#include <charconv>
#include <cmath>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using scenario::LoadError;

namespace {
constexpr double kUnitTolerance = 1e-3;  // tolerance of |q|
constexpr double kTimeTolerance = 0.01;  // tolerance as a fraction of a frame
}  // namespace

std::map<int, fs::path> numberedRecordings(const fs::path& from, const std::string& prefix,
                                           const std::string& inside, const std::string& other) {
    const std::string pattern = prefix + "_NNN.csv";
    const auto refuse = [&](const std::string& found) {
        throw LoadError({{"import.folder", from.string(), "", 0, found,
                          "a folder with " + pattern +
                              (inside.empty() ? std::string() : ", or with " + inside + "/ in it")}});
    };
    if (!fs::is_directory(from)) refuse("no folder");
    const fs::path folder = !inside.empty() && fs::is_directory(from / inside) ? from / inside : from;
    std::map<int, fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".csv" || !name.starts_with(prefix + "_")) continue;
        if (!other.empty() && name == prefix + "_" + other) continue;
        int id = -1;
        const char* digits = name.data() + prefix.size() + 1;
        const auto [end, error] = std::from_chars(digits, name.data() + name.size(), id);
        if (error != std::errc{} || end != name.data() + name.size() || id < 0)
            throw LoadError(
                {{"import.name", entry.path().string(), "", 0, "the name " + name, prefix + "_NNN"}});
        if (!files.emplace(id, entry.path()).second)
            throw LoadError({{"import.duplicate", entry.path().string(), "", 0,
                              prefix + " " + std::to_string(id) + " a second time", "each number once"}});
    }
    if (files.empty()) refuse("no " + pattern);
    return files;
}

std::string numberedName(const std::string& prefix, int number, std::size_t digits) {
    const std::string text = std::to_string(number);
    return prefix + "_" + std::string(text.size() < digits ? digits - text.size() : 0, '0') + text;
}

double steadyRate(const CsvTable& table) {
    const std::size_t last = table.size() - 1;
    const double first = table.number(0, "t"), rate = last / (table.number(last, "t") - first);
    for (std::size_t row = 0; row <= last; ++row) {
        const double place = (table.number(row, "t") - first) * rate;
        if (!(std::abs(place - row) <= kTimeTolerance))
            throw LoadError({table.problem("import.time", table.line(row), "t = " + table.text(row, "t"),
                                           "times that rise by the same step from line to line")});
    }
    return std::abs(rate - std::round(rate)) < 1e-3 * rate ? std::round(rate) : rate;
}

scenario::Vec3 vectorAt(const CsvTable& table, std::size_t row, const std::string& prefix) {
    return {table.number(row, prefix + "x"), table.number(row, prefix + "y"),
            table.number(row, prefix + "z")};
}

scenario::Quat unitQuaternionAt(const CsvTable& table, std::size_t row, const std::string& prefix) {
    const scenario::Quat q{table.number(row, prefix + "w"), table.number(row, prefix + "x"),
                           table.number(row, prefix + "y"), table.number(row, prefix + "z")};
    if (!(std::abs(norm(q) - 1.0) <= kUnitTolerance))
        throw LoadError({table.problem("import.quaternion", table.line(row),
                                       "a quaternion of length " + std::to_string(norm(q)), "length 1")});
    return normalized(q);
}

ordered_json toJson(const scenario::Vec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json toJson(const scenario::Quat& q) {
    return {q.w, q.x, q.y, q.z};
}

std::string scenarioText(ordered_json scenario) {
    std::vector<std::pair<std::string, std::string>> lists;
    for (auto& [key, value] : scenario["reference"]["measured_motion"].items())
        if (value.is_array() && !value.empty() && value.front().is_number()) {
            lists.emplace_back("\"<" + key + ">\"", value.dump());
            value = "<" + key + ">";
        }
    std::string text = scenario.dump(1);
    for (const auto& [mark, numbers] : lists) text.replace(text.find(mark), mark.size(), numbers);
    return text + "\n";
}

}  // namespace rigor::validation
