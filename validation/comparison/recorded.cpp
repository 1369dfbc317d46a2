// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/recorded.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>

#include "validation/comparison/compare.hpp"
#include "validation/hash.hpp"
#include "validation/results/values.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using results::CaseRow;
using results::MetricRow;
using results::Run;

const std::string kHeader = "scenario;scenario_hash;spec;dt;outcome;verdict;metric;unit;value";
constexpr std::size_t kColumns = 9;

fs::path fileOf(const fs::path& folder, const results::EngineRow& engine) {
    return folder / (engine.name + "-" + engine.version + ".csv");
}

bool isNamed(const results::ScenarioRow& scenario, const MetricRow& m) {
    return m.subject.empty() &&
           std::find(scenario.metrics.begin(), scenario.metrics.end(), m.name) != scenario.metrics.end();
}

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line)
        if (c == ';')
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

[[noreturn]] void damaged(const fs::path& file, std::size_t line, const std::string& expected) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": expected " + expected);
}

double numberIn(const std::string& text, const fs::path& file, std::size_t line) {
    try {
        std::size_t used = 0;
        const double value = std::stod(text, &used);
        if (used == text.size()) return value;
    } catch (const std::exception&) {
    }
    damaged(file, line, "a number, found '" + text + "'");
}

using RecordedCases = std::map<Record::Key, RecordedCase>;

RecordedMetric& metricIn(RecordedCase& recorded, const std::string& name, const std::string& unit) {
    for (RecordedMetric& m : recorded.metrics)
        if (m.name == name) return m;
    return recorded.metrics.emplace_back(RecordedMetric{name, unit, {}});
}

void readFile(const fs::path& file, RecordedCases& cases) {
    std::ifstream in(file);
    std::string text;
    std::size_t line = 1;
    if (!std::getline(in, text) || text != kHeader) damaged(file, line, "'" + kHeader + "'");
    while (std::getline(in, text)) {
        ++line;
        const auto f = fieldsOf(text);
        if (f.size() != kColumns) damaged(file, line, std::to_string(kColumns) + " fields");
        RecordedCase& c = cases[{f[0], f[2], numberIn(f[3], file, line)}];
        c.scenarioHash = f[1];
        c.outcome = results::parseOutcome(f[4]);
        c.verdict = results::parseVerdict(f[5]);
        if (!f[6].empty()) metricIn(c, f[6], f[7]).values.push_back(numberIn(f[8], file, line));
    }
}

void writeFile(const fs::path& file, const RecordedCases& cases) {
    std::ofstream out(file, std::ios::trunc);
    out << kHeader << "\n";
    for (const auto& [key, c] : cases) {
        const auto& [scenario, spec, dt] = key;
        const std::string head = scenario + ";" + c.scenarioHash + ";" + spec + ";" + results::exactText(dt) +
                                 ";" + results::outcomeName(c.outcome) + ";" +
                                 results::verdictName(c.verdict) + ";";
        for (const RecordedMetric& m : c.metrics)
            for (const double value : m.values)
                out << head << m.name << ";" << m.unit << ";" << results::exactText(value) << "\n";
        if (c.metrics.empty()) out << head << ";;\n";
    }
    if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

RecordedCase recordOf(const results::ScenarioRow& scenario, const CaseRow& row) {
    RecordedCase recorded;
    recorded.scenarioHash = recordedHash(scenario.text);
    recorded.outcome = row.outcome;
    recorded.verdict = row.verdict;
    for (const MetricRow& m : row.metrics)
        if (isNamed(scenario, m) && !std::isnan(m.value))
            metricIn(recorded, m.name, m.unit).values = {m.value};
    return recorded;
}

/// The new numbers beside the old ones, each once.
void addTo(RecordedCase& old, const RecordedCase& fresh) {
    for (const RecordedMetric& m : fresh.metrics) {
        auto& values = metricIn(old, m.name, m.unit).values;
        for (const double value : m.values) {
            const auto isSame = [&](double other) {
                return results::exactText(other) == results::exactText(value);
            };
            if (std::none_of(values.begin(), values.end(), isSame)) values.push_back(value);
        }
    }
}

bool tookPart(const Run& run, const results::EngineRow& engine) {
    return std::any_of(run.cases.begin(), run.cases.end(),
                       [&](const CaseRow& c) { return c.engine == engine.name; });
}

}  // namespace

std::string recordedHash(const std::string& scenarioText) {
    Fnv1a hash;
    hash.bytes(physicsOf(scenarioText));
    return hash.hex();
}

Record::Record(const fs::path& folder, const std::vector<results::EngineRow>& engines) {
    for (const auto& engine : engines)
        if (const fs::path file = fileOf(folder, engine); fs::exists(file))
            readFile(file, cases_);
        else
            missing_.push_back(engine.name + " " + engine.version);
}

const RecordedCase* Record::find(const std::string& scenario, const std::string& spec, double dt) const {
    const auto it = cases_.find({scenario, spec, dt});
    return it == cases_.end() ? nullptr : &it->second;
}

std::vector<fs::path> writeRecorded(const Run& run, const fs::path& folder, bool add) {
    fs::create_directories(folder);
    std::vector<fs::path> files;
    for (const auto& engine : run.engines) {
        if (!tookPart(run, engine)) continue;
        const fs::path file = fileOf(folder, engine);
        RecordedCases cases;
        if (fs::exists(file)) readFile(file, cases);
        for (const CaseRow& c : run.cases) {
            const auto* scenario = scenarioOf(run, c.scenario);
            if (c.engine != engine.name || scenario == nullptr) continue;
            const RecordedCase fresh = recordOf(*scenario, c);
            const auto [it, isNew] = cases.emplace(Record::Key{c.scenario, c.spec, c.dt}, fresh);
            if (isNew) continue;
            if (add && it->second.scenarioHash == fresh.scenarioHash && it->second.outcome == fresh.outcome)
                addTo(it->second, fresh);
            else
                it->second = fresh;
        }
        writeFile(file, cases);
        files.push_back(file);
    }
    return files;
}

Run readRecorded(const fs::path& folder, const Run& run, std::vector<std::string>& missing) {
    std::vector<results::EngineRow> engines;
    for (const auto& engine : run.engines)
        if (tookPart(run, engine)) engines.push_back(engine);
    const Record record(folder, engines);
    missing = record.missing();
    Run recorded;
    recorded.suite = "recorded";
    std::set<std::string> known;
    for (const CaseRow& row : run.cases) {  // cases that this run does not have are no change
        const RecordedCase* old = record.find(row.scenario, row.spec, row.dt);
        if (old == nullptr) continue;
        CaseRow& c = recorded.cases.emplace_back();
        c.scenario = row.scenario;
        c.spec = row.spec;
        c.dt = row.dt;
        c.outcome = old->outcome;
        c.verdict = old->verdict;
        for (const RecordedMetric& m : old->metrics) {
            MetricRow& metric = c.metrics.emplace_back();
            metric.name = m.name;
            metric.unit = m.unit;
            metric.value = m.values.front();
        }
        const auto* now = scenarioOf(run, row.scenario);
        if (now == nullptr || !known.insert(row.scenario).second) continue;
        recorded.scenarios.push_back(*now);
        if (recordedHash(now->text) != old->scenarioHash) recorded.scenarios.back().text.clear();
    }
    return recorded;
}

}  // namespace rigor::validation
