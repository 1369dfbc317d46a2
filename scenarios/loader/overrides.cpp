// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/overrides.hpp"

#include <charconv>

namespace rigor::scenario {
namespace {

/// The element of an array that `token` names, by index or by "name".
Json* element(Json& array, const std::string& token) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
    if (error == std::errc{} && end == token.data() + token.size())
        return index < array.size() ? &array[index] : nullptr;
    for (Json& item : array)
        if (item.is_object() && item.contains("name") && item["name"] == token) return &item;
    return nullptr;
}

/// Follows `path`; the last step may name a new key of an object. Null when it leads nowhere.
Json* locate(Json& at, const std::string& path) {
    if (path.empty()) return &at;
    for (std::size_t dot = path.size(); dot != std::string::npos && dot > 0; dot = path.rfind('.', dot - 1)) {
        const std::string token = path.substr(0, dot), rest = dot < path.size() ? path.substr(dot + 1) : "";
        Json* next = nullptr;
        if (at.is_array())
            next = element(at, token);
        else if (at.is_object() && at.contains(token))
            next = &at[token];
        if (next != nullptr)
            if (Json* found = locate(*next, rest)) return found;
    }
    if (at.is_object() && path.find('.') == std::string::npos) return &at[path];
    return nullptr;
}

}  // namespace

void applyOverride(JsonDocument& document, const std::string& text, const std::string& fileName) {
    const auto refuse = [&](const char* id, const std::string& found, const std::string& expected) {
        throw LoadError({{id, fileName, "", 0, "--set " + found, expected}});
    };
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) refuse("override.form", "'" + text + "'", "KEY=VALUE");
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    const Json parsed = Json::parse(value, nullptr, false);
    Json* target = locate(document.value, key);
    if (target == nullptr)
        refuse("override.unknown", "'" + key + "'",
               "a path such as bodies.block.velocity or materials.wood.friction");
    // Words need no quotes: --set reference=none.
    *target = parsed.is_discarded() ? Json(value) : parsed;
}

}  // namespace rigor::scenario
