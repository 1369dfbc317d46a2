// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor manual`: the manual pages, in the macros of man(7), from the definitions of the commands themselves. One page for
// the program and one for each command; commands of a command are sections of its page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <memory>

#include "cli/command.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

/// Text for man(7): backslashes and hyphens as such, and no line that begins like a macro.
std::string escaped(const std::string& text) {
    std::string out;
    bool begins = true;
    for (const char c : text) {
        if (begins && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        begins = c == '\n';
    }
    return out;
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

bool takesMany(const CLI::Option& option) {
    return option.get_items_expected_max() > 1;
}

/// The word for an option's value: "INT"; empty for a flag.
std::string valueName(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return "";
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}
/// The values that its checks allow: "INT in [1 - 1024]"; empty if they say nothing.
std::string allowedValues(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const auto colon = type.find(':');
    return colon == std::string::npos ? "" : type.substr(colon + 1);
}

std::string otherOptions(const char* word, const std::set<CLI::Option*>& options) {
    std::string names;
    for (const CLI::Option* option : options) names += (names.empty() ? "" : ", ") + option->get_name();
    return names.empty() ? "" : std::string("\n") + word + " " + names + ".";
}

/// Head of an item: "\fB\-j\fR, \fB\-\-jobs\fR \fIINT\fR", or the name of a positional.
std::string headOf(const CLI::Option& option) {
    if (option.get_positional()) return "\\fI" + escaped(option.get_name(true)) + "\\fR";
    std::string head;
    const auto add = [&](const std::string& name) {
        head += (head.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
    };
    for (const std::string& name : option.get_snames()) add("-" + name);
    for (const std::string& name : option.get_lnames()) add("--" + name);
    const std::string value = valueName(option);
    return head + (value.empty() ? "" : " \\fI" + escaped(value) + "\\fR");
}

std::string itemOf(const CLI::Option& option) {
    std::string text = option.get_description();
    if (const std::string allowed = allowedValues(option); !allowed.empty())
        text += "\nAllowed: " + allowed + ".";
    if (const std::string given = option.get_default_str(); !given.empty())
        text += "\nDefault: " + given + ".";
    if (option.get_required()) text += "\nRequired.";
    text += otherOptions("Needs", option.get_needs()) + otherOptions("Not with", option.get_excludes());
    return ".TP\n" + headOf(option) + "\n" + escaped(text) + "\n";
}

std::string itemsOf(const CLI::App& command, bool positional) {
    std::string items;
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional() == positional) items += itemOf(*option);
    return items;
}

std::string synopsisOf(const std::string& name, const CLI::App& command) {
    std::string text = ".B " + escaped(name) + "\n";
    if (!commandsOf(command).empty()) return text + ".I COMMAND\n[\\fIOPTION\\fR]...\n";
    text += "[\\fIOPTION\\fR]...\n";
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional()) continue;
        const std::string value =
            "\\fI" + escaped(option->get_name(true)) + "\\fR" + (takesMany(*option) ? "..." : "");
        text += (option->get_required() ? value : "[" + value + "]") + "\n";
    }
    return text;
}

/// The lines below a command's help, as they are.
std::string footerOf(const CLI::App& command) {
    const std::string footer = command.get_footer();
    if (footer.empty()) return "";
    const bool isExitCodes = footer.starts_with("Exit codes");
    return std::string(".SH ") + (isExitCodes ? "EXIT STATUS" : "NOTES") + "\n.nf\n" + escaped(footer) +
           "\n.fi\n";
}

std::string section(const char* title, const std::string& items) {
    return items.empty() ? "" : std::string(".SH ") + title + "\n" + items;
}

/// Commands of a command: each a section, with its options.
std::string nestedOf(const std::string& name, const CLI::App& command) {
    std::string text;
    for (const CLI::App* nested : commandsOf(command))
        text += ".SH \"" + escaped(name + " " + nested->get_name()) + "\"\n" +
                synopsisOf(name + " " + nested->get_name(), *nested) + ".PP\n" +
                escaped(nested->get_description() + ".") + "\n" + itemsOf(*nested, true) +
                itemsOf(*nested, false);
    return text;
}

class Manual {
  public:
    Manual(const CLI::App& app, std::string date) : app_(app), date_(std::move(date)) {}

    std::string programPage() const {
        std::string commands;
        for (const CLI::App* command : commandsOf(app_))
            commands += ".TP\n\\fB" + escaped(command->get_name()) + "\\fR\n" +
                        escaped(command->get_description() + ".") + "\n";
        return headerOf(app_.get_name(), "compare rigid-body physics engines with reference solutions") +
               ".SH SYNOPSIS\n" + synopsisOf(app_.get_name(), app_) + section("DESCRIPTION", kDescription) +
               section("COMMANDS", commands) + section("OPTIONS", itemsOf(app_, false)) + footerOf(app_) +
               section("ENVIRONMENT", kEnvironment) + section("SEE ALSO", seeAlso());
    }

    std::string commandPage(const CLI::App& command) const {
        const std::string name = command.get_name();
        std::string description = escaped(command.get_description() + ".") + "\n";
        if (name == "validate") description += kValidateProgram;
        return headerOf("rigor-" + name, command.get_description()) + ".SH SYNOPSIS\n" +
               synopsisOf("rigor " + name, command) + section("DESCRIPTION", description) +
               section("ARGUMENTS", itemsOf(command, true)) + section("OPTIONS", itemsOf(command, false)) +
               nestedOf("rigor " + name, command) + footerOf(command) +
               section("SEE ALSO", ".BR rigor (1)\n");
    }

  private:
    static constexpr const char* kDescription =
        "A scenario is written once, and every engine runs it. The motions are measured against the exact "
        "solution\nwhere one exists, and against each other where none does. The result is a run folder with "
        "a report that\nopens in a browser.\n";
    static constexpr const char* kEnvironment =
        ".TP\n.B RIGOR_ADAPTER_PATH\nFolders of further engines, with colons between: modules and manifests "
        "of "
        "guests.\n.TP\n.B RIGOR_SCENARIOS\nFolder of the scenario library, instead of the installed "
        "one.\n.TP\n"
        ".B NO_COLOR\nNo colours on a terminal.\n";
    static constexpr const char* kValidateProgram =
        ".PP\nThe program\n.B rigor\\-validate\nhas the commands that run scenarios and report, this one "
        "among "
        "them, and no others:\n.B rigor\\-validate validate\nis the same as\n.BR \"rigor validate\" .\n";

    std::string headerOf(const std::string& name, const std::string& title) const {
        std::string upper = name;
        for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        return ".TH " + escaped(upper) + " 1 \"" + date_ + "\" \"" + kVersion +
               "\" \"User Commands\"\n.SH NAME\n" + escaped(name) + " \\- " + escaped(title) + "\n";
    }
    std::string seeAlso() const {
        std::string text;
        for (const CLI::App* command : commandsOf(app_))
            text += (text.empty() ? "" : " ,\n") + (".BR rigor\\-" + escaped(command->get_name()) + " (1)");
        return text + "\n";
    }

    static constexpr const char* kVersion = "rigor " RIGOR_VERSION;
    const CLI::App& app_;
    std::string date_;
};

int writeManual(const CLI::App& app, const fs::path& folder, const std::string& date) {
    const Manual manual(app, date);
    fs::create_directories(folder);
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream file(folder / (name + ".1"));
        file << text;
        if (!file.flush()) throw std::runtime_error("cannot write " + (folder / (name + ".1")).string());
    };
    write(app.get_name(), manual.programPage());
    for (const CLI::App* command : commandsOf(app))
        write("rigor-" + command->get_name(), manual.commandPage(*command));
    return kOk;
}

}  // namespace

void addManual(CLI::App& app, Action& action) {
    struct Arguments {
        fs::path folder;
        std::string date;
    };
    auto a = std::make_shared<Arguments>();
    auto* command = app.add_subcommand("manual", "Write the manual pages of all commands");
    command->add_option("--out", a->folder, "Folder for rigor.1, rigor-validate.1, ...")->required();
    command->add_option("--date", a->date, "Date of the pages, as 2026-11-26");
    command->callback(
        [&app, a, &action] { action = [&app, a] { return writeManual(app, a->folder, a->date); }; });
}

}  // namespace rigor::cli
