// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/parts/engines.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adapters/interface/timed.hpp"
#include "scenarios/loader/data_folder.hpp"
#include "validation/runner/shell_word.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

constexpr const char* kPrecision = "precision";

std::vector<std::string> precisionsOf(const EngineDescription& engine) {
    for (const adapter::Option& option : engine.options)
        if (option.key == kPrecision && option.values.size() > 1) return option.values;
    return engine.precisions.size() > 1 ? engine.precisions : std::vector<std::string>{};
}

double middle(const std::vector<double>& values) {
    return values.empty() ? 0.0 : median(values);
}
double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / values.size();
}

}  // namespace

std::vector<PartEngine> partEngines(const BenchRequest& request) {
    std::vector<std::string> requested = request.engines;
    if (requested.empty()) requested = adapter::availableEngines();
    std::vector<PartEngine> engines;
    for (const std::string& text : requested) {
        PartEngine engine{adapter::parseSpec(text), {}};
        engine.description = describeEngine(engine.spec.engine, request.binary);
        if (!engine.description.problem.empty()) continue;
        const std::vector<std::string> precisions = precisionsOf(engine.description);
        if (precisions.empty() || engine.spec.options.contains(kPrecision)) {
            engines.push_back(engine);
            continue;
        }
        for (const std::string& precision : precisions) {
            engines.push_back(engine);
            engines.back().spec.options[kPrecision] = precision;
        }
    }
    return engines;
}

std::string broadPhaseOption(const adapter::EngineSpec& spec) {
    int ends[2];
    if (pipe(ends) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        try {
            const adapter::LoadedEngine engine = adapter::loadEngine(spec);
            const auto* timed = dynamic_cast<const adapter::TimedBroadPhaseEngine*>(engine->broadPhase());
            const std::string key = timed == nullptr ? "" : timed->option();
            if (write(ends[1], key.data(), key.size()) < 0) _exit(1);
        } catch (const std::exception&) {
            _exit(1);
        }
        _exit(0);
    }
    close(ends[1]);
    std::string key;
    char piece[64];
    for (ssize_t n; child > 0 && (n = read(ends[0], piece, sizeof piece)) > 0;)
        key.append(piece, static_cast<std::size_t>(n));
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return key;
}

std::vector<adapter::EngineSpec> everyChoice(const PartEngine& engine, const std::string& key) {
    if (key.empty() || engine.spec.options.contains(key)) return {engine.spec};
    std::vector<adapter::EngineSpec> specs;
    for (const adapter::Option& option : engine.description.options) {
        if (option.key != key) continue;
        for (const std::string& value : option.values) {
            specs.push_back(engine.spec);
            specs.back().options[key] = value;
        }
    }
    if (specs.empty()) specs.push_back(engine.spec);
    return specs;
}

bool isWanted(const BenchRequest& request, const std::string& name, bool usual) {
    if (request.only.empty()) return usual || request.full;
    return std::find(request.only.begin(), request.only.end(), name) != request.only.end();
}

std::string partCommand(const PlannedBench& planned, const BenchRequest& request) {
    std::string command =
        scenario::programName() + " bench --parts " + planned.part + " --only " + shellWord(planned.name);
    if (planned.engine != kInterface) command += " --engines " + shellWord(planned.engine);
    if (!planned.sizeUnit.empty()) command += " --size " + std::to_string(std::llround(planned.size));
    if (request.seed != BenchRequest{}.seed) command += " --seed " + std::to_string(request.seed);
    return command;
}

results::BenchQuality judged(const std::string& name, const std::string& unit, double value,
                             std::optional<double> max) {
    return {name, unit, value, std::nullopt, max, !max || value <= *max};
}

void fillTimes(const CountingStopwatch& watch, bool means, results::BenchRepetition& done) {
    const ClockSamples& samples = watch.samples();
    done.wall = means ? mean(samples.wall) : middle(samples.wall);
    done.cpu = means ? mean(samples.cpu) : middle(samples.cpu);
    // The clocks tick in nanoseconds; a time of 0 would mean that nothing was measured.
    done.wall = std::max(done.wall, 1e-9);
    done.cpu = std::max(done.cpu, 1e-9);
    done.samples = samples.wall.size();
    watch.writeAllocations(done);
}

}  // namespace rigor::validation
