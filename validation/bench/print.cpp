// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;
using results::Bench;
using results::BenchCase;
using results::BenchChange;
using results::BenchRepetition;
using results::BenchSummary;

using Row = std::vector<std::string>;

std::string number(double value, const char* format = "%.3g") {
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// What times of a group are shown in: of the longest one's order.
struct Unit {
    const char* name = "ms";
    double seconds = 1e-3;
};
Unit unitFor(double longest) {
    if (longest >= 1.0) return {"s", 1.0};
    if (longest >= 1e-4) return {"ms", 1e-3};
    return longest >= 1e-7 ? Unit{"us", 1e-6} : Unit{"ns", 1e-9};
}

std::string range(const std::optional<double>& low, const std::optional<double>& high, double unit) {
    if (!low || !high) return "-";
    return number(*low / unit) + " .. " + number(*high / unit);
}

double clockTime(const BenchSummary& s) {
    return s.clock == "wall" ? s.wall : s.cpu;
}

const BenchRepetition* lookOf(const BenchCase& c) {
    for (const BenchRepetition& r : c.repetitions)
        if (r.round == 0) return &r;
    return nullptr;
}

std::string memory(const BenchCase& c) {
    std::int64_t most = 0;
    for (const BenchRepetition& r : c.repetitions)
        if (r.round > 0) most = std::max(most, r.ownMemoryKiB);
    return most > 0 ? number(static_cast<double>(most) / 1024.0) : "-";
}

std::string allocations(const BenchCase& c) {
    const BenchRepetition* look = lookOf(c);
    return look != nullptr && look->allocations ? number(*look->allocations) : "-";
}

/// Struck out where a terminal can.
std::string struck(const std::string& text, bool colour) {
    return colour ? "\033[9m" + text + "\033[29m" : "~" + text + "~";
}

Row rowOf(const BenchCase& c, const Unit& unit, const std::string& baseId, bool colour) {
    const BenchSummary& s = c.summary;
    Row row{c.engine, std::to_string(c.threads)};
    const double contacts = countOf(c, "contacts");
    const auto time = [&](double seconds) { return number(seconds / unit.seconds); };
    if (s.repetitions == 0) {
        row.insert(row.end(), {"-", "-", "-", "-", "-", "-", "-", "-", "-", s.reason});
        return row;
    }
    row.push_back(s.valid ? time(clockTime(s)) : struck(time(clockTime(s)), colour));
    row.push_back(s.valid ? range(s.low, s.high, unit.seconds) : "");
    row.push_back(time(s.wall));
    row.push_back(c.id == baseId ? "base" : s.ratio ? number(*s.ratio) : "");
    row.push_back(s.ratio && c.id != baseId ? range(s.ratioLow, s.ratioHigh, 1.0) : "");
    row.push_back(contacts < 0.0 ? "-" : number(contacts, "%.4g"));
    row.push_back(memory(c));
    row.push_back(allocations(c));
    row.push_back(std::to_string(s.repetitions) + (s.converged ? "" : "*"));
    row.push_back(s.valid ? "" : "INVALID: " + s.reason);
    return row;
}

/// Characters on the screen: escapes take none.
std::size_t shownWidth(const std::string& text) {
    std::size_t width = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\033')
            while (i < text.size() && text[i] != 'm') ++i;
        else
            ++width;
    return width;
}

std::string tableText(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths;
    for (const Row& row : rows)
        for (std::size_t i = 0; i + 1 < row.size(); ++i) {
            if (widths.size() <= i) widths.push_back(0);
            widths[i] = std::max(widths[i], shownWidth(row[i]));
        }
    std::string text;
    for (const Row& row : rows) {
        std::string line = " ";
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::size_t gap = i < widths.size() ? widths[i] - shownWidth(row[i]) : 0;
            const bool left = i == 0 || i + 1 == row.size();
            line += " " + (left ? row[i] + std::string(gap, ' ') : std::string(gap, ' ') + row[i]) + " ";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

bool sameGroup(const BenchCase& a, const BenchCase& b) {
    return a.part == b.part && a.name == b.name && a.size == b.size;
}

std::string titleOf(const BenchCase& c, const Unit& unit) {
    std::string text = c.part == "scene" ? c.name : c.part + ", " + c.name;
    if (!c.sizeUnit.empty()) text += ", " + number(c.size, "%.0f") + " " + c.sizeUnit;
    return text + ": " + unit.name + " a " + c.operation;
}

std::string groupText(const std::vector<const BenchCase*>& group, bool colour) {
    double longest = 0.0;
    std::string base;
    for (const BenchCase* c : group) {
        longest = std::max(longest, clockTime(c->summary));
        if (!c->summary.base.empty()) base = c->summary.base;
    }
    const Unit unit = unitFor(longest);
    std::vector<Row> rows{{"engine", "threads", "median", "95 %", "wall", "ratio", "95 %", "contacts", "MiB",
                           "allocations", "runs", ""}};
    for (const BenchCase* c : group) rows.push_back(rowOf(*c, unit, base, colour));
    return titleOf(*group.front(), unit) + "\n" + tableText(rows) + "\n";
}

Json finite(double value) {
    return Json::parse(numberToJson(value).dump());
}
Json optional(const std::optional<double>& value) {
    return value ? finite(*value) : Json(nullptr);
}

Json repetitionJson(const BenchRepetition& r) {
    Json out{{"round", r.round},
             {"order", r.order},
             {"outcome", r.outcome},
             {"reason", r.reason},
             {"wall", finite(r.wall)},
             {"cpu", finite(r.cpu)},
             {"samples", r.samples},
             {"peak_memory_kib", r.peakMemoryKiB},
             {"own_memory_kib", r.ownMemoryKiB},
             {"allocations", optional(r.allocations)},
             {"allocated_bytes", optional(r.allocatedBytes)},
             {"load", r.load},
             {"state_hash", r.stateHash},
             {"counts", Json::object()},
             {"phases", Json::object()},
             {"quality", Json::array()}};
    for (const auto& c : r.counts) out["counts"][c.name] = finite(c.value);
    for (const auto& p : r.phases) out["phases"][p.name] = finite(p.seconds);
    for (const auto& q : r.quality)
        out["quality"].push_back({{"name", q.name},
                                  {"unit", q.unit},
                                  {"value", finite(q.value)},
                                  {"min", optional(q.min)},
                                  {"max", optional(q.max)},
                                  {"ok", q.ok}});
    return out;
}

Json caseJson(const BenchCase& c) {
    const BenchSummary& s = c.summary;
    Json out{{"name", c.name},
             {"id", c.id},
             {"part", c.part},
             {"engine", c.engine},
             {"threads", c.threads},
             {"size", finite(c.size)},
             {"size_unit", c.sizeUnit},
             {"operation", c.operation},
             {"valid", s.valid},
             {"reason", s.reason},
             {"clock", s.clock},
             {"median", finite(clockTime(s))},
             {"interval", s.low ? Json::array({*s.low, *s.high}) : Json(nullptr)},
             {"wall", finite(s.wall)},
             {"cpu", finite(s.cpu)},
             {"converged", s.converged},
             {"base", s.base},
             {"ratio", optional(s.ratio)},
             {"ratio_interval", s.ratioLow ? Json::array({*s.ratioLow, *s.ratioHigh}) : Json(nullptr)},
             {"command", c.command},
             {"repetitions", Json::array()}};
    for (const BenchRepetition& r : c.repetitions) out["repetitions"].push_back(repetitionJson(r));
    return out;
}

Json changeJson(const BenchChange& c) {
    return {{"id", c.caseId},   {"verdict", c.verdict}, {"before", c.before},
            {"after", c.after}, {"ratio", c.ratio},     {"interval", Json::array({c.low, c.high})},
            {"p", c.p},         {"reason", c.reason}};
}

}  // namespace

double countOf(const BenchCase& c, const std::string& name) {
    double sum = 0.0, told = 0.0;
    for (const BenchRepetition& r : c.repetitions)
        for (const auto& count : r.counts)
            if (count.name == name) sum += count.value, told += 1.0;
    return told > 0.0 ? sum / told : -1.0;
}

std::string benchCaseName(const BenchCase& c) {
    std::string text = c.part == "scene" ? c.name : c.part + " " + c.name;
    if (!c.sizeUnit.empty()) text += " " + number(c.size, "%.0f") + " " + c.sizeUnit;
    text += ", " + c.engine;
    return c.threads > 1 ? text + ", " + std::to_string(c.threads) + " threads" : text;
}

std::string benchText(const results::Run& run, bool colour) {
    const Bench& bench = run.bench;
    std::string text;
    bool wide = false, counted = false;
    for (std::size_t i = 0; i < bench.cases.size(); ++i) {
        const bool first = std::none_of(bench.cases.begin(), bench.cases.begin() + static_cast<long>(i),
                                        [&](const BenchCase& c) { return sameGroup(c, bench.cases[i]); });
        if (!first) continue;
        std::vector<const BenchCase*> group;
        for (const BenchCase& c : bench.cases)
            if (sameGroup(c, bench.cases[i])) group.push_back(&c);
        text += groupText(group, colour);
    }
    for (const BenchCase& c : bench.cases) {
        wide = wide || (c.summary.repetitions > 0 && !c.summary.converged);
        counted = counted || allocations(c) != "-";
    }
    text +=
        "median: over repetitions, each a process of its own, engines in random order; CPU time of all "
        "threads "
        "for one\nthread, wall time for more. ratio: to the base in the same round. MiB: what the world "
        "took. "
        "One of the engines\nwas written by the people who wrote this bench.\n";
    if (wide)
        text += "*: the 95 % interval of the median is wider than " +
                number(100.0 * std::stod(bench.settings.at("width"))) + " % of it.\n";
    if (counted)
        text +=
            "allocations: calls of the C library's allocator a step; pools inside an engine are not seen.\n";
    if (const auto it = bench.settings.find("build"); it != bench.settings.end() && it->second != "optimised")
        text += "THIS PROGRAM WAS " + it->second + ": these times say nothing about the engines.\n";
    return text;
}

Json benchJson(const results::Run& run) {
    Json out{{"settings", run.bench.settings},
             {"environment", run.environment},
             {"cases", Json::array()},
             {"changes", Json::array()}};
    for (const BenchCase& c : run.bench.cases) out["cases"].push_back(caseJson(c));
    for (const BenchChange& c : run.bench.changes) out["changes"].push_back(changeJson(c));
    return out;
}

std::string changesText(const results::Run& run, const std::string& baseline,
                        const std::vector<std::string>& machine) {
    std::string text =
        "Against " + baseline + " (after / before, 95 % by bootstrap, Mann and Whitney's p):\n";
    std::vector<Row> rows;
    for (const char* verdict : {"slower", "faster", "same", "not compared"})
        for (const BenchChange& c : run.bench.changes) {
            if (c.verdict != verdict) continue;
            const auto of = std::find_if(run.bench.cases.begin(), run.bench.cases.end(),
                                         [&](const BenchCase& x) { return x.id == c.caseId; });
            if (of == run.bench.cases.end()) continue;
            if (!c.reason.empty())
                rows.push_back({verdict, "", "", "", benchCaseName(*of) + ": " + c.reason});
            else
                rows.push_back({verdict, number(c.ratio, "%.3f"),
                                number(c.low, "%.3f") + " .. " + number(c.high, "%.3f"),
                                "p = " + number(c.p, "%.2g"), benchCaseName(*of)});
        }
    text += rows.empty() ? "  no case is in both runs\n" : tableText(rows);
    for (const std::string& difference : machine) text += "  another machine or build: " + difference + "\n";
    return text;
}

}  // namespace rigor::validation
