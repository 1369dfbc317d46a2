// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/collide/print.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/results/counted.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;
using scenario::Vec3;

constexpr std::size_t kPage = 60;  ///< lines of results that are shown by default

Json number(const std::optional<double>& value) {
    return value ? Json(finiteToJson(*value)) : Json(nullptr);
}
Json vector(const std::optional<Vec3>& v, int dimension) {
    if (!v) return nullptr;
    Json list = Json::array();
    for (const double x : {v->x, v->y, v->z})
        if (list.size() < static_cast<std::size_t>(dimension)) list.push_back(Json(finiteToJson(x)));
    return list;
}
Json vectors(const std::vector<Vec3>& list, int dimension) {
    Json out = Json::array();
    for (const Vec3& v : list) out.push_back(vector(v, dimension));
    return out;
}

Json truthJson(const CollideTruth& truth, int dimension) {
    Json out{{"source", truth.source}};
    if (truth.source == "none") return out;
    out["signed_distance"] = finiteToJson(truth.signedDistance);
    out["overlap"] = truth.signedDistance < 0.0;
    out["normals"] = vectors(truth.normals, dimension);
    out["continuum"] = truth.continuum;
    out["witness_a"] = vector(truth.witnessA, dimension);
    out["witness_b"] = vector(truth.witnessB, dimension);
    if (!truth.conflict.empty()) out["conflict"] = truth.conflict;
    return out;
}

Json answerJson(const std::string& spec, const CollideAnswer& a, int dimension) {
    Json out{{"engine", spec}, {"verdict", collideVerdictName(a.verdict)}};
    if (!a.message.empty()) out["message"] = a.message;
    if (!a.answered) return out;
    out["overlap"] = a.overlap;
    out["signed_distance"] = number(a.signedDistance);
    out["depth"] = a.signedDistance ? Json(finiteToJson(-*a.signedDistance)) : Json(nullptr);
    out["normal"] = vector(a.normal, dimension);
    out["witness_a"] = vector(a.witnessA, dimension);
    out["witness_b"] = vector(a.witnessB, dimension);
    out["contacts"] = a.contacts;
    out["distance_error"] = number(a.distanceError);
    out["normal_angle"] = number(a.normalAngle);
    out["normal_excess"] = number(a.normalExcess);
    out["point_error"] = number(a.pointError);
    out["seconds"] = finiteToJson(a.seconds);
    return out;
}

Json summaryJson(const CollideSummary& s, bool isSingle) {
    return {{"name", s.spec},
            {"precision", isSingle ? "f32" : "f64"},
            {"asked", s.queried},
            {"answered", s.answered},
            {"unsupported", s.unsupported},
            {"undecided", s.undecided},
            {"failed", s.failed},
            {"missed", s.missed},
            {"spurious", s.spurious},
            {"wrong_depth", s.wrongDepth},
            {"wrong_normal", s.wrongNormal},
            {"depth_error_max", number(s.depthErrorMax)},
            {"depth_error_median", number(s.depthErrorMedian)},
            {"depth_relative_max", number(s.depthRelativeMax)},
            {"distance_error_max", number(s.distanceErrorMax)},
            {"normal_angle_max", number(s.normalAngleMax)},
            {"normal_excess_max", number(s.normalExcessMax)},
            {"point_error_max", number(s.pointErrorMax)},
            {"point_error_median", number(s.pointErrorMedian)},
            {"microseconds_median", finiteToJson(s.microsecondsMedian)}};
}

std::string shown(const std::optional<double>& value, const char* format = "%.3g") {
    if (!value) return "-";
    char text[40];
    std::snprintf(text, sizeof text, format, *value);
    return text;
}

std::string shown(const std::optional<Vec3>& v) {
    if (!v) return "-";
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g,%.6g,%.6g)", v->x, v->y, v->z);
    return text;
}

std::string answerLine(const CollideCase& c, const std::string& spec, const CollideAnswer& a) {
    std::string line = c.query.name + "  " + spec + "  " + collideVerdictName(a.verdict);
    if (!a.answered) return line + (a.message.empty() ? "" : ": " + a.message);
    line += a.overlap ? "  overlap" : "  apart";
    line += " sd=" + shown(a.signedDistance, "%.10g");
    if (c.truth.source != "none") line += " (exact " + shown(c.truth.signedDistance, "%.10g") + ")";
    line += " n=" + shown(a.normal) + " on_a=" + shown(a.witnessA) + " on_b=" + shown(a.witnessB);
    if (a.distanceError) line += " err=" + shown(a.distanceError);
    if (a.normalAngle) line += " angle=" + shown(a.normalAngle);
    if (a.pointError) line += " points=" + shown(a.pointError);
    return line;
}

/// Columns as wide as their widest cell; the first to the left, the others to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows, const char* separator) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string pad(widths[i] - row[i].size(), ' ');
            text += (i == 0 ? "" : separator) + (i == 0 ? row[i] + pad : pad + row[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

std::vector<std::vector<std::string>> summaryRows(const CollideRun& run) {
    std::vector<std::vector<std::string>> rows{{"engine", "queried", "answered", "unsupported", "failed",
                                                "missed", "spurious", "wrong depth", "wrong normal",
                                                "depth err [m]", "relative", "distance err [m]",
                                                "angle [rad]", "excess [m]", "point err [m]", "us/query"}};
    for (const CollideSummary& s : run.summaries)
        rows.push_back({s.spec, std::to_string(s.queried), std::to_string(s.answered),
                        std::to_string(s.unsupported), std::to_string(s.failed), std::to_string(s.missed),
                        std::to_string(s.spurious), std::to_string(s.wrongDepth),
                        std::to_string(s.wrongNormal), shown(s.depthErrorMax), shown(s.depthRelativeMax),
                        shown(s.distanceErrorMax), shown(s.normalAngleMax), shown(s.normalExcessMax),
                        shown(s.pointErrorMax), shown(s.microsecondsMedian)});
    return rows;
}

/// Wrong, all and lost results by kind; nothing where there are too many kinds or only one.
std::vector<std::vector<std::string>> kindRows(const CollideRun& run) {
    const std::vector<CollideKind> kinds = countKinds(run);
    if (kinds.size() < 2 || kinds.size() > 16) return {};
    std::vector<std::vector<std::string>> rows{{"wrong by kind", "cases"}};
    for (const auto& spec : run.specs) rows[0].push_back(spec.text());
    for (const CollideKind& k : kinds) {
        rows.push_back({k.kind, std::to_string(k.queried)});
        for (std::size_t i = 0; i < run.specs.size(); ++i)
            rows.back().push_back(k.answered[i] + k.wrong[i] == 0 ? "-" : std::to_string(k.wrong[i]));
    }
    return rows;
}

std::string truthLine(const CollideRun& run) {
    int oracle = 0, file = 0, none = 0, conflicts = 0;
    std::string first;
    for (const CollideCase& c : run.cases) {
        ++(c.truth.source == "oracle" ? oracle : c.truth.source == "file" ? file : none);
        if (c.truth.conflict.empty()) continue;
        if (conflicts++ == 0) first = c.query.name + ": " + c.truth.conflict;
    }
    std::string line = results::counted(run.cases.size(), "case") + ": " + std::to_string(oracle) +
                       " decided by the oracle, " + std::to_string(file) + " by the file, " +
                       std::to_string(none) + " by none";
    if (conflicts > 0)
        line += "; file and oracle disagree on " + std::to_string(conflicts) + " (" + first + ")";
    return line + ".\n";
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::trunc | std::ios::binary);
    out << text;
    if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string exact(const std::optional<double>& value) {
    return results::finiteText(value);
}
std::string exact(const std::optional<Vec3>& v) {
    return v ? exact(v->x) + "," + exact(v->y) + "," + exact(v->z) : ",,";
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv(const CollideRun& run) {
    std::string text =
        "case,engine,verdict,overlap,signed_distance,exact,nx,ny,nz,ax,ay,az,bx,by,bz,distance_error,normal_"
        "angle,"
        "normal_excess,point_error,message\n";
    for (const CollideCase& c : run.cases)
        for (std::size_t i = 0; i < run.specs.size(); ++i) {
            const CollideAnswer& a = c.answers[i];
            const std::string truth = c.truth.source == "none" ? "" : exact(c.truth.signedDistance);
            text += csvField(c.query.name) + "," + csvField(run.specs[i].text()) + "," +
                    collideVerdictName(a.verdict) + "," + (a.answered ? (a.overlap ? "1" : "0") : "") + "," +
                    exact(a.signedDistance) + "," + truth + "," + exact(a.normal) + "," + exact(a.witnessA) +
                    "," + exact(a.witnessB) + "," + exact(a.distanceError) + "," + exact(a.normalAngle) +
                    "," + exact(a.normalExcess) + "," + exact(a.pointError) + "," + csvField(a.message) +
                    "\n";
        }
    return text;
}

std::string markdownTable(const std::vector<std::vector<std::string>>& rows) {
    std::string text;
    bool head = true;
    for (const auto& row : rows) {
        for (const auto& cell : row) text += "| " + cell + " ";
        text += "|\n";
        if (head)
            for (std::size_t i = 0; i < row.size(); ++i) text += i + 1 < row.size() ? "|---" : "|---|\n";
        head = false;
    }
    return text;
}

std::string markdown(const CollideRun& run, const std::string& command) {
    return "# Collision queries\n\n`" + command + "`\n\n" + truthLine(run) + "\n" +
           markdownTable(summaryRows(run)) + "\n" + markdownTable(kindRows(run));
}

}  // namespace

Json collideJson(const CollideRun& run) {
    Json out{{"green", collideIsGreen(run)},
             {"complete", run.complete},
             {"tolerance",
              {{"touch", run.tolerance.touch},
               {"relative", run.tolerance.relative},
               {"angle", run.tolerance.angle},
               {"single", kSingleRounding}}},
             {"summary", Json::array()},
             {"kinds", Json::array()},
             {"cases", Json::array()}};
    for (std::size_t i = 0; i < run.summaries.size(); ++i)
        out["summary"].push_back(summaryJson(run.summaries[i], run.isSingle[i]));
    for (const CollideKind& k : countKinds(run))
        for (std::size_t i = 0; i < run.specs.size(); ++i)
            out["kinds"].push_back({{"kind", k.kind},
                                    {"name", run.specs[i].text()},
                                    {"asked", k.queried},
                                    {"answered", k.answered[i]},
                                    {"wrong", k.wrong[i]}});
    for (const CollideCase& c : run.cases) {
        Json entry{{"name", c.query.name},
                   {"file", c.file},
                   {"line", c.query.line},
                   {"dimension", c.query.dimension},
                   {"tags", c.query.tags}};
        const Json text = Json::parse(c.query.text);
        for (const char* key : {"a", "pose_a", "b", "pose_b", "expected"})
            if (text.contains(key)) entry[key] = text[key];
        entry["truth"] = truthJson(c.truth, c.query.dimension);
        entry["answers"] = Json::array();
        for (std::size_t i = 0; i < run.specs.size(); ++i)
            entry["answers"].push_back(answerJson(run.specs[i].text(), c.answers[i], c.query.dimension));
        out["cases"].push_back(std::move(entry));
    }
    return out;
}

std::string collideText(const CollideRun& run, bool all) {
    const bool few = all || run.cases.size() * run.specs.size() <= kPage;
    std::string text;
    std::size_t lines = 0, hidden = 0;
    for (const CollideCase& c : run.cases)
        for (std::size_t i = 0; i < run.specs.size(); ++i) {
            if (!few && !isFailure(c.answers[i].verdict)) continue;
            if (!all && ++lines > kPage)
                ++hidden;
            else
                text += answerLine(c, run.specs[i].text(), c.answers[i]) + "\n";
        }
    if (hidden > 0) text += "... and " + std::to_string(hidden) + " more; --all shows them\n";
    if (!text.empty()) text += "\n";
    text += aligned(summaryRows(run), "  ") + "\n";
    if (const auto kinds = kindRows(run); !kinds.empty()) text += aligned(kinds, "  ") + "\n";
    return text + truthLine(run);
}

std::vector<std::filesystem::path> writeCollideFiles(const CollideRun& run,
                                                     const std::filesystem::path& folder,
                                                     const std::string& command) {
    std::filesystem::create_directories(folder);
    const std::vector<std::filesystem::path> files{folder / "collide.json", folder / "collide.csv",
                                                   folder / "summary.md"};
    writeText(files[0], collideJson(run).dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    writeText(files[1], csv(run));
    writeText(files[2], markdown(run, command));
    return files;
}

}  // namespace rigor::validation
