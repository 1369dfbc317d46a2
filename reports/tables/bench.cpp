// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tables/bench.hpp"

#include <algorithm>
#include <map>

#include "reports/model/view_model.hpp"
#include "validation/results/spec_labels.hpp"

namespace rigor::report {
namespace {

using results::BenchCase;
using results::BenchQuality;
using results::BenchRepetition;
using results::BenchSummary;

struct Mean {
    double sum = 0.0, count = 0.0;
    void add(double value) {
        sum += value;
        count += 1.0;
    }
    double value() const { return sum / count; }
};

/// Means over the timed repetitions, in the order in which they were reported.
std::vector<std::pair<std::string, double>> means(const BenchCase& c, bool phases) {
    std::vector<std::string> order;
    std::map<std::string, Mean> sums;
    const auto add = [&](const std::string& name, double value) {
        if (!sums.contains(name)) order.push_back(name);
        sums[name].add(value);
    };
    for (const BenchRepetition& r : c.repetitions) {
        if (r.round == 0) continue;
        if (phases)
            for (const auto& p : r.phases) add(p.name, p.seconds);
        else
            for (const auto& k : r.counts) add(k.name, k.value);
    }
    std::vector<std::pair<std::string, double>> out;
    for (const auto& name : order) out.emplace_back(name, sums[name].value());
    return out;
}

std::optional<double> countOf(const BenchCase& c, const std::string& name) {
    for (const auto& [known, value] : means(c, false))
        if (known == name) return value;
    return std::nullopt;
}

/// The repetition whose quality is shown: the first that misses a bound, else the last.
const BenchRepetition* judged(const BenchCase& c) {
    const auto bad = std::find_if(c.repetitions.begin(), c.repetitions.end(), [](const BenchRepetition& r) {
        return std::any_of(r.quality.begin(), r.quality.end(), [](const BenchQuality& q) { return !q.ok; });
    });
    if (bad != c.repetitions.end()) return &*bad;
    return c.repetitions.empty() ? nullptr : &c.repetitions.back();
}

std::optional<double> mostMemory(const BenchCase& c, std::int64_t BenchRepetition::*kind) {
    std::int64_t most = 0;
    for (const BenchRepetition& r : c.repetitions)
        if (r.round > 0) most = std::max(most, r.*kind);
    return most > 0 ? std::optional(static_cast<double>(most)) : std::nullopt;
}

std::optional<double> allocationsOf(const BenchCase& c) {
    for (const BenchRepetition& r : c.repetitions)
        if (r.round == 0) return r.allocations;
    return std::nullopt;
}

std::optional<double> timeOf(const BenchSummary& s) {
    if (s.repetitions == 0) return std::nullopt;
    return s.clock == "wall" ? s.wall : s.cpu;
}

Json qualityJson(const BenchCase& c) {
    Json list = Json::array();
    if (const BenchRepetition* r = judged(c))
        for (const auto& q : r->quality)
            list.push_back({{"name", q.name},
                            {"unit", q.unit},
                            {"value", number(q.value)},
                            {"min", number(q.min)},
                            {"max", number(q.max)},
                            {"ok", q.ok}});
    return list;
}

Json caseJson(const BenchCase& c, const std::string& label) {
    const BenchSummary& s = c.summary;
    Json counts = Json::object(), phases = Json::object();
    for (const auto& [name, value] : means(c, false)) counts[name] = number(value);
    for (const auto& [name, value] : means(c, true)) phases[name] = number(value);
    return {{"id", c.id},
            {"part", c.part},
            {"name", c.name},
            {"engine", c.engine},
            {"label", label},
            {"size", number(c.size)},
            {"sizeUnit", c.sizeUnit},
            {"threads", c.threads},
            {"operation", c.operation},
            {"command", c.command},
            {"repetitions", s.repetitions},
            {"clock", s.clock},
            {"time", number(timeOf(s))},
            {"low", number(s.low)},
            {"high", number(s.high)},
            {"wall", number(s.wall)},
            {"cpu", number(s.cpu)},
            {"converged", s.converged},
            {"valid", s.valid},
            {"reason", s.reason},
            {"base", s.base},
            {"ratio", number(s.ratio)},
            {"ratioLow", number(s.ratioLow)},
            {"ratioHigh", number(s.ratioHigh)},
            {"memoryKiB", number(mostMemory(c, &BenchRepetition::ownMemoryKiB))},
            {"peakKiB", number(mostMemory(c, &BenchRepetition::peakMemoryKiB))},
            {"allocations", number(allocationsOf(c))},
            {"counts", counts},
            {"phases", phases},
            {"quality", qualityJson(c)}};
}

/// Name of the timed work, in tables without a column for the part.
std::string subjectOf(const BenchCase& c) {
    return c.part == "scene" ? c.name : c.part + ": " + c.name;
}

std::string validity(const BenchSummary& s) {
    return s.valid ? "valid" : "invalid: " + s.reason;
}

Table timesTable(const results::Run& run) {
    Table table{"bench",
                "What an operation took: medians over repetitions, each a process of its own; low and high: "
                "95 % interval "
                "of the median of `clock`; an invalid time counts for nothing",
                {{"part"},
                 {"name"},
                 {"size", ColumnKind::Number},
                 {"engine"},
                 {"threads", ColumnKind::Number},
                 {"clock"},
                 {"median", ColumnKind::Duration, "s"},
                 {"low", ColumnKind::Duration, "s"},
                 {"high", ColumnKind::Duration, "s"},
                 {"wall", ColumnKind::Duration, "s"},
                 {"cpu", ColumnKind::Duration, "s"},
                 {"repetitions", ColumnKind::Number},
                 {"ratio", ColumnKind::Number},
                 {"ratio low", ColumnKind::Number},
                 {"ratio high", ColumnKind::Number},
                 {"contacts", ColumnKind::Number},
                 {"memory", ColumnKind::Number, "KiB"},
                 {"allocations", ColumnKind::Number},
                 {"validity"},
                 {"command"}},
                {}};
    for (const BenchCase& c : run.bench.cases) {
        const BenchSummary& s = c.summary;
        table.rows.push_back({c.part,
                              c.name,
                              c.size,
                              c.engine,
                              c.threads,
                              s.clock,
                              timeOf(s),
                              s.low,
                              s.high,
                              s.wall,
                              s.cpu,
                              s.repetitions,
                              s.ratio,
                              s.ratioLow,
                              s.ratioHigh,
                              countOf(c, "contacts"),
                              mostMemory(c, &BenchRepetition::ownMemoryKiB),
                              allocationsOf(c),
                              validity(s),
                              c.command});
    }
    return table;
}

Table valuesTable(const results::Run& run) {
    Table table{"bench_work",
                "How much work the timed operations were, and the phases that the engine reports (means over "
                "repetitions; phases in seconds)",
                {{"name"},
                 {"size", ColumnKind::Number},
                 {"engine"},
                 {"threads", ColumnKind::Number},
                 {"kind"},
                 {"what"},
                 {"value", ColumnKind::Number}},
                {}};
    for (const BenchCase& c : run.bench.cases)
        for (const bool phases : {false, true})
            for (const auto& [name, value] : means(c, phases))
                table.rows.push_back(
                    {subjectOf(c), c.size, c.engine, c.threads, phases ? "phase" : "count", name, value});
    return table;
}

Table qualityTable(const results::Run& run) {
    Table table{"bench_quality",
                "Quality of the timed runs and the scenes' bounds; out of them a timing is invalid",
                {{"name"},
                 {"size", ColumnKind::Number},
                 {"engine"},
                 {"threads", ColumnKind::Number},
                 {"quantity"},
                 {"unit"},
                 {"value", ColumnKind::Number},
                 {"min", ColumnKind::Number},
                 {"max", ColumnKind::Number},
                 {"kept"}},
                {}};
    for (const BenchCase& c : run.bench.cases)
        if (const BenchRepetition* r = judged(c))
            for (const auto& q : r->quality)
                table.rows.push_back({subjectOf(c), c.size, c.engine, c.threads, q.name, q.unit, q.value,
                                      q.min, q.max, q.min || q.max ? (q.ok ? "yes" : "no") : "not judged"});
    return table;
}

Table changesTable(const results::Run& run) {
    Table table{
        "bench_changes",
        "Against the baseline: ratio of medians after / before with its 95 % interval (bootstrap), p of "
        "Mann and Whitney's test, corrected for the number of cases",
        {{"name"},
         {"size", ColumnKind::Number},
         {"engine"},
         {"threads", ColumnKind::Number},
         {"before", ColumnKind::Duration, "s"},
         {"after", ColumnKind::Duration, "s"},
         {"ratio", ColumnKind::Number},
         {"low", ColumnKind::Number},
         {"high", ColumnKind::Number},
         {"p", ColumnKind::Number},
         {"verdict"},
         {"reason"}},
        {}};
    for (const auto& change : run.bench.changes)
        for (const BenchCase& c : run.bench.cases)
            if (c.id == change.caseId)
                table.rows.push_back({subjectOf(c), c.size, c.engine, c.threads, change.before, change.after,
                                      change.ratio, change.low, change.high, change.p, change.verdict,
                                      change.reason});
    return table;
}

}  // namespace

Json benchJson(const results::Run& run) {
    if (run.bench.empty()) return nullptr;
    Json cases = Json::array(), changes = Json::array();
    std::vector<std::string> specs;
    for (const BenchCase& c : run.bench.cases) specs.push_back(c.engine);
    const auto labels = results::specLabels(specs);
    for (const BenchCase& c : run.bench.cases) cases.push_back(caseJson(c, labels.at(c.engine)));
    for (const auto& c : run.bench.changes)
        changes.push_back({{"id", c.caseId},
                           {"before", number(c.before)},
                           {"after", number(c.after)},
                           {"ratio", number(c.ratio)},
                           {"low", number(c.low)},
                           {"high", number(c.high)},
                           {"p", number(c.p)},
                           {"verdict", c.verdict},
                           {"reason", c.reason}});
    return {{"settings", run.bench.settings}, {"cases", cases}, {"changes", changes}};
}

std::vector<Table> benchTables(const ViewModel& view) {
    const results::Run& run = view.run();
    if (run.bench.empty()) return {};
    std::vector<Table> tables{timesTable(run), valuesTable(run), qualityTable(run)};
    if (!run.bench.changes.empty()) tables.push_back(changesTable(run));
    return tables;
}

std::string benchMarkdown(const results::Run& run) {
    if (run.bench.empty()) return "";
    Table table{"bench",
                "Median of an operation with its 95 % interval, over repetitions in processes of their own; "
                "ratio to the "
                "base in the same round. A struck-out time is invalid.",
                {{"what"},
                 {"size", ColumnKind::Number},
                 {"engine"},
                 {"threads", ColumnKind::Number},
                 {"median"},
                 {"95 %"},
                 {"ratio", ColumnKind::Number},
                 {"validity"}},
                {}};
    for (const BenchCase& c : run.bench.cases) {
        const BenchSummary& s = c.summary;
        const auto time = timeOf(s);
        const std::string shown = time ? durationLabel(*time) : "-";
        table.rows.push_back({subjectOf(c), c.size, c.engine, c.threads,
                              s.valid || !time ? shown : "~~" + shown + "~~",
                              s.low ? durationLabel(*s.low) + " .. " + durationLabel(*s.high) : "", s.ratio,
                              s.valid ? "" : s.reason});
    }
    return "\n### Bench\n\n" + tableMarkdown(table);
}

}  // namespace rigor::report
