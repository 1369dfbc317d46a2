// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor conform`: runs the conformance kit (adapters/conformance) on one engine and counts what it passes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "adapters/interface/registry.hpp"
#include "cli/command.hpp"
#include "scenarios/model/nearest.hpp"
#include "validation/bench/text_table.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A section of the kit: its name here, the suites of GoogleTest that are in it, and its subject.
struct Section {
    const char* name;
    std::vector<std::string> suites;
    const char* subject;
};
const std::vector<Section>& sections() {
    static const std::vector<Section> table{
        {"description", {"Describe"}, "name, capabilities, options, presets"},
        {"build", {"Kit/Build"}, "read-back, ledger, repeatability, refusals"},
        {"motion", {"Kit/Motion"}, "free flight, frames, forces, damping"},
        {"contact", {"Kit/Contact", "Kit/ContactInstant"}, "rest, normals, friction, restitution, filters"},
        {"surface", {"Kit/Surface"}, "meshes, height fields, moving surfaces"},
        {"joints", {"Kit/Joints"}, "joints, limits, motors, springs"},
        {"stages", {"Kit/Stages"}, "steps in stages, snapshots"},
        {"state", {"Kit/StateSettingTest"}, "states set from outside"},
        {"collision", {"Kit/Collision"}, "queries of pairs of shapes"},
        {"broad_phase", {"Kit/BroadPhases"}, "pairs of boxes"},
    };
    return table;
}

struct ConformArguments {
    std::string engine;
    std::vector<std::string> only;
    bool json = false, markdown = false;
    double seconds = 900.0;
};

struct Failure {
    std::string test, message;
};
struct Count {
    int passed = 0, skipped = 0;
    std::vector<Failure> failures;
};
using Counts = std::map<std::string, Count>;  ///< counts by section

/// Suites of the kit that no section names count as "other".
std::string sectionOf(const std::string& suite) {
    for (const Section& section : sections())
        if (std::find(section.suites.begin(), section.suites.end(), suite) != section.suites.end())
            return section.name;
    return "other";
}

/// The last test of the kit, in no section: it fails once for every known deviation that the engine does not need.
constexpr const char* kDeviationSuite = "KnownDeviations";

std::string filterOf(const std::vector<std::string>& only) {
    std::string filter;
    for (const std::string& name : only) {
        std::vector<std::string> known;
        const std::size_t before = filter.size();
        for (const Section& section : sections()) {
            known.emplace_back(section.name);
            if (name != section.name) continue;
            for (const std::string& suite : section.suites) filter += suite + ".*:";
        }
        if (filter.size() == before)
            throw std::invalid_argument("--only: found '" + name + "', which is no section of the kit" +
                                        scenario::didYouMean(name, known));
    }
    return filter + kDeviationSuite + ".*";
}

fs::path kitProgram() {
    const fs::path binary = ownBinary();
    for (const fs::path& file : {binary.parent_path() / "conformance_test",
                                 binary.parent_path().parent_path() / "tests/conformance_test",
                                 binary.parent_path().parent_path() / "lib/rigor/conformance_test"})
        if (fs::exists(file)) return file;
    throw std::runtime_error("the conformance kit is not here: build the target conformance_test");
}

/// The kit is another program: it gets the folders in which this one looks for engines.
void passAdapterPath() {
    std::string path;
    for (const auto& folder : adapter::adapterPath()) path += (path.empty() ? "" : ":") + folder.string();
    setenv("RIGOR_ADAPTER_PATH", path.c_str(), 1);
}

/// A message of GoogleTest in one line, without its place in the kit's source.
std::string oneLine(const std::string& text, std::size_t most) {
    const auto start = text.find(".cpp:") < text.find('\n') ? text.find('\n') + 1 : 0;
    std::string line = text.substr(start);
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line.size() > most ? line.substr(0, most) + "..." : line;
}

Counts countsOf(const Json& report) {
    Counts counts;
    for (const Json& suite : report.at("testsuites"))
        for (const Json& test : suite.at("testsuite")) {
            if (test.value("status", "") != "RUN") continue;
            const std::string suiteName = suite.at("name");
            const bool isOfDeviations = suiteName == kDeviationSuite;
            if (isOfDeviations && !test.contains("failures")) continue;
            Count& count = counts[sectionOf(suiteName)];
            const std::string name = suiteName + "." + test.at("name").get<std::string>();
            if (test.contains("failures"))
                for (const Json& failure : test.at("failures")) {
                    count.failures.push_back({name, failure.at("failure").get<std::string>()});
                    if (!isOfDeviations) break;  // a case has its first message alone
                }
            else if (test.value("result", "") == "SKIPPED")
                ++count.skipped;
            else
                ++count.passed;
        }
    return counts;
}

Counts runKit(const ConformArguments& a) {
    passAdapterPath();
    const validation::ScratchFolder scratch;
    const fs::path report = scratch.path() / "report.json";
    std::vector<std::string> command{kitProgram().string(), "--engine", a.engine,
                                     "--gtest_output=json:" + report.string()};
    if (!a.only.empty()) command.push_back("--gtest_filter=" + filterOf(a.only));
    validation::ProcessResult result;
    validation::ProcessPool pool(1);
    pool.add({command, {a.seconds, 0}, a.engine, [&](const validation::ProcessResult& r) { result = r; }});
    const std::atomic<bool> never{false};
    pool.run(never, [](const std::string&) {});
    std::ifstream file(report);
    if (!file)
        throw std::runtime_error(
            "the kit did not finish: " + (result.timedOut ? "no end within its time" : result.ending()) +
            "; it said: " +
            result.outputTail.substr(result.outputTail.size() > 600 ? result.outputTail.size() - 600 : 0));
    return countsOf(Json::parse(file));
}

struct Sum {
    int passed = 0, skipped = 0, failed = 0;
};
Sum sumOf(const Counts& counts) {
    Sum sum;
    for (const auto& [name, count] : counts) {
        sum.passed += count.passed;
        sum.skipped += count.skipped;
        sum.failed += static_cast<int>(count.failures.size());
    }
    return sum;
}

std::string summaryOf(const Sum& sum) {
    const std::string run = std::to_string(sum.passed + sum.failed);
    if (sum.failed > 0)
        return "does not conform: " + std::to_string(sum.failed) + " of " + run + " cases fail";
    if (sum.passed == 0) return "no case was run";
    return "conforms: all " + run + " cases of what it claims";
}

std::string titleOf(const validation::EngineDescription& d) {
    return d.info.title + " " + d.info.version + " (" + d.info.precision +
           (d.info.clock.empty() ? "" : ", " + d.info.clock) + ")";
}

void printText(const validation::EngineDescription& d, const Counts& counts) {
    std::vector<std::vector<std::string>> rows;
    for (const Section& section : sections()) {
        const auto it = counts.find(section.name);
        if (it == counts.end()) continue;
        const Count& c = it->second;
        rows.push_back({section.name, std::to_string(c.passed), std::to_string(c.skipped),
                        std::to_string(c.failures.size()), section.subject});
    }
    std::printf("%s\n\n%s\n", titleOf(d).c_str(),
                validation::tableText({"section", "passed", "not claimed", "failed", ""}, rows).c_str());
    for (const auto& [name, count] : counts)
        for (const Failure& f : count.failures)
            std::printf("FAILED %s\n    %s\n", f.test.c_str(), oneLine(f.message, 300).c_str());
    std::printf("%s\n", summaryOf(sumOf(counts)).c_str());
}

/// A summary for the README of the engine, in Markdown.
void printMarkdown(const validation::EngineDescription& d, const Counts& counts) {
    std::printf(
        "**Rigor conformance kit, %s:** %s.\n\n| section | passed | not claimed | failed "
        "|\n|---|---|---|---|\n",
        titleOf(d).c_str(), summaryOf(sumOf(counts)).c_str());
    for (const Section& section : sections())
        if (const auto it = counts.find(section.name); it != counts.end())
            std::printf("| %s: %s | %d | %d | %zu |\n", section.name, section.subject, it->second.passed,
                        it->second.skipped, it->second.failures.size());
}

void printJson(const validation::EngineDescription& d, const Counts& counts) {
    const Sum sum = sumOf(counts);
    Json json{{"engine", d.info.name},    {"version", d.info.version},  {"precision", d.info.precision},
              {"passed", sum.passed},     {"not_claimed", sum.skipped}, {"failed", sum.failed},
              {"sections", Json::array()}};
    for (const auto& [name, count] : counts) {
        Json failures = Json::array();
        for (const Failure& f : count.failures)
            failures.push_back({{"case", f.test}, {"message", f.message}});
        json["sections"].push_back({{"section", name},
                                    {"passed", count.passed},
                                    {"not_claimed", count.skipped},
                                    {"failures", std::move(failures)}});
    }
    std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

int conform(const ConformArguments& a) {
    const auto description = validation::describeEngine(a.engine, ownBinary());
    (void)adapter::moduleFor(adapter::parseSpec(a.engine));  // an engine that is not installed is said now
    if (!description.problem.empty())
        throw std::runtime_error("engine " + a.engine + ": " + description.problem);
    const Counts counts = runKit(a);
    if (a.json)
        printJson(description, counts);
    else if (a.markdown)
        printMarkdown(description, counts);
    else
        printText(description, counts);
    const Sum sum = sumOf(counts);
    return sum.failed == 0 && sum.passed > 0 ? kOk : kRed;
}

}  // namespace

void addConform(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<ConformArguments>();
    auto* command = app.add_subcommand("conform", "Run the conformance kit on an engine, module or guest");
    offerNames(
        command->add_option("engine", arguments->engine, "Engine: NAME or NAME:precision=f32")->required(),
        kEngineNames);
    command->add_option("--only", arguments->only, "Sections, with commas between")->delimiter(',');
    command->add_flag("--json", arguments->json, "Print JSON");
    command->add_flag("--markdown", arguments->markdown, "Print a summary for a README");
    command->add_option("--limit", arguments->seconds, "Longest time [s]")->capture_default_str();
    command->callback([arguments, &action] { action = [arguments] { return conform(*arguments); }; });
}

}  // namespace rigor::cli
