// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/import_model.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "scenarios/exchange/common/formats.hpp"
#include "scenarios/exchange/common/text.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "validation/runner/scratch_folder.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMemoryMiB = 4096;

fs::path readerOf(const models::Format& format) {
    const std::string name = std::string("rigor-read-") + format.name;
    for (const fs::path& folder :
         {ownBinary().parent_path() / "readers", ownBinary().parent_path() / "../lib/rigor/readers"})
        if (fs::exists(folder / name)) return folder / name;
    const std::string how = scenario::sourceFolder().empty()
                                ? "the Debian package rigor-readers has its reader"
                                : std::string("it lacks the Debian packages ") + format.packages +
                                      "; ./rigor --with models installs them";
    throw std::invalid_argument(std::string("this build reads no ") + format.name + " files: " + how);
}

/// The answer of the reader; a reader that ends in another way is a refusal with its last message.
models::Answer runReader(const models::Format& format, const models::ReadOptions& options, double timeLimit) {
    const validation::ScratchFolder folder;
    const fs::path answerFile = folder.path() / "answer.json";
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe can be made");
    const pid_t child = validation::startProgram(
        {readerOf(format).string(), models::toJson(options).dump(), answerFile.string()}, ends[1],
        kMemoryMiB);
    close(ends[1]);
    std::string said;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeLimit);
    bool isLate = false, isOpen = true;
    while (isOpen && !isLate) {
        pollfd output{ends[0], POLLIN, 0};
        poll(&output, 1, 1000);
        if (output.revents != 0) isOpen = validation::drainOutput(ends[0], said);
        isLate = std::chrono::steady_clock::now() > deadline;
    }
    if (isLate) kill(-child, SIGKILL);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    models::Answer answer;
    std::ifstream in(answerFile);
    const json read = in ? json::parse(in, nullptr, false) : json(nullptr);
    if (status == 0 && read.is_object()) {
        answer.scenario = read.at("scenario").get<std::string>();
        answer.report = models::Report::fromJson(read.at("report"));
        return answer;
    }
    std::string how;
    const std::string last = validation::lastLine(said);
    if (isLate)
        how = "did not end within " + models::digits({timeLimit}) + " s (--time-limit)";
    else if (said.find("bad_alloc") != std::string::npos)
        how = "needs more than " + std::to_string(kMemoryMiB) + " MiB of memory";
    else
        how = "ended with " + validation::endingOf(status) + (last.empty() ? "" : ": " + last);
    answer.report.refuse("file", {options.file.filename().string(), 0}, "its reader " + how);
    return answer;
}

}  // namespace

void addModelOptions(CLI::App& command, ModelArguments& a) {
    auto* group = command.add_option_group("Models", "For mjcf, urdf, sdf and mesh");
    group
        ->add_option("--without", a.without,
                     "Features to leave out, as a refusal names them: actuators,tendons")
        ->delimiter(',');
    group->add_option("--assets", a.assets, "Other folders with files that the model refers to")
        ->allow_extra_args(false);
    group->add_option("--name", a.options.name, "Name of the scenario (default: the file's)");
    group->add_option("--licence", a.options.licence,
                      "Licence of the model (default: the file LICENSE beside or above it)");
    group->add_option("--duration", a.options.duration, "Duration of the scenario [s] (default 5)")
        ->check(between(1e-6, 3600.0));
    group->add_option("--dt", a.dt, "Time step [s] (default: the model's, else 1/240)");
    group->add_option("--keyframe", a.options.keyframe, "MJCF: start from this keyframe, by name or number");
    group->add_option("--friction", a.options.friction, "Coefficient where the file states none (default 1)")
        ->check(between(0.0, 1e6));
    group->add_option("--density", a.options.density, "Meshes: density [kg/m3] (default 1000)")
        ->check(between(1e-9, 1e9));
    group->add_option("--scale", a.options.scale, "Meshes: metres per unit of the file (default 1)")
        ->check(between(1e-9, 1e9));
    group->add_option("--floor", a.floor, "Add a static half-space at this height [m]")
        ->check(anyNumber<double>());
    group->add_flag("--fixed-base", a.options.fixedBase, "URDF: the root link does not move");
    group->add_flag("--self-collision", a.options.selfCollision,
                    "URDF: links of the robot collide with each other");
    group->add_flag("--hull", a.options.hull, "Take the convex hull of a mesh that moves and is not convex");
    group
        ->add_option("--hull-corners", a.options.hullCorners,
                     "Take this many corners of a convex hull that has more, those that stand out most")
        ->check(between(4, 64));
    group->add_option("--time-limit", a.timeLimit, "Most seconds for the reader (default 300)")
        ->check(between(1.0, 86400.0));
    group->add_flag("--static", a.options.isStatic, "Meshes: the mesh is the ground, of triangles");
    group->add_flag("--json", a.json, "The report as JSON on stdout");
}

bool isModelFormat(const std::string& word) {
    return models::findFormat(word) != nullptr;
}

int importModel(const std::string& format, const std::string& file, const std::string& out,
                ModelArguments a) {
    models::ReadOptions options = a.options;
    options.file = file;
    options.without = {a.without.begin(), a.without.end()};
    for (const auto& folder : a.assets) options.assets.emplace_back(folder);
    if (!a.dt.empty()) options.timeStep = parseTimeStep(a.dt);
    if (!a.floor.empty()) {
        options.hasFloor = true;
        options.floor = std::stod(a.floor);
    }
    const models::Answer answer = runReader(*models::findFormat(format), options, a.timeLimit);
    const bool isRefused = answer.report.isRefused();
    if (a.json) {
        json report = answer.report.json();
        report["imported"] = !isRefused;
        report["scenario"] = isRefused ? json(nullptr) : json(out);
        std::printf("%s\n", report.dump(1).c_str());
    } else {
        std::fprintf(stderr, "%s", answer.report.text().c_str());
    }
    if (isRefused) {
        if (!a.json) std::fprintf(stderr, "rigor: %s was not imported\n", file.c_str());
        return kBadInput;
    }
    if (out.empty()) {
        if (!a.json) std::printf("%s", answer.scenario.c_str());
        return kOk;
    }
    std::ofstream to(out, std::ios::binary);
    to << answer.scenario;
    if (!to.flush()) throw std::invalid_argument("--out: cannot write '" + out + "'");
    if (!a.json) std::printf("Scenario: %s\nRun: ./rigor validate %s\n", out.c_str(), out.c_str());
    return kOk;
}

}  // namespace rigor::cli
