// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/spec_labels.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace rigor::results {
namespace {

constexpr std::size_t kLongest = 36;

struct Spec {
    std::string text, engine;
    std::vector<std::string> options;  ///< "key=value", in the order of the text
};

Spec parse(const std::string& text) {
    const auto colon = text.find(':');
    Spec spec{text, text.substr(0, colon), {}};
    std::istringstream rest(colon == std::string::npos ? "" : text.substr(colon + 1));
    for (std::string option; std::getline(rest, option, ',');) spec.options.push_back(option);
    return spec;
}

bool has(const Spec& spec, const std::string& option) {
    return std::find(spec.options.begin(), spec.options.end(), option) != spec.options.end();
}

bool isPreset(const std::string& option) {
    return option.rfind("preset=", 0) == 0;
}

/// "f32" says what it is of, "off" and "5" do not.
std::string inWords(const std::string& option) {
    static const std::set<std::string> unspoken{"on", "off", "true", "false", "none", "yes", "no"};
    const auto equals = option.find('=');
    const std::string value = equals == std::string::npos ? "" : option.substr(equals + 1);
    const bool word = !value.empty() && std::isalpha(static_cast<unsigned char>(value[0])) != 0;
    return word && !unspoken.contains(value) ? value : option;
}

/// Options that distinguish each spec of the list from the others.
class Differences {
  public:
    explicit Differences(const std::vector<Spec>& specs) : specs_(specs) {
        for (const Spec& spec : specs)
            for (const auto& option : spec.options)
                if (isPreset(option)) presets_.insert(option);
    }
    std::vector<std::string> of(const Spec& spec) const {
        std::vector<std::string> left;
        for (const auto& option : spec.options)
            if (!isShared(spec, option)) left.push_back(option);
        return left;
    }

  private:
    bool isShared(const Spec& spec, const std::string& option) const {
        const auto sameEngine = [&](const Spec& other) { return other.engine == spec.engine; };
        const bool several = std::count_if(specs_.begin(), specs_.end(), sameEngine) > 1;
        const bool allHaveIt = std::all_of(specs_.begin(), specs_.end(), [&](const Spec& other) {
            return !sameEngine(other) || has(other, option);
        });
        return (several && allHaveIt) ||
               (isPreset(option) && presets_.size() == 1 && !isListedWithout(spec, option));
    }
    bool isListedWithout(const Spec& spec, const std::string& option) const {
        auto rest = spec.options;
        std::erase(rest, option);
        return std::any_of(specs_.begin(), specs_.end(), [&](const Spec& other) {
            return other.engine == spec.engine && other.options == rest;
        });
    }

    const std::vector<Spec>& specs_;
    std::set<std::string> presets_;
};

std::string joined(const std::string& engine, const std::vector<std::string>& options, bool words) {
    std::string text = engine;
    for (const auto& option : options) text += " " + (words ? inWords(option) : option);
    return text;
}

}  // namespace

std::map<std::string, std::string> specLabels(const std::vector<std::string>& specs) {
    std::vector<Spec> list;
    for (const auto& text : specs)
        if (std::none_of(list.begin(), list.end(), [&](const Spec& spec) { return spec.text == text; }))
            list.push_back(parse(text));
    const Differences differences(list);
    std::map<std::string, int> used;  // the wordings of all, and how many have each
    for (const Spec& spec : list)
        for (const bool words : {true, false}) {
            const auto options = differences.of(spec);
            const std::string label = joined(spec.engine, options, words);
            if (words || label != joined(spec.engine, options, true)) ++used[label];
        }
    std::map<std::string, std::string> labels;
    std::map<std::string, int> numbers;  // numbers per engine
    for (const Spec& spec : list) {
        std::string label;
        for (const bool words : {false, true}) {  // words are used if they are unique
            const std::string candidate = joined(spec.engine, differences.of(spec), words);
            if (candidate.size() <= kLongest && used[candidate] == 1) label = candidate;
        }
        if (label.empty()) label = spec.engine + "[" + std::to_string(++numbers[spec.engine]) + "]";
        labels[spec.text] = label;
    }
    return labels;
}

}  // namespace rigor::results
