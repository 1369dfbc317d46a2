// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor completion`: the completion of bash, answered by the program from the definitions of its own commands and from
// what is installed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "adapters/interface/registry.hpp"
#include "cli/command.hpp"
#include "scenarios/loader/collision_cases.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/study.hpp"

namespace rigor::cli {
namespace {

constexpr const char* kBashScript =
    R"script(# Completion of rigor for bash: source it, or install it as share/bash-completion/completions/rigor.
_rigor() {
    local IFS=$'\n'
    COMPREPLY=($("$1" completion -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _rigor rigor rigor-validate
)script";

using Names = std::vector<std::string>;

Names namesOf(const std::vector<scenario::LibraryEntry>& entries) {
    Names names;
    for (const auto& entry : entries) names.push_back(entry.name);
    return names;
}

/// Names of one kind that a value may be (command.hpp).
Names namesOfKind(const std::string& kind) {
    if (kind == kEngineNames) return adapter::availableEngines();
    if (kind == kSuiteNames) return namesOf(scenario::listSuites());
    if (kind == kStudyNames) return namesOf(scenario::listStudies());
    if (kind == kCollisionNames) return namesOf(scenario::listCollisionFiles());
    Names names = namesOf(scenario::listScenarios());
    for (const std::string& name : namesOf(scenario::listBenchScenarios())) names.push_back(name);
    return names;
}

/// The values that CLI::IsMember lists in the type of an option: "TEXT:{auto,cpu,wall}".
Names choicesOf(const std::string& type) {
    Names names;
    const auto open = type.find('{'), close = type.find('}');
    if (open == std::string::npos || close == std::string::npos) return names;
    for (auto begin = open + 1; begin <= close;) {
        const auto end = std::min(type.find(',', begin), close);
        names.push_back(type.substr(begin, end - begin));
        begin = end + 1;
    }
    return names;
}

Names valuesOf(CLI::Option& option) {
    Names names = choicesOf(option.get_type_name());
    for (const char* kind : {kEngineNames, kScenarioNames, kSuiteNames, kStudyNames, kCollisionNames}) {
        try {
            (void)option.get_validator(kind);
        } catch (const CLI::OptionNotFound&) {
            continue;
        }
        for (const std::string& name : namesOfKind(kind)) names.push_back(name);
    }
    return names;
}

/// Follows a command line word by word, and knows what the next may be.
class Line {
  public:
    explicit Line(CLI::App& app) : command_(&app) {}

    void take(const std::string& word) {
        if (word == "=") return;  // bash splits --option=value here
        if (option_ != nullptr && !word.starts_with("-")) {
            const bool takesMore = option_->get_expected_max() > 1 && option_->get_allow_extra_args();
            if (!takesMore) option_ = nullptr;
        } else if (word.starts_with("-")) {
            CLI::Option* option = command_->get_option_no_throw(word);
            option_ = option != nullptr && option->get_items_expected_max() > 0 ? option : nullptr;
        } else if (CLI::App* next = subcommand(word); next != nullptr) {
            command_ = next;
        } else {
            ++positionals_;
            isUnknown_ = isUnknown_ || !subcommands().empty();
        }
    }

    /// The words that may follow; `begun` is the beginning of the next one.
    Names candidates(const std::string& begun) const {
        if (isUnknown_) return {};
        if (begun.starts_with("-")) return optionNames();
        if (option_ != nullptr) return valuesOf(*option_);
        Names names;
        for (const CLI::App* next : subcommands()) names.push_back(next->get_name());
        int position = 0;
        for (CLI::Option* option : command_->get_options()) {
            if (!option->get_positional()) continue;
            position += std::min(option->get_items_expected_max(), 1 << 20);
            if (position <= positionals_) continue;
            for (const std::string& value : valuesOf(*option)) names.push_back(value);
            break;
        }
        return names;
    }

  private:
    std::vector<CLI::App*> subcommands() const {
        return command_->get_subcommands([](const CLI::App*) { return true; });
    }
    CLI::App* subcommand(const std::string& name) const {
        for (CLI::App* next : subcommands())
            if (next->get_name() == name) return next;
        return nullptr;
    }
    Names optionNames() const {
        Names names;
        for (const CLI::Option* option : command_->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        return names;
    }

    CLI::App* command_;
    CLI::Option* option_ = nullptr;  ///< the option whose value comes next
    int positionals_ = 0;
    bool isUnknown_ = false;  ///< a word where a command is expected names none
};

int complete(CLI::App& app, Names words) {
    std::string begun = words.back();
    words.pop_back();
    if (begun == "=") begun.clear();
    Line line(app);
    for (const std::string& word : words) line.take(word);
    // In a list with commas the last item is completed.
    const auto comma = begun.starts_with("-") ? std::string::npos : begun.rfind(',');
    const std::string before = comma == std::string::npos ? "" : begun.substr(0, comma + 1);
    for (const std::string& name : line.candidates(begun))
        if (const std::string word = before + name; word.starts_with(begun))
            std::printf("%s\n", word.c_str());
    return kOk;
}

}  // namespace

CLI::Option* offerNames(CLI::Option* option, const char* kind) {
    return option->check(CLI::Validator("").name(kind));
}

void addCompletion(CLI::App& app, Action& action) {
    auto words = std::make_shared<Names>();
    auto* command = app.add_subcommand(
        "completion", "Print the completion for bash; with words, what the last of them may be");
    command->add_option("WORDS", *words, "Words of a command line without 'rigor', after --")
        ->type_name(kMayBeEmpty);
    command->callback([&app, words, &action] {
        action = [&app, words] {
            if (!words->empty()) return complete(app, *words);
            std::fputs(kBashScript, stdout);
            return static_cast<int>(kOk);
        };
    });
}

}  // namespace rigor::cli
