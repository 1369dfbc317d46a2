// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/recorded.hpp"

#include <algorithm>
#include <fstream>
#include <map>
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

std::string hashOf(const std::string& scenarioText) {
    Fnv1a hash;
    hash.bytes(physicsOf(scenarioText));
    return hash.hex();
}

fs::path fileOf(const fs::path& folder, const results::EngineRow& engine) {
    return folder / (engine.name + "-" + engine.version + ".csv");
}

const results::ScenarioRow* scenarioOf(const Run& run, const std::string& name) {
    for (const auto& s : run.scenarios)
        if (s.name == name) return &s;
    return nullptr;
}

bool isNamed(const results::ScenarioRow& scenario, const MetricRow& m) {
    return m.subject.empty() &&
           std::find(scenario.metrics.begin(), scenario.metrics.end(), m.name) != scenario.metrics.end();
}

void writeCase(std::ostream& out, const results::ScenarioRow& scenario, const CaseRow& c) {
    const std::string head = c.scenario + ";" + hashOf(scenario.text) + ";" + c.spec + ";" +
                             results::exactText(c.dt) + ";" + results::outcomeName(c.outcome) + ";" +
                             results::verdictName(c.verdict) + ";";
    bool any = false;
    for (const MetricRow& m : c.metrics)
        if (isNamed(scenario, m)) {
            out << head << m.name << ";" << m.unit << ";" << results::exactText(m.value) << "\n";
            any = true;
        }
    if (!any) out << head << ";;\n";
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

/// Adds the cases of one file; scenarios whose text is no longer the recorded one get an empty text.
void readFile(const fs::path& file, const Run& like, Run& recorded) {
    std::ifstream in(file);
    std::string text;
    std::size_t line = 1;
    if (!std::getline(in, text) || text != kHeader) damaged(file, line, "'" + kHeader + "'");
    std::map<std::string, std::size_t> index;
    while (std::getline(in, text)) {
        ++line;
        const auto f = fieldsOf(text);
        if (f.size() != kColumns) damaged(file, line, std::to_string(kColumns) + " fields");
        const auto [it, isNew] = index.emplace(f[0] + ";" + f[2] + ";" + f[3], recorded.cases.size());
        if (isNew) {
            CaseRow& c = recorded.cases.emplace_back();
            c.scenario = f[0], c.spec = f[2], c.dt = numberIn(f[3], file, line);
            c.outcome = results::parseOutcome(f[4]), c.verdict = results::parseVerdict(f[5]);
            const auto* now = scenarioOf(like, c.scenario);
            if (now != nullptr && scenarioOf(recorded, c.scenario) == nullptr) {
                recorded.scenarios.push_back(*now);
                if (hashOf(now->text) != f[1]) recorded.scenarios.back().text.clear();
            }
        }
        if (f[6].empty()) continue;
        MetricRow m;
        m.name = f[6], m.unit = f[7], m.value = numberIn(f[8], file, line);
        recorded.cases[it->second].metrics.push_back(m);
    }
}

}  // namespace

std::vector<fs::path> writeRecorded(const Run& run, const fs::path& folder) {
    fs::create_directories(folder);
    std::vector<fs::path> files;
    for (const auto& engine : run.engines) {
        const auto mine = [&](const CaseRow& c) { return c.engine == engine.name; };
        if (std::none_of(run.cases.begin(), run.cases.end(), mine)) continue;
        const fs::path file = fileOf(folder, engine);
        std::ofstream out(file, std::ios::trunc);
        out << kHeader << "\n";
        for (const CaseRow& c : run.cases)
            if (mine(c))
                if (const auto* scenario = scenarioOf(run, c.scenario)) writeCase(out, *scenario, c);
        if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
        files.push_back(file);
    }
    return files;
}

Run readRecorded(const fs::path& folder, const Run& run, std::vector<std::string>& missing) {
    Run recorded;
    recorded.suite = "recorded";
    for (const auto& engine : run.engines) {
        const bool took = std::any_of(run.cases.begin(), run.cases.end(),
                                      [&](const CaseRow& c) { return c.engine == engine.name; });
        if (!took) continue;
        if (const fs::path file = fileOf(folder, engine); fs::exists(file))
            readFile(file, run, recorded);
        else
            missing.push_back(engine.name + " " + engine.version);
    }
    // What this run did not run is no change.
    std::erase_if(recorded.cases, [&](const CaseRow& c) {
        return std::none_of(run.cases.begin(), run.cases.end(), [&](const CaseRow& other) {
            return other.scenario == c.scenario && other.spec == c.spec && other.dt == c.dt;
        });
    });
    return recorded;
}

}  // namespace rigor::validation
