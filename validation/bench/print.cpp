// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "validation/bench/growth.hpp"
#include "validation/bench/text_table.hpp"
#include "validation/results/spec_labels.hpp"

namespace rigor::validation {
namespace {

using results::Bench;
using results::BenchCase;
using results::BenchChange;
using results::BenchRepetition;
using results::BenchSummary;

using Row = std::vector<std::string>;
using Labels = std::map<std::string, std::string>;

std::string number(double value, const char* format = "%.3g") {
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A time in its unit or a ratio: three digits, and no power of ten below a million.
std::string reading(double value) {
    return number(value, value >= 999.5 && value < 1e6 ? "%.0f" : "%.3g");
}

/// Words of a column's head, where a table may break it.
std::string inWords(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

/// Unit in which the times of a group are shown.
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
    return reading(*low / unit) + ".." + reading(*high / unit);
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
    const std::int64_t most = worldMemory(c);
    return most > 0 ? number(most / 1024.0) : "-";
}

std::string allocations(const BenchCase& c) {
    const BenchRepetition* look = lookOf(c);
    return look != nullptr && look->allocations ? reading(*look->allocations) : "-";
}

/// Struck out where a terminal can.
std::string struck(const std::string& text, bool colour) {
    return colour ? "\033[9m" + text + "\033[29m" : "~" + text + "~";
}

/// 12.3 M: at a glance, where powers of ten are not.
std::string rate(double perSecond) {
    constexpr const char* prefixes[] = {"", " k", " M", " G"};
    int thousands = 0;
    for (; thousands < 3 && perSecond >= 999.5; ++thousands) perSecond /= 1000.0;
    return number(perSecond) + prefixes[thousands];
}

/// Columns of the table of a group: contacts of scenes; work per operation and its quality for isolated
/// parts.
struct Columns {
    bool scene = true, threads = true, wall = true, rated = false, memory = true, allocations = true;
    std::string operation;
    std::vector<std::string> counts, quality, units;
};

double worstOf(const BenchCase& c, const std::string& quality) {
    double worst = -1.0;
    for (const BenchRepetition& r : c.repetitions)
        for (const auto& q : r.quality)
            if (q.name == quality && !(q.value <= worst)) worst = q.value;
    return worst;
}

Columns columnsOf(const std::vector<const BenchCase*>& group) {
    Columns columns;
    columns.scene = group.front()->part == "scene";
    columns.operation = group.front()->operation;
    const auto any = [&](auto&& has) {
        return std::any_of(group.begin(), group.end(), [&](const BenchCase* c) { return has(*c); });
    };
    if (columns.scene) {
        columns.counts = {"contacts", "longest_ms"};
        if (any([](const BenchCase& c) { return countOf(c, "asleep") > 0.0; }))
            columns.counts.push_back("asleep");
        return columns;
    }
    columns.threads = any([](const BenchCase& c) { return c.threads > 1; });
    columns.rated = columns.operation == "pair";  // operations that are usually given per second
    columns.wall = any([](const BenchCase& c) { return c.summary.clock == "wall"; });
    columns.memory = any([](const BenchCase& c) { return memory(c) != "-"; });
    columns.allocations = any([](const BenchCase& c) { return allocations(c) != "-"; });
    const auto addOnce = [](std::vector<std::string>& names, const std::string& name) {
        if (std::find(names.begin(), names.end(), name) != names.end()) return false;
        names.push_back(name);
        return true;
    };
    for (const BenchCase* c : group)
        for (const BenchRepetition& r : c->repetitions) {
            for (const auto& count : r.counts)  // the size stands in the title
                if (count.name != c->sizeUnit) addOnce(columns.counts, count.name);
            for (const auto& q : r.quality)
                if (addOnce(columns.quality, q.name)) columns.units.push_back(q.unit);
        }
    return columns;
}

Row headOf(const Columns& columns) {
    Row row{"engine"};
    if (columns.threads) row.push_back("threads");
    row.insert(row.end(), {"median", "95%"});
    if (columns.wall) row.push_back("wall");
    if (columns.rated) row.push_back(columns.operation + "s/s");
    row.insert(row.end(), {"ratio", "95%"});
    for (const std::string& name : columns.counts) row.push_back(inWords(name));
    for (std::size_t i = 0; i < columns.quality.size(); ++i)
        row.push_back(inWords(columns.quality[i]) +
                      (columns.units[i] == "1" ? "" : " [" + columns.units[i] + "]"));
    if (columns.memory) row.push_back("MiB");
    if (columns.allocations) row.push_back("malloc calls");
    row.push_back("runs");
    return row;
}

/// A cell for each word of the head, and what is wrong with the case, if anything.
Row rowOf(const BenchCase& c, const Columns& columns, const Unit& unit, const std::string& baseId,
          const Labels& labels, bool colour) {
    const BenchSummary& s = c.summary;
    Row row{labels.at(c.engine)};
    if (columns.threads) row.push_back(std::to_string(c.threads));
    const auto time = [&](double seconds) { return reading(seconds / unit.seconds); };
    if (s.repetitions == 0) {
        row.resize(headOf(columns).size(), "-");
        row.push_back(s.reason);
        return row;
    }
    row.push_back(s.valid ? time(clockTime(s)) : struck(time(clockTime(s)), colour));
    row.push_back(s.valid ? range(s.low, s.high, unit.seconds) : "");
    if (columns.wall) row.push_back(time(s.wall));
    if (columns.rated) row.push_back(s.valid ? rate(1.0 / clockTime(s)) : "");
    row.push_back(c.id == baseId ? "base" : s.ratio ? reading(*s.ratio) : "");
    row.push_back(s.ratio && c.id != baseId ? range(s.ratioLow, s.ratioHigh, 1.0) : "");
    for (const std::string& name : columns.counts) {
        const double value = countOf(c, name);
        row.push_back(
            value < 0.0 ? "-" : number(value, value < 1e6 && value == std::round(value) ? "%.0f" : "%.4g"));
    }
    for (const std::string& name : columns.quality) {
        const double value = worstOf(c, name);
        row.push_back(value < 0.0 ? "-" : reading(value));
    }
    if (columns.memory) row.push_back(memory(c));
    if (columns.allocations) row.push_back(allocations(c));
    row.push_back(std::to_string(s.repetitions) + (s.converged ? "" : "*"));
    row.push_back(s.valid ? "" : "INVALID: " + s.reason);
    return row;
}

bool sameGroup(const BenchCase& a, const BenchCase& b) {
    return a.part == b.part && a.name == b.name && a.size == b.size;
}

std::string titleOf(const BenchCase& c, const Unit& unit) {
    std::string text = c.part == "scene" ? c.name : c.part + ", " + c.name;
    if (!c.sizeUnit.empty()) text += ", " + number(c.size, "%.0f") + " " + c.sizeUnit;
    const bool vowel = std::string("aeiou").find(c.operation.substr(0, 1)) != std::string::npos;
    return text + ": " + unit.name + (vowel ? " an " : " a ") + c.operation;
}

/// Removes the columns that are equal in all rows of a part and returns them for the table's title: ", pairs
/// 1000".
std::string takeCommon(Row& head, std::vector<Row>& rows) {
    const auto found = [&](const char* name) {
        return std::find(head.begin(), head.end(), name) - head.begin();
    };
    std::string said;
    for (auto i = found("ratio") + 2; rows.size() > 1 && i < found("runs");) {
        std::set<std::string> values;
        for (const Row& row : rows) values.insert(row[i]);
        values.erase("-");  // value of an engine that did nothing
        if (values.size() != 1) {
            ++i;
            continue;
        }
        said += ", " + head[i] + " " + *values.begin();
        head.erase(head.begin() + i);
        for (Row& row : rows) row.erase(row.begin() + i);
    }
    return said;
}

std::string groupText(const std::vector<const BenchCase*>& group, const Labels& labels, bool colour) {
    double logarithms = 0.0, timed = 0.0;
    std::string base;
    for (const BenchCase* c : group) {
        if (clockTime(c->summary) > 0.0) {
            logarithms += std::log(clockTime(c->summary));
            timed += 1.0;
        }
        if (!c->summary.base.empty()) base = c->summary.base;
    }
    const Unit unit = unitFor(timed > 0.0 ? std::exp(logarithms / timed) : 0.0);
    const Columns columns = columnsOf(group);
    Row head = headOf(columns);
    std::vector<Row> rows;
    for (const BenchCase* c : group) rows.push_back(rowOf(*c, columns, unit, base, labels, colour));
    const std::string common = columns.scene ? "" : takeCommon(head, rows);
    return titleOf(*group.front(), unit) + common + "\n" + tableText(head, rows) + "\n";
}

Labels labelsOf(const Bench& bench) {
    std::vector<std::string> specs;
    for (const BenchCase& c : bench.cases) specs.push_back(c.engine);
    return results::specLabels(specs);
}

/// Legend of the short names; "" if every spec is written out. Specs are not wrapped, so that they can be
/// copied.
std::string keyText(const Labels& labels) {
    std::size_t width = 0;
    for (const auto& [spec, label] : labels)
        if (label != spec) width = std::max(width, label.size());
    std::string text;
    for (const auto& [spec, label] : labels)
        if (label != spec) text += "  " + label + std::string(width - label.size(), ' ') + "  " + spec + "\n";
    return text.empty() ? "" : "Engines in full:\n" + text + "\n";
}

/// Exponents of growth where cases differ by their size alone; "" where none do.
std::string growthText(const Bench& bench, const Labels& labels) {
    const auto cell = [](const std::optional<double>& p) { return p ? number(*p, "%.2f") : "-"; };
    std::vector<Row> rows;
    for (const Growth& g : growthsOf(bench.cases))
        rows.push_back({g.part == "scene" ? g.name : g.part + ", " + g.name, labels.at(g.engine),
                        std::to_string(g.threads), number(g.from, "%.0f"), number(g.to, "%.0f"), g.sizeUnit,
                        cell(g.time), cell(g.longest), cell(g.contacts), cell(g.memory)});
    if (rows.empty()) return "";
    return "Growth with the size: exponents p of ~ size^p\n" +
           tableText(
               {"work", "engine", "threads", "from", "to", "", "time", "longest", "contacts", "MiB", ""},
               rows) +
           "\n";
}

/// A case in few words, its engine by its label.
std::string shortName(const BenchCase& c, const Labels& labels) {
    BenchCase named = c;
    named.engine = labels.at(c.engine);
    return benchCaseName(named);
}

}  // namespace

double countOf(const BenchCase& c, const std::string& name) {
    double sum = 0.0, samples = 0.0;
    for (const BenchRepetition& r : c.repetitions)
        for (const auto& count : r.counts)
            if (count.name == name) {
                sum += count.value;
                samples += 1.0;
            }
    return samples > 0.0 ? sum / samples : -1.0;
}

std::string benchCaseName(const BenchCase& c) {
    std::string text = c.part == "scene" ? c.name : c.part + " " + c.name;
    if (!c.sizeUnit.empty()) text += " " + number(c.size, "%.0f") + " " + c.sizeUnit;
    text += ", " + c.engine;
    return c.threads > 1 ? text + ", " + std::to_string(c.threads) + " threads" : text;
}

std::string benchText(const results::Run& run, bool colour) {
    const Bench& bench = run.bench;
    const Labels labels = labelsOf(bench);
    std::string text;
    bool wide = false, counted = false, asleep = false;
    for (std::size_t i = 0; i < bench.cases.size(); ++i) {
        const bool first = std::none_of(bench.cases.begin(), bench.cases.begin() + i,
                                        [&](const BenchCase& c) { return sameGroup(c, bench.cases[i]); });
        if (!first) continue;
        std::vector<const BenchCase*> group;
        for (const BenchCase& c : bench.cases)
            if (sameGroup(c, bench.cases[i])) group.push_back(&c);
        text += groupText(group, labels, colour);
    }
    for (const BenchCase& c : bench.cases) {
        wide = wide || (c.summary.repetitions > 0 && !c.summary.converged);
        counted = counted || allocations(c) != "-";
        asleep = asleep || countOf(c, "asleep") > 0.0;
    }
    text += growthText(bench, labels) + keyText(labels);
    const auto note = [&](const std::string& words) { text += wrapped(words, kTextWidth, 0); };
    note(
        "median: over repetitions, each a process of its own, engines in random order; CPU time of all "
        "threads "
        "for one thread, wall time for more. ratio: to the base in the same round. MiB: what the world took. "
        "One of the engines was written by the people who wrote this bench.");
    if (wide)
        note("*: the 95 % interval of the median is wider than " +
             number(100.0 * std::stod(bench.settings.at("width"))) + " % of it.");
    if (counted)
        note(
            "malloc calls: of the C library's allocator in an operation; pools inside an engine are not "
            "seen.");
    if (asleep)
        note(
            "asleep: bodies that the engine has stopped and leaves out of its steps; their work is not in "
            "its "
            "times.");
    if (const auto it = bench.settings.find("build"); it != bench.settings.end() && it->second != "optimised")
        note("THIS PROGRAM WAS " + it->second + ": these times say nothing about the engines.");
    return text;
}

std::string changesText(const results::Run& run, const std::string& baseline,
                        const std::vector<std::string>& machine) {
    std::string text =
        "Against " + baseline + " (after / before, 95 % by bootstrap, Mann and Whitney's p):\n";
    const Labels labels = labelsOf(run.bench);
    Labels named;  // labels that occur here
    std::vector<Row> rows;
    for (const char* verdict : {"slower", "faster", "same", "not compared"})
        for (const BenchChange& c : run.bench.changes) {
            if (c.verdict != verdict) continue;
            const auto of = std::find_if(run.bench.cases.begin(), run.bench.cases.end(),
                                         [&](const BenchCase& x) { return x.id == c.caseId; });
            if (of == run.bench.cases.end()) continue;
            named[of->engine] = labels.at(of->engine);
            const std::string name = shortName(*of, labels);
            if (!c.reason.empty())
                rows.push_back({verdict, "", "", "", name + ": " + c.reason});
            else
                rows.push_back({verdict, number(c.ratio, "%.3f"),
                                number(c.low, "%.3f") + ".." + number(c.high, "%.3f"),
                                "p = " + number(c.p, "%.2g"), name});
        }
    text += rows.empty() ? "  no case is in both runs\n" : tableText({"", "", "", ""}, rows);
    text += keyText(named);
    for (const std::string& difference : machine) text += "  another machine or build: " + difference + "\n";
    return text;
}

}  // namespace rigor::validation
