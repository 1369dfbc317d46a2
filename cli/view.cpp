// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <poll.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/numbers.hpp"
#include "cli/view/live_site.hpp"
#include "cli/view/run_site.hpp"
#include "cli/view/server.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/judge.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
    std::string what, engines = validation::kInHouseEngine, timeStep, saveFolder = ".";
    std::vector<std::string> overrides;
    int port = 0;
    bool open = false, json = false;
};

/// A folder, unless it holds no run and a scenario of the library has its name.
bool isFolderOfRun(const std::string& what) {
    if (!fs::is_directory(what)) return false;
    if (fs::exists(fs::path(what) / "results.sqlite")) return true;
    const auto all = scenario::listScenarios();
    return std::none_of(all.begin(), all.end(), [&](const auto& entry) { return entry.name == what; });
}

/// The desktop's own browser; the user sees whether that worked.
void openInBrowser(const std::string& url) {
    const pid_t child = fork();
    if (child != 0) return;
    setsid();
    execlp("xdg-open", "xdg-open", url.c_str(), static_cast<char*>(nullptr));
    _exit(127);
}

void printLink(const view::Server& server, const std::string& title, bool asJson) {
    const std::string url = server.url();
    if (asJson)
        std::printf(
            "%s\n",
            nlohmann::ordered_json{{"name", title}, {"url", url}, {"port", server.port()}}.dump().c_str());
    else
        std::printf(
            "%s\n  %s\n  The link lets one browser in, once. Enter makes a new one and ends the session; "
            "Ctrl-C ends the server.\n",
            title.c_str(), url.c_str());
    std::fflush(stdout);
}

/// True if Enter was pressed at the terminal that this program runs in the foreground of.
bool enterWasPressed() {
    if (!isTerminal(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) != getpgrp()) return false;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, 0) <= 0) return false;
    char line[256];
    return read(STDIN_FILENO, line, sizeof line) > 0;
}

volatile std::sig_atomic_t renewalAsked = 0;

extern "C" void askRenewal(int) {
    renewalAsked = 1;
}

/// Serves until Ctrl-C.
int serve(view::Site& site, const std::string& title, const ViewArguments& a) {
    const std::atomic<bool>& interrupted = catchInterrupts({SIGINT, SIGTERM, SIGHUP});
    std::signal(SIGCHLD, SIG_DFL);
    std::signal(SIGUSR1, askRenewal);
    view::Server server(site, a.port);
    printLink(server, title, a.json);
    if (a.open) openInBrowser(server.url());
    while (!interrupted) {
        if (renewalAsked != 0 || enterWasPressed()) {
            renewalAsked = 0;
            server.renew();
            printLink(server, title, a.json);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return kOk;
}

int viewRun(const ViewArguments& a) {
    view::RunSite site(a.what);
    return serve(site, "run " + fs::path(a.what).lexically_normal().string(), a);
}

int viewScenario(const ViewArguments& a) {
    const auto loaded = loadWithReference(a.what, a.overrides, {});
    const std::vector<adapter::EngineSpec> specs = adapter::parseSpecList(a.engines);
    validation::checkSpecs(specs, ownBinary());
    if (specs.size() > validation::Session::kMaxInstances)
        throw std::invalid_argument("--engines: no more than 8 at a time");
    validation::SessionOptions options;
    options.binary = ownBinary();
    options.saveFolder = fs::absolute(a.saveFolder);
    options.dt = a.timeStep.empty() ? 0.0 : parseTimeStep(a.timeStep);
    validation::Session session(options, loaded.text, specs);
    view::LiveSite site(session, ownBinary());
    return serve(site, loaded.scenario.name + ", live", a);
}

}  // namespace

void addView(CLI::App& app, Action& action) {
    auto a = std::make_shared<ViewArguments>();
    auto* command =
        app.add_subcommand("view", "Watch a scenario run live, or a recorded run, in the browser");
    command->footer(
        "A server on 127.0.0.1, for the browser that opens the printed link first; Enter or SIGUSR1 makes a "
        "new link.\n"
        "Live: play, step, step by stage, drag bodies, branch with other algorithms or values, save what is "
        "seen\n"
        "as a scenario.");
    auto* what =
        command->add_option("SCENARIO|RUN", a->what, "Library name, scenario file, or folder of a run")
            ->required();
    offerNames(what, kScenarioNames);
    addEngines(*command, a->engines, "Live: engine specs, one instance each (default: rigor)");
    command->add_option("--dt", a->timeStep,
                        "Live: time step in seconds (0.004 or 1/240); default: the scenario's first");
    command
        ->add_option("--set", a->overrides,
                     "Live: override a scenario value: KEY=VALUE, e.g. bodies.block.velocity=[3.1,0,0.2]")
        ->allow_extra_args(false);
    command
        ->add_option("--save-to", a->saveFolder, "Live: folder for scenarios that are saved (default: here)")
        ->check(CLI::ExistingDirectory);
    command->add_option("--port", a->port, "Port; default: any that is free")->check(between(0, 65535));
    command->add_flag("--open,!--no-open", a->open, "Open the link with xdg-open");
    command->add_flag("--json", a->json, "Print the link as JSON");
    command->callback(
        [a, &action] { action = [a] { return isFolderOfRun(a->what) ? viewRun(*a) : viewScenario(*a); }; });
}

}  // namespace rigor::cli
