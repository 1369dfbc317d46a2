// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/program.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/interface/nearest.hpp"
#include "adapters/interface/types.hpp"
#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done and green, 1 something in the run is red, 2 bad command line or input file,\n"
    "            3 internal error, 4 the engine lacks what the scenario needs, 5 the engine crashed,\n"
    "            6 nothing is red, but a reference did not finish, ran out of memory or crashed,\n"
    "            130 interrupted (a run can be resumed).\n"
    "The launcher ./rigor builds first; ./rigor test builds and runs the tests, ./rigor test --all the slow\n"
    "ones too.\n"
    "Engines are named by a spec: bullet, ode:stepper=quickstep,iterations=50, "
    "bullet:preset=matched,precision=f32.";

int runCommand(int argc, char** argv, const Program& program) {
    CLI::App app{"Rigor: rigid-body engines held to the same references"};
    app.name("rigor");
    app.set_version_flag("--version", std::string("rigor ") + RIGOR_VERSION);
    app.footer(kFooter);
    app.require_subcommand(1);
    Action action;
    for (const AddCommand add : program.commands) add(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::RequiredError& error) {
        if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty()) {
            std::vector<std::string> known;
            for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
                known.push_back(command->get_name());
            std::fprintf(stderr, "rigor: no command '%s'%s; `rigor --help` lists them\n", argv[1],
                         adapter::didYouMean(argv[1], known).c_str());
            return kBadInput;
        }
        return app.exit(error) == 0 ? kOk : kBadInput;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kOk : kBadInput;
    }
    return action();
}

}  // namespace

int runProgram(int argc, char** argv, const Program& program) {
    try {
        // The program runs itself again for every case; these are for programs.
        if (argc > 1 && std::string_view(argv[1]).starts_with("__"))
            return validation::childMain({argv + 1, argv + argc}, program.children);
        return runCommand(argc, argv, program);
    } catch (const scenario::LoadError& error) {
        printProblems(error, false);
        return kBadInput;
    } catch (const adapter::BadInput& error) {
        std::fprintf(stderr, "rigor: %s\n", error.what());
        return kBadInput;
    } catch (const adapter::Unsupported& error) {
        std::fprintf(stderr, "rigor: unsupported: %s\n", error.what());
        return kUnsupported;
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "rigor: %s\n", error.what());
        return kBadInput;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rigor: internal error: %s\n", error.what());
        return kInternal;
    }
}

}  // namespace rigor::cli
