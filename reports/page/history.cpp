// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/page/history.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "reports/encoding/json.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/case_history.hpp"
#include "reports/page/html.hpp"
#include "validation/results/grades.hpp"
#include "validation/results/spec_labels.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::PairBy;
using results::Run;

using Labels = std::map<std::string, std::string>;  ///< short names of specs

Labels labelsOf(const std::vector<CaseHistory>& histories) {
    std::vector<std::string> specs;
    for (const auto& history : histories)
        for (const CaseRow* c : history.cases)
            if (c != nullptr && std::find(specs.begin(), specs.end(), c->spec) == specs.end())
                specs.push_back(c->spec);
    return results::specLabels(specs);
}

Json runsJson(const std::vector<Run>& runs, const Labels& labels) {
    Json list = Json::array();
    for (const Run& run : runs) {
        Json versions = Json::object();
        for (const auto& engine : run.engines)
            if (engine.problem.empty()) versions[engine.name] = engine.version;
        std::set<double, std::greater<>> steps;
        std::set<std::string> specs;
        for (const CaseRow& c : run.cases) {
            steps.insert(c.dt);
            if (const auto label = labels.find(c.spec); label != labels.end()) specs.insert(label->second);
        }
        list.push_back({{"name", folderName(run)},
                        {"title", runTitle(run)},
                        {"started", run.started},
                        {"command", run.command},
                        {"cases", run.cases.size()},
                        {"steps", steps},
                        {"specs", specs},
                        {"versions", versions}});
    }
    return list;
}

/// Name of what the cases of a history have in common, beside scenario and time step.
std::string labelOf(const CaseRow& c, PairBy by, const Labels& labels) {
    return by == PairBy::Engine ? c.preset : by == PairBy::Spec ? c.engine : labels.at(c.spec);
}

/// Name of what a case has of its own: its engine, or its spec without the name of the engine.
std::string ownLabelOf(const CaseRow& c, PairBy by, const Labels& labels) {
    if (by == PairBy::Engine) return c.engine;
    const std::string& label = labels.at(c.spec);
    return label.starts_with(c.engine + " ") ? label.substr(c.engine.size() + 1) : label;
}

void addCase(Json& out, const CaseHistory& history, const CaseRow* c, const std::string* replay) {
    const auto* metric = c ? findMetric(*c, history.metric.name) : nullptr;
    const auto* step = c ? stepTiming(*c) : nullptr;
    out["error"].push_back(metric ? number(metric->value) : Json(nullptr));
    out["at"].push_back(metric && metric->at >= 0.0 ? number(metric->at) : Json(nullptr));
    out["relative"].push_back(c ? number(c->accuracy.relative) : Json(nullptr));
    out["grade"].push_back(c ? results::gradeName(c->accuracy.grade) : "");
    out["outcome"].push_back(c ? results::outcomeName(c->outcome) : "");
    out["time"].push_back(step ? number(step->median) : Json(nullptr));
    out["low"].push_back(step ? number(step->low) : Json(nullptr));
    out["high"].push_back(step ? number(step->high) : Json(nullptr));
    out["replay"].push_back(replay ? Json(*replay) : Json(nullptr));
}

Json seriesJson(const CaseHistory& history, PairBy by, const Labels& labels, const HistoryReplays& replays) {
    const CaseRow& any = history.newest();
    Json out{{"scenario", any.scenario},      {"title", history.scenario->title},  {"spec", any.spec},
             {"engine", any.engine},          {"label", labelOf(any, by, labels)}, {"dt", number(any.dt)},
             {"metric", history.metric.name}, {"unit", history.metric.unit},       {"scene", nullptr}};
    if (const auto scene = replays.scenes.find(any.scenario); scene != replays.scenes.end())
        out["scene"] = scene->second;
    for (const char* key : {"error", "at", "relative", "grade", "outcome", "time", "low", "high", "replay"})
        out[key] = Json::array();
    for (std::size_t r = 0; r < history.cases.size(); ++r) {
        const CaseRow* c = history.cases[r];
        const auto replay = c ? replays.names.find({r, c->scenario, c->dt}) : replays.names.end();
        addCase(out, history, c, replay == replays.names.end() ? nullptr : &replay->second);
    }
    if (by == PairBy::Nothing) return out;
    out["cases"] = Json::array();
    for (const CaseRow* c : history.cases)
        out["cases"].push_back(
            c ? Json{{"spec", c->spec}, {"label", ownLabelOf(*c, by, labels)}, {"dt", number(c->dt)}}
              : Json(nullptr));
    return out;
}

std::string historyJson(const std::vector<Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays, PairBy by) {
    const auto histories = historiesOf(runs, by);
    const Labels labels = labelsOf(histories);
    Json series = Json::array(), changes = Json::array();
    for (const auto& history : histories) series.push_back(seriesJson(history, by, labels, replays));
    for (const auto& text : comparisons) changes.push_back(text.empty() ? Json(nullptr) : Json::parse(text));
    const Json page{{"pair", results::pairByName(by)},
                    {"runs", runsJson(runs, labels)},
                    {"changes", changes},
                    {"series", series}};
    return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string historyPage(const std::vector<Run>& runs, const std::vector<std::string>& comparisons,
                        const HistoryReplays& replays, PairBy by) {
    return htmlHistory(historyJson(runs, comparisons, replays, by));
}

std::string historyCsv(const std::vector<Run>& runs, PairBy by) {
    std::string out =
        "run,started,scenario,spec,dt,metric,unit,error,relative_error,grade,outcome,time,time_low,time_high,"
        "series\n";
    std::size_t series = 0;
    for (const auto& history : historiesOf(runs, by)) {
        ++series;
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
                  text(step ? std::optional(step->median) : none), text(step ? step->low : none),
                  text(step ? step->high : none)})
                out += csvField(field) + ",";
            out += std::to_string(series) + "\n";
        }
    }
    return out;
}

}  // namespace rigor::report
