// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor new engine`: a folder with an engine that runs at once, bodies in free flight, to be continued. Its files are
// the smallest examples of the tree.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include "adapters/interface/registry.hpp"
#include "cli/command.hpp"
#include "scenarios/loader/data_folder.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;

struct NewEngineArguments {
    std::string name, language = "python";
    fs::path folder;
};

/// A file of the tree and its name in the new folder, in which NAME stands for the engine's.
struct Copy {
    std::string from, to;
};
struct Template {
    const char* language;
    const char* example;  ///< name of the engine in the files
    std::vector<Copy> files;
    const char* next;  ///< command that comes next, with NAME and FOLDER
};

const std::vector<Template>& templates() {
    static const std::vector<Template> table{
        {"python",
         "free_flight_python",
         {{"adapters/guest/sdk/rigor_guest.py", "rigor_guest.py"},
          {"adapters/guest/examples/free_flight_python/free_flight.py", "NAME.py"},
          {"adapters/guest/examples/free_flight_python/rigor_adapter_free_flight_python.json",
           "rigor_adapter_NAME.json"}},
         "RIGOR_ADAPTER_PATH=FOLDER PROGRAM conform NAME"},
        {"javascript",
         "free_flight_javascript",
         {{"adapters/guest/sdk/rigor_guest.mjs", "rigor_guest.mjs"},
          {"adapters/guest/examples/free_flight_javascript/free_flight.mjs", "NAME.mjs"},
          {"adapters/guest/examples/free_flight_javascript/rigor_adapter_free_flight_javascript.json",
           "rigor_adapter_NAME.json"}},
         "RIGOR_ADAPTER_PATH=FOLDER PROGRAM conform NAME"},
        {"cpp",
         "free_flight",
         {{"adapters/conformance/examples/free_flight.cpp", "NAME.cpp"},
          {"adapters/conformance/examples/CMakeLists.txt.in", "CMakeLists.txt"}},
         "cmake -S FOLDER -B FOLDER/build && cmake --build FOLDER/build && RIGOR_ADAPTER_PATH=FOLDER/build "
         "PROGRAM conform NAME"}};
    return table;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// A name in snake_case, as specs and files have it.
void checkEngineName(const std::string& name) {
    const bool letters = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_';
    });
    if (name.empty() || !letters || std::islower(static_cast<unsigned char>(name.front())) == 0)
        throw std::invalid_argument("the name of an engine: found '" + name +
                                    "', expected lower-case letters, digits and '_', a letter first");
}

/// An engine of this name would hide the other one, or be hidden by it.
void refuseTakenName(const std::string& name) {
    const std::vector<std::string> taken = adapter::availableEngines();
    std::vector<std::string> absent;
    for (const adapter::GuestManifest& guest : adapter::absentGuests()) absent.push_back(guest.name);
    const auto has = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (has(taken) || has(absent))
        throw std::invalid_argument("the name of an engine: found '" + name +
                                    "', which is that of an engine (`rigor list engines`), expected another");
}

const Template& templateFor(const std::string& language) {
    std::string known;
    for (const Template& t : templates()) {
        if (language == t.language) return t;
        known += (known.empty() ? "" : ", ") + std::string(t.language);
    }
    throw std::invalid_argument("--language: found '" + language + "', expected one of " + known);
}

int newEngine(const NewEngineArguments& a) {
    checkEngineName(a.name);
    refuseTakenName(a.name);
    const Template& t = templateFor(a.language);
    const fs::path folder = a.folder.empty() ? fs::path(a.name) : a.folder;
    if (fs::exists(folder) && !fs::is_empty(folder))
        throw std::invalid_argument(folder.string() + " is there already, and not empty");
    fs::create_directories(folder);
    for (const Copy& copy : t.files) {
        const fs::path from = scenario::templateFile(copy.from),
                       to = folder / replaced(copy.to, "NAME", a.name);
        std::ifstream in(from);
        if (!in) throw std::runtime_error("cannot read " + from.string());
        std::ostringstream text;
        text << in.rdbuf();
        std::string content = text.str();
        if (!copy.to.starts_with("rigor_guest.")) {
            content = replaced(std::move(content), t.example, a.name);
            content = replaced(std::move(content), "free_flight.py", a.name + ".py");
            content = replaced(std::move(content), "free_flight.mjs", a.name + ".mjs");
            content = replaced(std::move(content), "@RIGOR_SOURCE_DIR@", scenario::sourceFolder().string());
        }
        std::ofstream out(to);
        out << content;
        if (!out.flush()) throw std::runtime_error("cannot write " + to.string());
        std::printf("%s\n", to.string().c_str());
    }
    const std::string next = replaced(replaced(replaced(t.next, "NAME", a.name), "FOLDER", folder.string()),
                                      "PROGRAM", scenario::programName());
    const std::string modules =
        replaced(next.substr(next.find("RIGOR_ADAPTER_PATH")), "conform " + a.name, "");
    std::printf("next: %s\nthen: %svalidate smoke --engines %s,bullet\n", next.c_str(), modules.c_str(),
                a.name.c_str());
    return kOk;
}

}  // namespace

void addNew(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<NewEngineArguments>();
    auto* command = app.add_subcommand("new", "Write the beginning of something new");
    command->require_subcommand(1);
    auto* engine =
        command->add_subcommand("engine", "A folder with an engine in free flight, to be continued");
    engine->add_option("name", arguments->name, "Name of the engine, in snake_case")->required();
    engine->add_option("--language", arguments->language, "python, javascript (guests) or cpp (module)")
        ->capture_default_str();
    engine->add_option("--folder", arguments->folder, "Where to write it; default: a folder of its name");
    engine->callback([arguments, &action] { action = [arguments] { return newEngine(*arguments); }; });
    addNewScenario(*command, action);
}

}  // namespace rigor::cli
