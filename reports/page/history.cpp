// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/page/history.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include "reports/encoding/json.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/html.hpp"
#include "validation/results/grades.hpp"
#include "validation/results/spec_labels.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::Run;

/// A case through the runs; null where a run does not have it.
struct CaseHistory {
    const results::ScenarioRow* scenario = nullptr;
    MainMetric metric;
    std::vector<const CaseRow*> cases;
};

/// Histories by scenario, spec and time step, in the order in which they first appear.
std::vector<CaseHistory> historiesOf(const std::vector<Run>& runs) {
    std::vector<CaseHistory> list;
    std::map<std::tuple<std::string, std::string, double>, std::size_t> known;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const ViewModel view(runs[r]);
        std::map<std::string, std::size_t> scenarios;
        for (std::size_t i = 0; i < runs[r].scenarios.size(); ++i) scenarios[runs[r].scenarios[i].name] = i;
        for (const CaseRow& c : runs[r].cases) {
            const auto found = scenarios.find(c.scenario);
            if (found == scenarios.end()) continue;
            const auto [at, isNew] = known.emplace(std::tuple(c.scenario, c.spec, c.dt), list.size());
            if (isNew) list.emplace_back();
            CaseHistory& history = list[at->second];
            history.scenario = &runs[r].scenarios[found->second];
            history.metric = view.mainMetric(found->second);
            history.cases.resize(runs.size());
            history.cases[r] = &c;
        }
    }
    return list;
}

/// The folder's own name, also of "runs/first/".
std::string folderName(const Run& run) {
    const std::filesystem::path folder(run.directory);
    return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

Json runsJson(const std::vector<Run>& runs) {
    Json list = Json::array();
    for (const Run& run : runs) {
        Json versions = Json::object();
        for (const auto& engine : run.engines)
            if (engine.problem.empty()) versions[engine.name] = engine.version;
        list.push_back({{"name", folderName(run)},
                        {"title", runTitle(run)},
                        {"started", run.started},
                        {"command", run.command},
                        {"cases", run.cases.size()},
                        {"versions", versions}});
    }
    return list;
}

Json seriesJson(const CaseHistory& history, std::size_t runs, const std::string& label,
                const HistoryReplays& replays) {
    const CaseRow* any = nullptr;
    for (const CaseRow* c : history.cases)
        if (c != nullptr) any = c;
    Json out{{"scenario", any->scenario},
             {"title", history.scenario->title},
             {"spec", any->spec},
             {"engine", any->engine},
             {"label", label},
             {"dt", number(any->dt)},
             {"metric", history.metric.name},
             {"unit", history.metric.unit},
             {"scene", nullptr}};
    if (const auto scene = replays.scenes.find(any->scenario); scene != replays.scenes.end())
        out["scene"] = scene->second;
    for (const char* key : {"error", "relative", "grade", "outcome", "time", "low", "high", "replay"})
        out[key] = Json::array();
    for (std::size_t r = 0; r < runs; ++r) {
        const CaseRow* c = r < history.cases.size() ? history.cases[r] : nullptr;
        const auto* metric = c ? findMetric(*c, history.metric.name) : nullptr;
        const auto* step = c ? stepTiming(*c) : nullptr;
        out["error"].push_back(metric ? number(metric->value) : Json(nullptr));
        out["relative"].push_back(c ? number(c->accuracy.relative) : Json(nullptr));
        out["grade"].push_back(c ? results::gradeName(c->accuracy.grade) : "");
        out["outcome"].push_back(c ? results::outcomeName(c->outcome) : "");
        out["time"].push_back(step ? number(step->median) : Json(nullptr));
        out["low"].push_back(step ? number(step->low) : Json(nullptr));
        out["high"].push_back(step ? number(step->high) : Json(nullptr));
        const auto replay = replays.names.find({r, any->scenario, any->dt});
        out["replay"].push_back(c && replay != replays.names.end() ? Json(replay->second) : Json(nullptr));
    }
    return out;
}

std::map<std::string, std::string> labelsOf(const std::vector<CaseHistory>& histories) {
    std::vector<std::string> specs;
    for (const auto& history : histories)
        for (const CaseRow* c : history.cases)
            if (c != nullptr && std::find(specs.begin(), specs.end(), c->spec) == specs.end())
                specs.push_back(c->spec);
    return results::specLabels(specs);
}

std::string historyJson(const std::vector<Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays) {
    const auto histories = historiesOf(runs);
    const auto labels = labelsOf(histories);
    Json series = Json::array(), changes = Json::array();
    for (const auto& history : histories) {
        std::string spec;
        for (const CaseRow* c : history.cases)
            if (c != nullptr) spec = c->spec;
        series.push_back(seriesJson(history, runs.size(), labels.at(spec), replays));
    }
    for (const auto& text : comparisons) changes.push_back(text.empty() ? Json(nullptr) : Json::parse(text));
    const Json page{{"runs", runsJson(runs)}, {"changes", changes}, {"series", series}};
    return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string historyPage(const std::vector<Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays) {
    return htmlHistory(historyJson(runs, comparisons, replays));
}

std::string historyCsv(const std::vector<Run>& runs) {
    std::string out =
        "run,started,scenario,spec,dt,metric,unit,error,relative_error,grade,outcome,time,time_low,time_"
        "high\n";
    for (const auto& history : historiesOf(runs))
        for (std::size_t r = 0; r < history.cases.size(); ++r) {
            const CaseRow* c = history.cases[r];
            if (c == nullptr) continue;
            const auto* metric = findMetric(*c, history.metric.name);
            const auto* step = stepTiming(*c);
            const auto text = [](const std::optional<double>& value) {
                return value ? finiteText(*value) : std::string();
            };
            const std::optional<double> none;
            for (const std::string& field :
                 {folderName(runs[r]), runs[r].started, c->scenario, c->spec, fullNumber(c->dt),
                  history.metric.name, history.metric.unit,
                  text(metric ? std::optional(metric->value) : none), text(c->accuracy.relative),
                  std::string(results::gradeName(c->accuracy.grade)),
                  std::string(results::outcomeName(c->outcome)),
                  text(step ? std::optional(step->median) : none), text(step ? step->low : none)})
                out += csvField(field) + ",";
            out += text(step ? step->high : none) + "\n";
        }
    return out;
}

}  // namespace rigor::report
