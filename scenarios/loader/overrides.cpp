// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/overrides.hpp"

#include <algorithm>
#include <charconv>

namespace rigor::scenario {
namespace {

/// The element of an array that `token` names, by index or by "name".
template <class AnyJson>
AnyJson* element(AnyJson& array, const std::string& token) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
    if (error == std::errc{} && end == token.data() + token.size())
        return index < array.size() ? &array[index] : nullptr;
    for (auto& item : array)
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

/// The place of `accept.ENGINE.METRIC` in a file that has no bounds of the engine yet; null for other paths.
Json* newBound(Json& document, const std::string& path) {
    const std::size_t engine = std::string("accept.").size(), metric = path.find('.', engine);
    if (!document.is_object() || !path.starts_with("accept.") || metric == std::string::npos ||
        path.find('.', metric + 1) != std::string::npos)
        return nullptr;
    return &document["accept"][path.substr(engine, metric - engine)][path.substr(metric + 1)];
}

/// Names at the furthest place that `path` leads to: "names in bodies: floor, ball".
std::string furthest(const Json& document, const std::string& path) {
    const Json* at = &document;
    std::string where;
    for (std::size_t begin = 0; begin < path.size();) {
        const std::size_t dot = std::min(path.find('.', begin), path.size());
        const std::string token = path.substr(begin, dot - begin);
        const Json* next = at->is_array()                           ? element(*at, token)
                           : at->is_object() && at->contains(token) ? &(*at)[token]
                                                                    : nullptr;
        if (next == nullptr) break;
        at = next;
        where += (where.empty() ? "" : ".") + token;
        begin = dot + 1;
    }
    std::string known;
    const auto add = [&](const std::string& name) { known += (known.empty() ? "" : ", ") + name; };
    if (at->is_object())
        for (const auto& [key, value] : at->items()) add(key);
    else if (at->is_array())
        for (std::size_t i = 0; i < at->size(); ++i) {
            const Json& item = (*at)[i];
            add(item.is_object() && item.contains("name") && item["name"].is_string()
                    ? item["name"].get<std::string>()
                    : std::to_string(i));
        }
    if (known.empty()) return "no further step: " + (where.empty() ? "it" : where) + " is a value";
    return "one of " + known + (where.empty() ? "" : " in " + where);
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
    if (target == nullptr) target = newBound(document.value, key);
    if (target == nullptr)
        refuse("override.unknown", "'" + key + "'",
               furthest(document.value, key) +
                   "; a path is like bodies.block.velocity or materials.wood.friction");
    // Words need no quotes: --set reference=none. Text that opens a bracket or a quote is no word.
    if (parsed.is_discarded() && !value.empty() && std::string("[{\"").find(value[0]) != std::string::npos)
        refuse("override.value", key + "=" + value,
               "a JSON value after '=', like [3.1, 0, -0.2] (-.2 and 2. are no JSON numbers)");
    *target = parsed.is_discarded() ? Json(value) : parsed;
}

}  // namespace rigor::scenario
