// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/interface/types.hpp"
#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/model/nearest.hpp"
#include "scenarios/model/printable.hpp"
#include "validation/results/files.hpp"

namespace rigor::cli {
namespace {

constexpr const char* kLauncher =
    "\nThe launcher ./rigor builds first; ./rigor test builds and runs the tests, ./rigor test --all the "
    "slow\n"
    "ones too.";
constexpr const char* kFooter =
    "Exit codes: 0 done and green, 1 something in the run is red, 2 bad command line or input file,\n"
    "            3 internal error, 4 the engine lacks what the scenario needs (`validate`: in every case),\n"
    "            5 the engine crashed,\n"
    "            6 nothing is red, but a reference did not finish, ran out of memory or crashed,\n"
    "            7 the environment failed (no space, no permission, killed from outside, damaged files),\n"
    "            130 interrupted (a run can be resumed).\n"
    "Engines are named by a spec: bullet, ode:stepper=quickstep,iterations=50, "
    "bullet:preset=matched,precision=f32.";

/// The last command that was named: of "rigor list engines" that of "engines".
const CLI::App& namedCommand(const CLI::App& app) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    return named.empty() ? app : namedCommand(*named.back());
}

/// "rigor list": a command with those that it belongs to.
std::string fullName(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return (parent == nullptr ? "" : fullName(*parent) + " ") + command.get_name();
}

std::vector<std::string> commandsOf(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// Says which word of the command line is not known, and the known one next to it. False: another error.
bool saysUnknownWord(const CLI::App& app) {
    const CLI::App& command = namedCommand(app);
    const std::vector<std::string> words = app.remaining(true);
    if (words.empty()) return false;
    const std::string& word = words.front();
    const bool isOption = word.starts_with("-");
    const std::vector<std::string> commands = commandsOf(command);
    if (!isOption && commands.empty()) return false;
    const std::string name = fullName(command), option = word.substr(0, word.find('='));
    std::fprintf(
        stderr, "%s: no %s '%s'%s; `%s --help` lists them\n", name.c_str(), isOption ? "option" : "command",
        scenario::printable(isOption ? option : word).c_str(),
        (isOption ? scenario::didYouMean(option, optionsOf(command)) : scenario::didYouMean(word, commands))
            .c_str(),
        name.c_str());
    return true;
}

/// Every option of a command and of those below it.
void forOptions(CLI::App& app, const std::function<void(CLI::App&, CLI::Option&)>& use) {
    for (CLI::Option* option : app.get_options()) use(app, *option);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        forOptions(*command, use);
}

/// Numeric options without a check of their own get one, whose message says more than the library's.
void checkNumbers(CLI::App& app) {
    forOptions(app, [](CLI::App&, CLI::Option& option) {
        const std::string type = option.get_type_name();  // "INT", or "INT:CHECK"
        if (type == "INT") option.check(anyNumber<long long>());
        if (type == "UINT") option.check(anyNumber<unsigned long long>());
        if (type == "FLOAT") option.check(anyNumber<double>());
    });
}

/// An empty text would count as an option that is not given. Throws std::invalid_argument.
void refuseEmptyTexts(CLI::App& app) {
    forOptions(app, [](CLI::App& command, CLI::Option& option) {
        const CLI::results_t& texts = option.results();
        if (option.get_type_name() == kMayBeEmpty) return;
        if (option.count() == 0 || std::find(texts.begin(), texts.end(), "") == texts.end()) return;
        throw std::invalid_argument(command.get_name() + ": " + option.get_name() +
                                    ": found '', expected a text that is not empty");
    });
}

int runCommand(int argc, char** argv, const Program& program) {
    CLI::App app{"Rigor: rigid-body engines held to the same references"};
    app.name("rigor");
    app.set_version_flag("--version", std::string("rigor ") + RIGOR_VERSION);
    const bool isInstalled = scenario::sourceFolder().empty();
    app.footer(std::string(kFooter) + (isInstalled ? "" : kLauncher));
    app.require_subcommand(1);
    Action action;
    for (const AddCommand add : program.commands) add(app, action);
    checkNumbers(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool isMistake = error.get_exit_code() != 0;
        if (isMistake && saysUnknownWord(app)) return kBadInput;
        // The library would print words of the command line as they are.
        std::ostringstream text, message;
        const int code = app.exit(error, text, message);
        std::fputs(text.str().c_str(), stdout);
        std::fputs(scenario::printable(message.str(), scenario::Lines::Keep).c_str(), stderr);
        return code == 0 ? kOk : kBadInput;
    }
    refuseEmptyTexts(app);
    return action();
}

}  // namespace

int runProgram(int argc, char** argv, const Program& program) {
    try {
        // The program runs itself again for every case; these are for programs.
        if (argc > 1 && std::string_view(argv[1]).starts_with("__"))
            return validation::childMain({argv + 1, argv + argc}, program.children);
        return withOutputWritten(runCommand(argc, argv, program));
    } catch (const scenario::LoadError& error) {
        printProblems(error, false);
        return kBadInput;
    } catch (const adapter::BadInput& error) {
        say(error.what());
        return kBadInput;
    } catch (const adapter::Unsupported& error) {
        say(std::string("unsupported: ") + error.what());
        return kUnsupported;
    } catch (const std::invalid_argument& error) {
        say(error.what());
        return kBadInput;
    } catch (const results::EnvironmentError& error) {
        say(error.what());
        return kEnvironment;
    } catch (const std::filesystem::filesystem_error& error) {
        say(error.what());
        return kEnvironment;
    } catch (const std::exception& error) {
        say(std::string("internal error: ") + error.what());
        return kInternal;
    }
}

}  // namespace rigor::cli
