// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "scenarios/exchange/write/write.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {
namespace {

struct ExportArguments {
    std::string format, scenario, out;
    std::vector<std::string> without, overrides;
    bool json = false;
};

void writeFile(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream to(file, std::ios::binary);
    to << bytes;
    if (!to.flush()) throw std::invalid_argument("--out: cannot write '" + file.string() + "'");
}

int runExport(const ExportArguments& a) {
    const auto loaded = scenario::loadScenario(scenario::findScenario(a.scenario), a.overrides);
    models::Report report({a.without.begin(), a.without.end()});
    std::string text;
    models::FilesBeside beside;
    try {
        text = a.format == "mjcf" ? models::mjcfText(loaded.scenario, report, beside)
                                  : models::urdfText(loaded.scenario, report, beside);
        if (!beside.empty() && a.out.empty())
            report.refuse("files", {loaded.scenario.name, 0},
                          "the model refers to " + std::to_string(beside.size()) +
                              " files beside it: --out FILE says where");
    } catch (const models::Refusal& refusal) {
        report.refuse("scenario", refusal.place(), refusal.what());
    }
    const bool isRefused = report.isRefused();
    if (a.json) {
        nlohmann::json said = report.json();
        said["exported"] = !isRefused;
        std::printf("%s\n", said.dump(1).c_str());
    } else {
        std::fprintf(stderr, "%s", report.text().c_str());
    }
    if (isRefused) {
        if (!a.json) std::fprintf(stderr, "rigor: %s was not exported\n", a.scenario.c_str());
        return kBadInput;
    }
    if (a.out.empty()) {
        if (!a.json) std::printf("%s", text.c_str());
        return kOk;
    }
    writeFile(a.out, text);
    for (const auto& [name, bytes] : beside)
        writeFile(std::filesystem::path(a.out).replace_filename(name), bytes);
    return kOk;
}

}  // namespace

void addExport(CLI::App& app, Action& action) {
    auto a = std::make_shared<ExportArguments>();
    auto* command = app.add_subcommand("export", "Write a scenario as a model of another simulator");
    command->add_option("FORMAT", a->format, "mjcf (MuJoCo) or urdf")
        ->required()
        ->check(CLI::IsMember({"mjcf", "urdf"}));
    command->add_option("SCENARIO", a->scenario, "Name or file of the scenario")->required();
    command->add_option("--out", a->out, "The model's file (default: standard output)");
    command
        ->add_option("--without", a->without,
                     "Features to leave out, as a refusal names them: restitution,events")
        ->delimiter(',');
    command->add_option("--set", a->overrides, "Override a value: KEY=VALUE, e.g. bodies.block.mass=2")
        ->allow_extra_args(false);
    command->add_flag("--json", a->json, "The report as JSON on stdout");
    command->callback([a, &action] { action = [a] { return runExport(*a); }; });
}

}  // namespace rigor::cli
