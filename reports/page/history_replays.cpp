// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/page/history_replays.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/derived_runs.hpp"
#include "reports/model/view_model.hpp"
#include "reports/replay/data.hpp"

namespace rigor::report {
namespace {

namespace fs = std::filesystem;
using results::PairBy;
using results::Run;

struct Found {
    std::size_t run;
    double dt;
    fs::path from;
    std::string name;
};
/// Replays by scenario and time step [s], 0 where the runs differ in that.
using Groups = std::map<std::pair<std::string, double>, std::vector<Found>>;

/// Replay files beside the report of a run.
void findReplays(const Run& run, std::size_t index, PairBy by, Groups& found) {
    const Run shown = withoutDerivedRuns(run);
    const ViewModel view(shown);
    for (std::size_t i = 0; i < shown.scenarios.size(); ++i) {
        const auto steps = replaySteps(view, i);
        for (std::size_t j = 0; j < steps.size(); ++j) {
            const std::string name = replayName(i, j);
            const fs::path from = fs::path(run.directory) / "data" / (name + ".js");
            if (fs::exists(from))
                found[{shown.scenarios[i].name, by == PairBy::TimeStep ? 0.0 : steps[j]}].push_back(
                    {index, steps[j], from, "run-" + std::to_string(index) + "-" + name});
        }
    }
}

/// Content of a data file: all that follows its name.
std::string contentOf(const fs::path& from) {
    std::ifstream in(from, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const auto comma = text.find(',');
    if (!in || comma == std::string::npos)
        throw std::runtime_error(from.string() + ": cannot be read as a data file of a report");
    return text.substr(comma);
}

}  // namespace

HistoryReplays historyReplays(const std::vector<Run>& runs, std::size_t newest, PairBy by) {
    Groups found;
    for (std::size_t r = runs.size() - std::min(newest, runs.size()); r < runs.size(); ++r)
        findReplays(runs[r], r, by, found);
    std::map<std::string, std::string> texts;  // the newest run comes last and its files stay
    for (const Run& run : runs)
        for (const auto& scenario : run.scenarios) texts[scenario.name] = scenario.text;
    HistoryReplays out;
    for (const auto& [key, all] : found) {
        if (all.front().run == all.back().run) continue;
        const std::string& scenario = key.first;
        std::map<std::string, std::string> known;  // content to name: runs with the same frames share a file
        for (const Found& f : all) {
            const auto [same, isNew] = known.emplace(contentOf(f.from), f.name);
            if (isNew) out.files.push_back({f.from, f.name});
            out.names[{f.run, scenario, f.dt}] = same->second;
        }
        const std::string scene = "scene-" + std::to_string(out.scenes.size());
        if (out.scenes.emplace(scenario, scene).second) out.texts[scene] = texts[scenario];
    }
    return out;
}

void writeHistoryReplays(const HistoryReplays& replays, const fs::path& folder) {
    if (replays.files.empty()) return;
    fs::create_directories(folder);
    for (const auto& [name, text] : replays.texts) writeFile(folder / (name + ".js"), dataFile(name, text));
    for (const auto& file : replays.files)
        writeFile(folder / (file.name + ".js"), "rigorData(\"" + file.name + "\"" + contentOf(file.from));
}

}  // namespace rigor::report
