// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The result of a fit as tables, CSV and JSON.
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "validation/fit/fit.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using nlohmann::ordered_json;
using Row = std::vector<std::string>;

std::string brief(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}
std::string brief(const Interval& i) {
    return brief(i.low) + " .. " + brief(i.high);
}
const ScoreSummary* find(const std::vector<FitScore>& scores, const char* part, const char* point,
                         const std::string& metric) {
    for (const FitScore& s : scores)
        if (s.part == part && s.point == point && s.metric == metric) return &s.score;
    return nullptr;
}

std::vector<Row> parameterRows(const FitResult& r) {
    std::vector<Row> rows{{"engine"}};
    for (const FitParameter& p : r.parameters) {
        rows[0].push_back(p.name + " (was " + brief(p.start) + ")");
        rows[0].push_back("95 %");
    }
    rows[0].push_back("points");
    for (const EngineFit& e : r.engines) {
        Row row{e.spec};
        for (const FittedParameter& p : e.parameters) {
            row.push_back(brief(p.value));
            row.push_back(brief(p.interval));
        }
        row.push_back(std::to_string(e.evaluations));
        rows.push_back(std::move(row));
    }
    return rows;
}

void addScore(Row& row, const ScoreSummary* s) {
    if (s == nullptr) {
        row.insert(row.end(), {"", ""});
        return;
    }
    row.push_back(brief(s->mean) + " (" + brief(s->meanInterval) + ")");
    row.push_back(brief(s->median) + " (" + brief(s->medianInterval) + ")" +
                  (s->broken > 0 ? ", " + std::to_string(s->broken) + " broke" : ""));
}

std::vector<Row> scoreRows(const FitResult& r, const std::string& metric) {
    std::vector<Row> rows{{"test", "unfitted: mean (95 %)", "median (95 %)", "fitted: mean (95 %)",
                           "median (95 %)", "train, fitted: mean"}};
    for (const EngineFit& e : r.engines) {
        Row row{e.spec};
        addScore(row, find(e.scores, "test", "unfitted", metric));
        addScore(row, find(e.scores, "test", "fitted", metric));
        const ScoreSummary* train = find(e.scores, "train", "fitted", metric);
        row.push_back(train == nullptr ? "" : brief(train->mean));
        rows.push_back(std::move(row));
    }
    for (const Baseline& y : r.baselines) {
        Row row{y.title};
        addScore(row, find(y.scores, "test", "unfitted", metric));
        row.insert(row.end(), {"", "", ""});
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<Row> changeRows(const FitResult& r) {
    std::vector<Row> rows{{"engine", "fitted - unfitted, test mean", "95 %"}};
    for (const EngineFit& e : r.engines) rows.push_back({e.spec, brief(e.change), brief(e.changeInterval)});
    return rows;
}

std::string markdownTable(const std::vector<Row>& rows) {
    std::string text;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        text += "|";
        for (const std::string& cell : rows[k]) text += " " + cell + " |";
        text += "\n";
        if (k > 0) continue;
        text += "|";
        for (std::size_t i = 0; i < rows[k].size(); ++i) text += "---|";
        text += "\n";
    }
    return text;
}

std::string plainTable(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(rows[0].size());
    for (const Row& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string tables(const FitResult& r, std::string (*table)(const std::vector<Row>&),
                   const std::string& heading) {
    std::string text = heading + "Fitted on " + std::to_string(r.train) +
                       " recordings: " + summaryName(r.summary) + " of " + r.metric + "\n\n" +
                       table(parameterRows(r)) + "\n";
    for (std::size_t m = 0; m < r.metrics.size(); ++m)
        text += heading + r.metrics[m] + " [" + r.units[m] + "], " + std::to_string(r.test) +
                " recordings that were not fitted on\n\n" + table(scoreRows(r, r.metrics[m])) + "\n";
    return text + heading + "What the fit changed in " + r.metric + "\n\n" + table(changeRows(r));
}

ordered_json intervalJson(const Interval& i) {
    return {finiteToJson(i.low), finiteToJson(i.high)};
}

ordered_json scoresJson(const std::vector<FitScore>& scores) {
    ordered_json list = ordered_json::array();
    for (const FitScore& s : scores)
        list.push_back({{"part", s.part},
                        {"point", s.point},
                        {"metric", s.metric},
                        {"runs", s.score.runs},
                        {"broken", s.score.broken},
                        {"mean", finiteToJson(s.score.mean)},
                        {"mean_95", intervalJson(s.score.meanInterval)},
                        {"median", finiteToJson(s.score.median)},
                        {"median_95", intervalJson(s.score.medianInterval)}});
    return list;
}

std::string csvLines(const std::string& who, const std::vector<FitScore>& scores) {
    std::string text;
    for (const FitScore& s : scores) {
        text += "\"" + who + "\"," + s.part + "," + s.point + "," + s.metric + "," +
                std::to_string(s.score.runs) + "," + std::to_string(s.score.broken);
        const std::initializer_list<results::NamedNumber> numbers{
            {"mean", s.score.mean},
            {"mean_low", s.score.meanInterval.low},
            {"mean_high", s.score.meanInterval.high},
            {"median", s.score.median},
            {"median_low", s.score.medianInterval.low},
            {"median_high", s.score.medianInterval.high}};
        for (const auto& [name, value] : numbers) text += "," + results::finiteText(value);
        text += "," + results::nonFiniteNote(numbers) + "\n";
    }
    return text;
}

}  // namespace

std::string fitText(const FitResult& r) {
    return tables(r, plainTable, "");
}

std::string fitMarkdown(const FitResult& r) {
    std::string text = "# " + (r.title.empty() ? r.name : r.title) + "\n\n```sh\n" + r.command + "\n```\n\n" +
                       tables(r, markdownTable, "## ");
    text +=
        "\nIntervals: of a parameter, bootstrap over the training recordings and half a step of the grid on "
        "either "
        "side; of a mean, bootstrap percentiles; of a median, order statistics. Seed " +
        std::to_string(r.seed) +
        ". A run that broke counts as infinite. Every evaluation is in "
        "`evaluations.jsonl`.\n";
    for (const EngineFit& e : r.engines)
        if (!e.run.empty())
            text +=
                "\n- [" + e.spec + "](" + e.run + "/index.html): every scored run with the fitted values\n";
    return text;
}

std::string fitCsv(const FitResult& r) {
    std::string text =
        "who,part,point,metric,runs,broken,mean,mean_low,mean_high,median,median_low,median_high,non_"
        "finite\n";
    for (const EngineFit& e : r.engines) {
        for (std::size_t i = 0; i < e.parameters.size(); ++i)
            text += "\"" + e.spec + "\",train,parameter," + r.parameters[i].name + "," +
                    std::to_string(r.train) + ",0," + results::finiteText(e.parameters[i].value) + "," +
                    results::finiteText(e.parameters[i].interval.low) + "," +
                    results::finiteText(e.parameters[i].interval.high) + ",,,,\n";
        text += csvLines(e.spec, e.scores);
    }
    for (const Baseline& y : r.baselines) text += csvLines(y.name, y.scores);
    return text;
}

ordered_json fitToJson(const FitResult& r) {
    ordered_json engines = ordered_json::array(), baselines = ordered_json::array();
    for (const EngineFit& e : r.engines) {
        ordered_json parameters = ordered_json::array();
        for (std::size_t i = 0; i < e.parameters.size(); ++i)
            parameters.push_back({{"name", r.parameters[i].name},
                                  {"key", r.parameters[i].key},
                                  {"value", finiteToJson(e.parameters[i].value)},
                                  {"interval_95", intervalJson(e.parameters[i].interval)},
                                  {"start", r.parameters[i].start}});
        engines.push_back({{"spec", e.spec},
                           {"parameters", parameters},
                           {"evaluations", e.evaluations},
                           {"scores", scoresJson(e.scores)},
                           {"change", finiteToJson(e.change)},
                           {"change_95", intervalJson(e.changeInterval)},
                           {"run", e.run}});
    }
    for (const Baseline& y : r.baselines)
        baselines.push_back({{"name", y.name}, {"title", y.title}, {"scores", scoresJson(y.scores)}});
    return {{"name", r.name},
            {"title", r.title},
            {"command", r.command},
            {"metric", r.metric},
            {"summary", summaryName(r.summary)},
            {"train", r.train},
            {"test", r.test},
            {"seed", r.seed},
            {"engines", engines},
            {"baselines", baselines}};
}

}  // namespace rigor::validation
