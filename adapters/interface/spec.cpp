// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Grammar:  list = spec { "," spec } ;  spec = engine [ ":" option { "," option } ] ;  option = key "=" value
#include <algorithm>
#include <charconv>
#include <cmath>

#include "adapters/interface/presets.hpp"
#include "adapters/interface/registry.hpp"
#include "scenarios/model/nearest.hpp"

namespace rigor::adapter {
namespace {

bool isName(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

void addOption(EngineSpec& spec, const std::string& text) {
    const auto eq = text.find('=');
    const std::string key = text.substr(0, eq);
    const std::string value = eq == std::string::npos ? "" : text.substr(eq + 1);
    if (!isName(key) || value.empty())
        throw BadInput("engine spec '" + spec.engine + "': found '" + text + "', expected key=value");
    if (!spec.options.emplace(key, value).second)
        throw BadInput("engine spec '" + spec.engine + "': key '" + key + "' is given twice");
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = text.find(separator); end != std::string::npos;
         end = text.find(separator, begin)) {
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    parts.push_back(text.substr(begin));
    return parts;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

void checkValue(const std::string& engine, const Option& option, const std::string& value) {
    const std::string where =
        "engine '" + engine + "', key '" + option.key + "': found '" + value + "', expected ";
    if (!option.values.empty()) {
        if (std::find(option.values.begin(), option.values.end(), value) == option.values.end())
            throw BadInput(where + "one of " + joined(option.values) +
                           scenario::didYouMean(value, option.values));
        return;
    }
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool parsed = error == std::errc{} && end == value.data() + value.size() && std::isfinite(number);
    if (!parsed || (option.integer && number != std::floor(number)))
        throw BadInput(where + (option.integer ? "an integer" : "a number"));
    if (number < option.min || number > option.max)
        throw BadInput(where + "a value from " + std::to_string(option.min) + " to " +
                       std::to_string(option.max));
}

}  // namespace

std::string EngineSpec::text() const {
    std::string text = engine;
    char separator = ':';
    for (const auto& [key, value] : options) {
        text += separator + key + '=' + value;
        separator = ',';
    }
    return text;
}

std::string EngineSpec::preset() const {
    const auto it = options.find("preset");
    return it == options.end() ? "default" : it->second;
}

EngineSpec parseSpec(const std::string& text) {
    EngineSpec spec;
    const auto colon = text.find(':');
    spec.engine = text.substr(0, colon);
    if (!isName(spec.engine))
        throw BadInput("engine spec: found '" + text + "', expected engine[:key=value,...]");
    if (colon == std::string::npos) return spec;
    for (const auto& part : split(text.substr(colon + 1), ',')) addOption(spec, part);
    return spec;
}

std::vector<EngineSpec> parseSpecList(const std::string& text) {
    std::vector<EngineSpec> specs;
    for (const auto& part : split(text, ',')) {
        const bool continues = part.find(':') == std::string::npos && part.find('=') != std::string::npos;
        if (continues && !specs.empty())
            addOption(specs.back(), part);
        else
            specs.push_back(parseSpec(part));
    }
    return specs;
}

Settings resolveSettings(const EngineSpec& spec, const Engine& engine) {
    const std::string preset = spec.preset();
    const auto own = ownPresets(engine);
    const auto presets = presetNames(own);
    if (std::find(presets.begin(), presets.end(), preset) == presets.end())
        throw BadInput("engine '" + spec.engine + "', key 'preset': found '" + preset +
                       "', expected one of " + joined(presets) + scenario::didYouMean(preset, presets));
    const auto options = engine.options();
    Settings settings{{"preset", preset}, {"precision", engine.info().precision}};
    for (const auto& option : options) settings[option.key] = presetValue(option, preset, own);
    for (const auto& [key, value] : spec.options) {
        if (key == "preset") continue;
        const auto option = std::find_if(options.begin(), options.end(),
                                         [&key = key](const Option& o) { return o.key == key; });
        if (option == options.end() && key == "precision") {
            if (value != "f32" && value != "f64")
                throw BadInput("engine '" + spec.engine + "', key 'precision': found '" + value +
                               "', expected one of f32, f64" + scenario::didYouMean(value, {"f32", "f64"}));
            settings[key] = value;
            continue;
        }
        if (option == options.end()) {
            std::vector<std::string> known{"preset", "precision"};
            for (const auto& o : options)
                if (o.key != "precision") known.push_back(o.key);
            throw BadInput("engine '" + spec.engine + "': unknown key '" + key + "', expected one of " +
                           joined(known) + scenario::didYouMean(key, known));
        }
        checkValue(spec.engine, *option, value);
        settings[key] = value;
    }
    return settings;
}

}  // namespace rigor::adapter
