// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/studies/print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/results/values.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;
using Table = std::vector<std::vector<std::string>>;

std::string shown(double value) {
    if (std::isnan(value)) return "-";
    if (std::isinf(value)) return "broke";
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string stepText(double dt) {
    const double rate = 1.0 / dt;
    if (std::abs(rate - std::round(rate)) < 1e-6 * rate && rate > 1.5)
        return "1/" + std::to_string(std::lround(rate));
    return shown(dt);
}

template <class Get>
bool varies(const std::vector<const StudyResultRow*>& rows, Get&& get) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const StudyResultRow* r) { return get(*r) != get(*rows.front()); });
}

/// Columns: what varies in the grid, the variant, the metrics, and how the run ended where it did not end
/// well.
Table partTable(const StudyResult& result, std::size_t part) {
    std::vector<const StudyResultRow*> rows;
    for (const StudyResultRow& row : result.rows)
        if (row.row.part == part) rows.push_back(&row);
    const auto& metrics = result.study.parts[part].metrics;
    const bool scenarios = varies(rows, [](const StudyResultRow& r) { return r.row.base; });
    const bool steps = varies(rows, [](const StudyResultRow& r) { return r.row.dt; });
    const bool ended = varies(rows, [](const StudyResultRow& r) { return r.outcome; }) ||
                       rows.front()->outcome != results::Outcome::Completed;
    Table table(1);
    auto& head = table.front();
    if (scenarios) head.push_back("scenario");
    for (const auto& [key, value] : rows.front()->row.parameters) head.push_back(key);
    if (steps) head.push_back("dt");
    head.push_back("variant");
    for (std::size_t i = 0; i < metrics.size(); ++i) {
        std::string unit;
        for (const StudyResultRow* row : rows)
            if (unit.empty()) unit = row->values[i].unit;
        head.push_back(metrics[i] + (unit.empty() || unit == "1" ? "" : " [" + unit + "]"));
    }
    if (ended) head.push_back("outcome");
    for (const StudyResultRow* row : rows) {
        auto& line = table.emplace_back();
        if (scenarios) line.push_back(row->row.base);
        for (const auto& [key, value] : row->row.parameters) line.push_back(value);
        if (steps) line.push_back(stepText(row->row.dt));
        line.push_back(row->row.variant);
        for (const StudyValue& value : row->values)
            line.push_back(!value.value         ? "-"
                           : value.note.empty() ? shown(*value.value)
                                                : shown(*value.value) + " (" + value.note + ")");
        if (ended) line.push_back(row->ran ? results::outcomeName(row->outcome) : "not run");
    }
    return table;
}

std::string verdictText(const SymptomVerdict& s) {
    return std::string(s.shown ? "shown" : "NOT shown") + ", " + (s.cured ? "cured" : "NOT cured");
}

Table symptomTable(const StudyResult& result) {
    Table table{{"symptom", "metric", "fault", "value", "cure", "value", "switched", "verdict"}};
    for (const SymptomVerdict& s : result.symptoms) {
        const auto& part = result.study.parts[s.part];
        std::string switched;
        for (const auto& difference : s.switched) switched += (switched.empty() ? "" : "; ") + difference;
        table.push_back({part.name, part.symptom->metric + (part.symptom->growth ? " ~ N^p" : ""),
                         part.symptom->fault, shown(s.fault), part.symptom->cure, shown(s.cure), switched,
                         verdictText(s)});
    }
    return table;
}

std::string rangeText(const std::optional<double>& least, const std::optional<double>& most) {
    if (least && most) return *least == *most ? shown(*least) : shown(*least) + " .. " + shown(*most);
    if (least) return ">= " + shown(*least);
    return most ? "<= " + shown(*most) : "-";
}

std::string whereText(const scenario::StudyFinding& finding) {
    std::string text = finding.variant;
    for (const auto& [key, value] : finding.where)
        text += ", " + (key == "scenario" ? value : key + "=" + value);
    return text;
}

Table findingTable(const StudyResult& result) {
    Table table{{"finding", "where", "metric", "expected", "found", "verdict", "source"}};
    for (const FindingVerdict& f : result.findings) {
        const auto& finding = result.study.parts[f.part].findings[f.finding];
        table.push_back({finding.statement, whereText(finding), finding.metric,
                         rangeText(finding.atLeast, finding.atMost), rangeText(f.least, f.greatest),
                         f.holds ? "holds" : "DOES NOT HOLD", finding.source});
    }
    return table;
}

std::string aligned(const Table& table) {
    std::vector<std::size_t> widths;
    for (const auto& row : table) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : table) {
        text += "  ";
        for (std::size_t i = 0; i < row.size(); ++i)
            text += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

std::string markdownTable(const Table& table) {
    std::string text;
    for (std::size_t r = 0; r < table.size(); ++r) {
        for (const auto& cell : table[r]) text += "| " + cell + " ";
        text += "|\n";
        if (r > 0) continue;
        for (std::size_t i = 0; i < table[r].size(); ++i) text += "|---";
        text += "|\n";
    }
    return text;
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string parameterText(const StudyRow& row) {
    std::string text;
    for (const auto& [key, value] : row.parameters) text += (text.empty() ? "" : " ") + key + "=" + value;
    return text;
}

/// Note of the metric, and the names of its values that are not finite.
std::string noteOf(const StudyValue& value) {
    const std::string nonFinite =
        results::nonFiniteNote({{"value", value.value}, {"low", value.low}, {"high", value.high}});
    return value.note + (value.note.empty() || nonFinite.empty() ? "" : "; ") + nonFinite;
}

std::string csv(const StudyResult& result) {
    std::string text =
        "part,scenario,parameters,dt,variant,spec,case,outcome,metric,value,unit,low,high,note\n";
    for (const StudyResultRow& row : result.rows) {
        const auto& part = result.study.parts[row.row.part];
        for (std::size_t i = 0; i < part.metrics.size(); ++i)
            text += part.name + "," + row.row.scenario + "," + csvField(parameterText(row.row)) + "," +
                    results::exactText(row.row.dt) + "," + csvField(row.row.variant) + "," +
                    csvField(row.row.spec) + "," + row.row.caseId + "," +
                    (row.ran ? results::outcomeName(row.outcome) : "not run") + "," +
                    csvField(part.metrics[i]) + "," + results::finiteText(row.values[i].value) + "," +
                    row.values[i].unit + "," + results::finiteText(row.values[i].low) + "," +
                    results::finiteText(row.values[i].high) + "," + csvField(noteOf(row.values[i])) + "\n";
    }
    return text;
}

std::string markdown(const StudyResult& result, const std::string& command) {
    std::string text = "# " + (result.study.title.empty() ? result.study.name : result.study.title) +
                       "\n\n`" + command + "`\n";
    if (!result.study.description.empty()) text += "\n" + result.study.description + "\n";
    if (!result.symptoms.empty()) text += "\n## Symptoms\n\n" + markdownTable(symptomTable(result));
    if (!result.findings.empty()) text += "\n## Findings\n\n" + markdownTable(findingTable(result));
    for (std::size_t i = 0; i < result.study.parts.size(); ++i) {
        const auto& part = result.study.parts[i];
        text += "\n## " + part.name + (part.title.empty() ? "" : ": " + part.title) + "\n\n";
        if (!part.description.empty()) text += part.description + "\n\n";
        text += markdownTable(partTable(result, i));
    }
    return text;
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::trunc | std::ios::binary);
    out << text;
    if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

Json optionalJson(const std::optional<double>& value) {
    return value ? Json(finiteToJson(*value)) : Json(nullptr);
}

Json rowJson(const StudyResult& result, const StudyResultRow& row) {
    const auto& metrics = result.study.parts[row.row.part].metrics;
    Json values = Json::object(), parameters = Json::object();
    for (const auto& [key, value] : row.row.parameters) parameters[key] = value;
    for (std::size_t i = 0; i < metrics.size(); ++i)
        values[metrics[i]] = {{"value", optionalJson(row.values[i].value)},
                              {"unit", row.values[i].unit},
                              {"low", optionalJson(row.values[i].low)},
                              {"high", optionalJson(row.values[i].high)},
                              {"note", noteOf(row.values[i])}};
    return {{"scenario", row.row.scenario},
            {"base", row.row.base},
            {"parameters", parameters},
            {"dt", row.row.dt},
            {"bodies", row.row.bodies},
            {"variant", row.row.variant},
            {"spec", row.row.spec},
            {"case", row.row.caseId},
            {"ran", row.ran},
            {"outcome", results::outcomeName(row.outcome)},
            {"reason", row.reason},
            {"metrics", values}};
}

Json findingJson(const StudyResult& result, const FindingVerdict& f) {
    const auto& part = result.study.parts[f.part];
    const auto& finding = part.findings[f.finding];
    Json where = Json::object();
    for (const auto& [key, value] : finding.where) where[key] = value;
    return {{"part", part.name},
            {"statement", finding.statement},
            {"source", finding.source},
            {"variant", finding.variant},
            {"where", where},
            {"metric", finding.metric},
            {"at_least", optionalJson(finding.atLeast)},
            {"at_most", optionalJson(finding.atMost)},
            {"least", optionalJson(f.least)},
            {"greatest", optionalJson(f.greatest)},
            {"holds", f.holds}};
}

}  // namespace

std::string studyText(const StudyResult& result) {
    std::string text;
    for (std::size_t i = 0; i < result.study.parts.size(); ++i) {
        const auto& part = result.study.parts[i];
        text += part.name + (part.title.empty() ? "" : ": " + part.title) + "\n" +
                aligned(partTable(result, i)) + "\n";
    }
    if (!result.symptoms.empty()) text += "symptoms\n" + aligned(symptomTable(result)) + "\n";
    if (!result.findings.empty()) text += "findings\n" + aligned(findingTable(result)) + "\n";
    return text;
}

Json studyJson(const StudyResult& result) {
    Json out{{"name", result.study.name},
             {"title", result.study.title},
             {"description", result.study.description},
             {"green", studyIsGreen(result)},
             {"symptoms", Json::array()},
             {"findings", Json::array()},
             {"parts", Json::array()}};
    for (const SymptomVerdict& s : result.symptoms) {
        const auto& part = result.study.parts[s.part];
        out["symptoms"].push_back({{"name", part.name},
                                   {"metric", part.symptom->metric},
                                   {"growth", part.symptom->growth},
                                   {"fault", part.symptom->fault},
                                   {"fault_value", Json(finiteToJson(s.fault))},
                                   {"fault_at_least", part.symptom->faultAtLeast},
                                   {"cure", part.symptom->cure},
                                   {"cure_value", Json(finiteToJson(s.cure))},
                                   {"cure_at_most", part.symptom->cureAtMost},
                                   {"switched", s.switched},
                                   {"shown", s.shown},
                                   {"cured", s.cured}});
    }
    for (const FindingVerdict& f : result.findings) out["findings"].push_back(findingJson(result, f));
    for (std::size_t i = 0; i < result.study.parts.size(); ++i) {
        const auto& part = result.study.parts[i];
        Json entry{{"name", part.name},
                   {"title", part.title},
                   {"description", part.description},
                   {"rows", Json::array()}};
        for (const StudyResultRow& row : result.rows)
            if (row.row.part == i) entry["rows"].push_back(rowJson(result, row));
        out["parts"].push_back(std::move(entry));
    }
    return out;
}

std::vector<std::filesystem::path> writeStudyFiles(const StudyResult& result,
                                                   const std::filesystem::path& folder,
                                                   const std::string& command) {
    const std::vector<std::filesystem::path> files{folder / "study.csv", folder / "study.md",
                                                   folder / "study.json"};
    writeText(files[0], csv(result));
    writeText(files[1], markdown(result, command));
    writeText(files[2], studyJson(result).dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    return files;
}

}  // namespace rigor::validation
