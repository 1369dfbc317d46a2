// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// rigor-same-bits [--engines SPECS] [--steps N] [--write FILE] [--against FILE]... SCENARIO|SUITE...
//
// Prints how many cases have the same bits in each way of running them; with --against, how many have those of the file,
// and nothing else. Exit code 1: some have not, each is named with the first step that differs. FILE has a line for each
// case: scenario, spec, dt, hash of the last state.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"
#include "validation/results/judgement.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/same_bits/same_bits.hpp"

namespace rigor::validation {
namespace {

std::string inHouse(const std::string& precision) {
    return std::string(results::kInHouseEngine) + ":precision=" + precision + ",preset=default";
}

struct Arguments {
    std::string engines = inHouse("f32") + "," + inHouse("f64"), write;
    std::vector<std::string> names, against;
    std::size_t steps = 0;
};

Arguments parsed(int argc, char** argv) {
    Arguments a;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!word.starts_with("--")) {
            a.names.push_back(word);
            continue;
        }
        if (++i == argc) throw std::invalid_argument(word + ": a value is missing");
        if (word == "--engines")
            a.engines = argv[i];
        else if (word == "--steps")
            a.steps = std::stoul(argv[i]);
        else if (word == "--write")
            a.write = argv[i];
        else if (word == "--against")
            a.against.push_back(argv[i]);
        else
            throw std::invalid_argument("no option '" + word + "'");
    }
    if (a.names.empty()) throw std::invalid_argument("a scenario or suite is needed");
    return a;
}

/// Names of scenarios; a suite stands for its own.
std::vector<std::string> scenariosOf(const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (const std::string& name : names) {
        const auto suites = scenario::listSuites();
        const bool isSuite =
            std::any_of(suites.begin(), suites.end(), [&](const auto& s) { return s.name == name; });
        const auto some =
            isSuite ? scenario::loadSuite(scenario::findSuite(name)).scenarios : std::vector{name};
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

std::map<std::string, std::string> hashesIn(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::invalid_argument(file + ": cannot be read");
    std::map<std::string, std::string> hashes;
    for (std::string scenario, spec, dt, hash; in >> scenario >> spec >> dt >> hash;)
        hashes[caseKey(scenario, spec, std::stod(dt))] = hash;
    return hashes;
}

/// One way of running the cases: how many have been compared, and what differed.
struct Column {
    std::string name;
    std::size_t compared = 0;
    std::vector<std::string> differences;
};

class Table {
  public:
    Column& operator[](const std::string& name) {
        for (Column& column : columns_)
            if (column.name == name) return column;
        return columns_.emplace_back(Column{name, 0, {}});
    }
    bool print() const {
        bool same = true;
        for (const Column& c : columns_) {
            std::printf("%-40s %5zu of %5zu cases have the same bits\n", c.name.c_str(),
                        c.compared - c.differences.size(), c.compared);
            for (const std::string& difference : c.differences) std::printf("    %s\n", difference.c_str());
            same = same && c.differences.empty();
        }
        return same;
    }

  private:
    std::vector<Column> columns_;
};

void compare(Column& column, const SameBitsCase& one, const StateHashes& expected, const StateHashes& found) {
    ++column.compared;
    if (const auto step = firstDifference(expected, found))
        column.differences.push_back(one.key() + ": from step " + std::to_string(*step));
}

class Comparison {
  public:
    explicit Comparison(const Arguments& a) {
        for (const std::string& file : a.against) files_[file] = hashesIn(file);
        if (!a.write.empty()) out_.open(a.write);
    }
    void add(const SameBitsCase& one, unsigned seed) {
        const StateHashes first = statesOf(one);
        const std::string precision =
            one.spec.options.count("precision") > 0 ? one.spec.options.at("precision") + ", " : std::string();
        if (files_.empty()) compareWays(one, first, precision, seed);
        for (const auto& [file, hashes] : files_) {
            const auto it = hashes.find(one.key());
            if (it == hashes.end()) continue;
            Column& column = table_[precision + "against " + file];
            ++column.compared;
            if (it->second != first.back()) column.differences.push_back(one.key());
        }
        if (out_.is_open()) out_ << one.key() << ' ' << first.back() << '\n';
    }
    bool print() const { return table_.print(); }
    bool isWritten() { return !out_.is_open() || out_.flush().good(); }

  private:
    void compareWays(const SameBitsCase& one, const StateHashes& first, const std::string& precision,
                     unsigned seed) {
        compare(table_[precision + "a second run"], one, first, statesOf(one));
        if (const auto two = onTwoThreads(one))
            compare(table_[precision + "two threads"], one, first, statesOf(*two));
        if (const auto restored = restoredStatesOf(one, seed))
            compare(table_[precision + "restored at random steps"], one, first, *restored);
    }

    std::map<std::string, std::map<std::string, std::string>> files_;
    std::ofstream out_;
    Table table_;
};

int run(const Arguments& a) {
    Comparison comparison(a);
    unsigned seed = 1;
    for (const std::string& name : scenariosOf(a.names)) {
        const auto loaded = scenario::loadScenario(scenario::findScenario(name));
        for (const adapter::EngineSpec& spec : adapter::parseSpecList(a.engines)) {
            const SameBitsCase one{loaded.scenario, withScenarioSettings(spec, loaded.text),
                                   loaded.scenario.timeSteps.front(), a.steps};
            try {
                comparison.add(one, seed++);
            } catch (const adapter::Unsupported& error) {
                std::printf("%s: %s\n", one.key().c_str(), error.what());
            }
        }
    }
    const bool same = comparison.print();
    if (!comparison.isWritten()) throw std::runtime_error(a.write + ": cannot be written");
    return same ? 0 : 1;
}

}  // namespace
}  // namespace rigor::validation

int main(int argc, char** argv) {
    try {
        return rigor::validation::run(rigor::validation::parsed(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rigor-same-bits: %s\n", error.what());
        return 2;
    }
}
