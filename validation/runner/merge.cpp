// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/merge.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "validation/comparison/refinements.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/header.hpp"
#include "validation/runner/shard.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using results::CaseRow;
using results::Run;

struct Part {
    fs::path folder;
    Run run;
    Shard shard;
};

[[noreturn]] void refuse(const std::string& what) {
    throw std::invalid_argument("merge: " + what);
}

std::string environmentOf(const Run& run, const char* key) {
    const auto it = run.environment.find(key);
    return it == run.environment.end() ? "" : it->second;
}

Part readPart(const fs::path& folder) {
    Part part{folder, {}, {}};
    try {
        part.run = results::readRun(folder);
    } catch (const std::runtime_error& error) {
        refuse(error.what());
    }
    if (!part.run.damage.empty()) refuse(part.run.damage.front());
    const std::string shard = environmentOf(part.run, kShardKey);
    if (shard.empty())
        refuse("'" + folder.string() + "' is no shard (`rigor validate --shard K/N` makes one)");
    part.shard = parseShard(shard);
    part.shard.plan = environmentOf(part.run, kPlanKey);
    part.shard.planned = std::stoul(environmentOf(part.run, kPlannedKey));
    return part;
}

/// Text by which two engines of a run are the same.
std::string identityOf(const results::EngineRow& e) {
    return e.version + " " + e.precision + " " + e.package + " " + e.buildNotes + " " + e.problem +
           e.capabilities;
}

void checkFits(const Part& first, const Part& other) {
    const std::string both = "'" + first.folder.string() + "' and '" + other.folder.string() + "' ";
    const std::string versions[] = {environmentOf(first.run, kShardVersionKey),
                                    environmentOf(other.run, kShardVersionKey)};
    if (versions[0] != versions[1])
        refuse(both + "are of different versions: rigor " + versions[0] + " and " + versions[1]);
    if (first.shard.count != other.shard.count || first.shard.plan != other.shard.plan)
        refuse(both + "are shards of different plans: " + environmentOf(first.run, kShardKey) + " of " +
               first.shard.plan + " and " + environmentOf(other.run, kShardKey) + " of " + other.shard.plan);
    std::map<std::string, std::string> engines;
    for (const auto& e : first.run.engines) engines[e.name] = identityOf(e);
    for (const auto& e : other.run.engines)
        if (!engines.contains(e.name) || engines[e.name] != identityOf(e))
            refuse(both + "have different versions or builds of the engine " + e.name);
    if (first.run.engines.size() != other.run.engines.size()) refuse(both + "have different engines");
}

/// `texts`: text and folder by the name of a scenario.
void checkTexts(const Part& part, std::map<std::string, std::pair<std::string, fs::path>>& texts) {
    for (const auto& s : part.run.scenarios) {
        const auto [it, isNew] = texts.emplace(s.name, std::pair(s.text, part.folder));
        if (!isNew && it->second.first != s.text)
            refuse("'" + it->second.second.string() + "' and '" + part.folder.string() +
                   "' have different scenarios of the name " + s.name);
    }
}

/// Two folders of the same shard: equal ids must have equal rows.
void checkSameRows(const Part& a, const Part& b) {
    std::map<std::string, const CaseRow*> rows;
    for (const CaseRow& row : a.run.cases) rows[row.id] = &row;
    for (const CaseRow& row : b.run.cases)
        if (const auto it = rows.find(row.id); it != rows.end())
            if (const std::string difference = differenceOfCases(*it->second, row); !difference.empty())
                refuse("case " + row.id + " (" + row.scenario + ", " + row.spec +
                       ") has different rows in '" + a.folder.string() + "' and '" + b.folder.string() +
                       "': " + difference);
}

/// One folder for each shard: the finished one, else that with more cases.
std::map<int, Part> chosenParts(const std::vector<fs::path>& folders) {
    std::map<int, Part> chosen;
    std::map<std::string, std::pair<std::string, fs::path>> texts;
    std::optional<Part> first;
    for (const fs::path& folder : folders) {
        Part part = readPart(folder);
        if (first) checkFits(*first, part);
        if (!first) first = part;
        checkTexts(part, texts);
        const auto it = chosen.find(part.shard.number);
        if (it == chosen.end()) {
            chosen.emplace(part.shard.number, std::move(part));
            continue;
        }
        checkSameRows(it->second, part);
        const auto merit = [](const Part& p) {
            return std::pair(!p.run.finished.empty(), p.run.cases.size());
        };
        if (merit(part) > merit(it->second)) it->second = std::move(part);
    }
    return chosen;
}

/// "2, 5": the shards that are missing or unfinished.
std::string lackingShards(const std::map<int, Part>& parts, int count) {
    std::string lacking;
    for (int number = 1; number <= count; ++number) {
        const auto it = parts.find(number);
        if (it != parts.end() && !it->second.run.finished.empty()) continue;
        lacking += (lacking.empty() ? "" : ", ") + std::to_string(number) +
                   (it == parts.end() ? "" : " (unfinished)");
    }
    return lacking;
}

/// Shards that are all there have every case of the plan.
void checkCount(const std::map<int, Part>& parts, std::size_t planned) {
    std::size_t found = 0;
    for (const auto& [number, part] : parts) found += part.run.cases.size();
    if (found != planned)
        refuse("found " + std::to_string(found) + " cases in the " + std::to_string(parts.size()) +
               " shards, expected the " + std::to_string(planned) + " of the plan");
}

/// Values that differ between shards, each with the shards that have it: "A (shards 1, 3); B (shard 2)".
std::map<std::string, std::string> mergedEnvironment(const std::map<int, Part>& parts) {
    std::map<std::string, std::map<std::string, std::vector<int>>> values;
    for (const auto& [number, part] : parts)
        for (const auto& [key, value] : part.run.environment) values[key][value].push_back(number);
    for (const char* key : {kShardKey, kPlannedKey, kShardVersionKey, "load"}) values.erase(key);
    std::map<std::string, std::string> merged;
    for (const auto& [key, byValue] : values) {
        std::string& text = merged[key];
        if (byValue.size() == 1 || key == "date") {
            text = byValue.begin()->first;
            continue;
        }
        for (const auto& [value, numbers] : byValue) {
            text += (text.empty() ? "" : "; ") + value + (numbers.size() == 1 ? " (shard " : " (shards ");
            for (std::size_t i = 0; i < numbers.size(); ++i)
                text += (i == 0 ? "" : ", ") + std::to_string(numbers[i]);
            text += ")";
        }
    }
    return merged;
}

/// Scenarios in the order of the whole plan: the i-th of shard k stands at place i N + k - 1.
std::vector<std::pair<const Part*, const results::ScenarioRow*>> scenariosInOrder(
    const std::map<int, Part>& parts) {
    std::map<std::size_t, std::pair<const Part*, const results::ScenarioRow*>> places;
    for (const auto& [number, part] : parts)
        for (std::size_t i = 0; i < part.run.scenarios.size(); ++i)
            places[i * part.shard.count + number - 1] = {&part, &part.run.scenarios[i]};
    std::vector<std::pair<const Part*, const results::ScenarioRow*>> ordered;
    for (const auto& [place, scenario] : places) ordered.push_back(scenario);
    return ordered;
}

Run mergedHeader(const std::map<int, Part>& parts, const MergeOptions& options, const std::string& lacking) {
    const Part& first = parts.begin()->second;
    Run run;
    run.suite = first.run.suite;
    run.command = options.command;
    run.started = first.run.started;
    for (const auto& [number, part] : parts) run.started = std::min(run.started, part.run.started);
    run.environment = mergedEnvironment(parts);
    run.environment["merged"] =
        std::to_string(first.shard.count) + " shards" +
        (lacking.empty() ? "" : ", of which these are missing or unfinished: " + lacking);
    run.engines = first.run.engines;
    for (const auto& [part, scenario] : scenariosInOrder(parts)) run.scenarios.push_back(*scenario);
    run.plannedCases = static_cast<std::int64_t>(first.shard.planned);
    return run;
}

/// A command that names the file of a scenario in the shard names that in the merged run.
std::string movedCommand(std::string command, const fs::path& out) {
    const std::string marker = "/scenarios/";
    const auto end = command.find(marker);
    if (end == std::string::npos) return command;
    const auto begin = command.find_last_of(" '", end) + 1;
    return command.replace(begin, end - begin, out.string());
}

bool hasSameTrajectory(const fs::path& from, const fs::path& to) {
    std::error_code error;
    return fs::exists(to, error) && fs::file_size(from, error) == fs::file_size(to, error) &&
           results::trajectoryProblem(to).empty() && results::readFile(from) == results::readFile(to);
}

void copyTrajectory(const fs::path& from, const fs::path& to) {
    if (const std::string problem = results::trajectoryProblem(from); !problem.empty()) refuse(problem);
    if (!hasSameTrajectory(from, to)) results::replaceFile(to, results::readFile(from));
}

/// Opens `out` for this plan, also one in which an earlier merge was interrupted.
bool isBegun(const fs::path& out, const std::string& plan) {
    if (!results::holdsStore(out)) return false;
    const Run present = results::readRun(out);
    if (environmentOf(present, kPlanKey) == plan && environmentOf(present, kShardKey).empty()) return true;
    if (present.started.empty() && present.cases.empty()) return true;
    refuse("'" + out.string() + "' holds another run");
}

}  // namespace

std::string differenceOfCases(const CaseRow& a, const CaseRow& b) {
    const auto timeless = [](CaseRow row) {
        row.wallSeconds = row.cpuSeconds = 0.0;
        row.peakMemoryKiB = 0;
        row.position = 0;
        row.timings.clear();
        row.command.clear();
        return caseToJson(row);
    };
    if (a.stateHash != b.stateHash) return "state_hash";
    const auto difference = nlohmann::json::diff(timeless(a), timeless(b));
    return difference.empty() ? "" : difference.front().at("path").get<std::string>();
}

Run mergeShards(const MergeOptions& options) {
    if (options.shards.empty()) refuse("found no shard");
    const auto parts = chosenParts(options.shards);
    const Shard& shard = parts.begin()->second.shard;
    const std::string lacking = lackingShards(parts, shard.count);
    if (!lacking.empty() && !options.partial)
        refuse("missing or unfinished shards of " + std::to_string(shard.count) + ": " + lacking +
               " (--partial merges the others)");
    if (lacking.empty()) checkCount(parts, shard.planned);
    results::RunWriter writer(options.out, isBegun(options.out, shard.plan));
    const Run header = mergedHeader(parts, options, lacking);
    std::map<std::string, std::string> present;
    for (const CaseRow& row : results::readRun(options.out).cases) present[row.id] = caseToJson(row).dump();
    writer.writeHeader(header);
    results::createFolders(options.out / "scenarios");
    std::vector<std::string> ids;
    std::string finished;
    for (const auto& [part, scenario] : scenariosInOrder(parts)) {
        finished = std::max(finished, part->run.finished);
        results::replaceFile(options.out / "scenarios" / (scenario->name + ".json"), scenario->text);
        for (const CaseRow& stored : part->run.cases) {
            if (stored.scenario != scenario->name) continue;
            CaseRow row = stored;
            row.position = static_cast<std::int64_t>(ids.size());
            row.command = movedCommand(row.command, options.out);
            ids.push_back(row.id);
            if (!row.trajectoryFile.empty())
                copyTrajectory(part->folder / row.trajectoryFile, options.out / row.trajectoryFile);
            const auto it = present.find(row.id);
            if (it == present.end() || it->second != caseToJson(row).dump()) writer.writeCase(row);
        }
    }
    writer.keepOnly(ids);
    Run merged = results::readRun(options.out);
    merged.orders = observedOrders(merged);
    merged.fairness = fairComparisons(merged);
    writer.writeAnalysis(merged);
    if (lacking.empty()) writer.finish(finished);
    return results::readRun(options.out);
}

}  // namespace rigor::validation
