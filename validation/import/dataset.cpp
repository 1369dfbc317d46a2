// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/dataset.hpp"

#include <charconv>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using scenario::LoadError;

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
