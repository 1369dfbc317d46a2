// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/summary.hpp"

#include <algorithm>
#include <cstdio>

#include "validation/comparison/two_samples.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using results::Bench;
using results::BenchCase;
using results::BenchChange;
using results::BenchQuality;
using results::BenchRepetition;
using results::BenchSummary;

std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string missed(const BenchQuality& q) {
    std::string text = q.name + " " + shown(q.value);
    if (q.unit != "1" && !q.unit.empty()) text += " " + q.unit;
    if (q.max && !(q.value <= *q.max)) return text + " > " + shown(*q.max);
    if (q.min && !(q.value >= *q.min)) return text + " < " + shown(*q.min);
    return text + " is out of bounds";
}

/// Reason why the timing is not valid; "" if it is.
std::string objection(const BenchCase& c) {
    if (c.repetitions.empty()) return "not run";
    for (const BenchRepetition& r : c.repetitions)
        if (r.outcome != "completed") return r.outcome + (r.reason.empty() ? "" : ": " + r.reason);
    std::string text;
    for (const BenchRepetition& r : c.repetitions) {
        for (const BenchQuality& q : r.quality)
            if (!q.ok) text += (text.empty() ? "" : "; ") + missed(q);
        if (!text.empty()) return text;
    }
    return timesOf(c, "wall").empty() ? "no timed repetition" : "";
}

void summariseAlone(BenchCase& c, const BenchTarget& target) {
    BenchSummary& s = c.summary = {};
    s.clock = clockOf(c, target);
    s.reason = objection(c);
    s.valid = s.reason.empty();
    const auto wall = timesOf(c, "wall"), cpu = timesOf(c, "cpu");
    s.repetitions = wall.size();
    if (wall.empty()) return;
    s.wall = median(wall);
    s.cpu = median(cpu);
    if (const auto interval = medianInterval(s.clock == "wall" ? wall : cpu)) {
        s.low = interval->low;
        s.high = interval->high;
    }
    s.converged = isConverged(c, target);
}

bool sameWork(const BenchCase& a, const BenchCase& b) {
    return a.part == b.part && a.name == b.name && a.size == b.size;
}

std::string engineOf(const BenchCase& c) {
    return c.engine.substr(0, c.engine.find(':'));
}

/// The case of that spec, or the first one of that engine; of an isolated part, where one engine takes part
/// with many choices, its fastest valid one. Without a name: the first engine with a valid case.
const BenchCase* baseOf(const Bench& bench, const BenchCase& c, const std::string& base) {
    const BenchCase* found = nullptr;
    for (const BenchCase& other : bench.cases) {
        if (!sameWork(other, c) || other.threads != 1) continue;
        if (other.engine == base) return &other;
        if (found == nullptr && (base.empty() ? other.summary.valid : engineOf(other) == base))
            found = &other;
        if (found == nullptr || c.part == "scene" || engineOf(other) != engineOf(*found)) continue;
        const BenchSummary &own = other.summary, &best = found->summary;
        const bool faster = own.clock == "wall" ? own.wall < best.wall : own.cpu < best.cpu;
        if (own.valid && (!best.valid || faster)) found = &other;
    }
    return found;
}

void compareWith(const BenchCase& base, BenchCase& c) {
    std::vector<double> own, others;
    for (const BenchRepetition& r : c.repetitions)
        for (const BenchRepetition& b : base.repetitions) {
            if (r.round != b.round || r.round == 0) continue;
            const bool wall = c.summary.clock == "wall";
            own.push_back(wall ? r.wall : r.cpu);
            others.push_back(wall ? b.wall : b.cpu);
        }
    c.summary.base = base.id;
    if (own.empty() || !c.summary.valid || !base.summary.valid) return;
    const PairedRatio found = pairedRatio(others, own);
    c.summary.ratio = found.ratio;
    if (found.interval) {
        c.summary.ratioLow = found.interval->low;
        c.summary.ratioHigh = found.interval->high;
    }
}

const BenchCase* find(const Bench& bench, const std::string& id) {
    for (const BenchCase& c : bench.cases)
        if (c.id == id) return &c;
    return nullptr;
}

BenchChange changeOf(const BenchCase& before, const BenchCase& after) {
    BenchChange change;
    change.caseId = after.id;
    const std::string clock = after.summary.clock;
    const auto one = timesOf(before, clock), other = timesOf(after, clock);
    if (!before.summary.valid)
        change.reason = "before: " + before.summary.reason;
    else if (!after.summary.valid)
        change.reason = after.summary.reason;
    if (!change.reason.empty()) {
        change.verdict = "not compared";
        return change;
    }
    change.before = median(one);
    change.after = median(other);
    const RatioOfMedians found = ratioOfMedians(one, other, 1);
    change.ratio = found.ratio;
    change.low = found.interval.low;
    change.high = found.interval.high;
    change.p = mannWhitney(one, other);
    return change;
}

std::string verdictOf(const BenchChange& c, const BaselineOptions& options) {
    if (!(c.p < options.level)) return "same";
    if (c.low > 1.0 && c.ratio > 1.0 + options.threshold) return "slower";
    if (c.high < 1.0 && c.ratio < 1.0 / (1.0 + options.threshold)) return "faster";
    return "same";
}

}  // namespace

void summarise(Bench& bench, const BenchTarget& target, const std::string& base) {
    for (BenchCase& c : bench.cases) summariseAlone(c, target);
    for (BenchCase& c : bench.cases)
        if (const BenchCase* other = baseOf(bench, c, base); other != nullptr) compareWith(*other, c);
}

std::vector<BenchChange> changesSince(const Bench& before, const Bench& after,
                                      const BaselineOptions& options) {
    std::vector<BenchChange> changes;
    std::vector<double> probabilities;
    for (const BenchCase& c : after.cases) {
        const BenchCase* old = find(before, c.id);
        if (old == nullptr) continue;
        changes.push_back(changeOf(*old, c));
        if (changes.back().verdict.empty()) probabilities.push_back(changes.back().p);
    }
    const auto corrected = holm(probabilities);
    std::size_t next = 0;
    for (BenchChange& c : changes) {
        if (!c.verdict.empty()) continue;
        c.p = corrected[next++];
        c.verdict = verdictOf(c, options);
    }
    return changes;
}

bool becameSlower(const std::vector<BenchChange>& changes) {
    return std::any_of(changes.begin(), changes.end(),
                       [](const BenchChange& c) { return c.verdict == "slower"; });
}

std::vector<std::string> otherMachine(const results::Run& before, const results::Run& after) {
    std::vector<std::string> differences;
    for (const char* key : {"cpu", "cores", "caches", "memory", "kernel", "system", "compiler", "build_type",
                            "flags", "governor"}) {
        const auto one = before.environment.find(key), other = after.environment.find(key);
        const std::string a = one == before.environment.end() ? "(unknown)" : one->second;
        const std::string b = other == after.environment.end() ? "(unknown)" : other->second;
        if (a != b) differences.push_back(std::string(key) + ": " + a + " -> " + b);
    }
    return differences;
}

}  // namespace rigor::validation
