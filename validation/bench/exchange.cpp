// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/exchange.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "adapters/interface/types.hpp"
#include "validation/bench/process_memory.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using results::BenchRepetition;

json optional(const std::optional<double>& value) {
    return value ? numberToJson(*value) : json(nullptr);
}
std::optional<double> optionalFrom(const json& j) {
    return j.is_null() ? std::nullopt : std::optional(numberFromJson(j));
}

std::unique_ptr<TimedWork> makeCase(const PlannedBench& planned, const json& request) {
    if (planned.part == kScenePart) return makeSceneCase(planned, request.at("text").get<std::string>());
    for (const BenchFamily& family : benchFamilies())
        if (family.name == planned.part) return family.make(planned);
    throw adapter::BadInput("bench: no part is called '" + planned.part + "'");
}

/// A repetition that a process of its own makes, with the data that all of them report.
BenchRepetition repeat(const json& request) {
    const PlannedBench planned = plannedFromJson(request.at("planned"));
    const int round = request.at("round").get<int>();
    BenchRepetition done = makeCase(planned, request)->run(round);
    if (done.peakMemoryKiB == 0) done.peakMemoryKiB = peakResidentKiB();
    if (!(done.wall > 0.0) || !(done.cpu > 0.0)) {
        done.outcome = "error";
        done.reason = "nothing was timed";
    }
    return done;
}

}  // namespace

json repetitionToJson(const BenchRepetition& r) {
    json counts = json::array(), phases = json::array(), quality = json::array();
    for (const auto& c : r.counts) counts.push_back({c.name, numberToJson(c.value)});
    for (const auto& p : r.phases) phases.push_back({p.name, numberToJson(p.seconds)});
    for (const auto& q : r.quality)
        quality.push_back({q.name, q.unit, numberToJson(q.value), optional(q.min), optional(q.max), q.ok});
    return {{"outcome", r.outcome},
            {"reason", r.reason},
            {"wall", numberToJson(r.wall)},
            {"cpu", numberToJson(r.cpu)},
            {"samples", r.samples},
            {"state_hash", r.stateHash},
            {"peak_memory", r.peakMemoryKiB},
            {"own_memory", r.ownMemoryKiB},
            {"allocations", optional(r.allocations)},
            {"allocated_bytes", optional(r.allocatedBytes)},
            {"counts", counts},
            {"phases", phases},
            {"quality", quality}};
}

BenchRepetition repetitionFromJson(const json& j) {
    BenchRepetition r;
    r.outcome = j.at("outcome");
    r.reason = j.at("reason");
    r.wall = numberFromJson(j.at("wall"));
    r.cpu = numberFromJson(j.at("cpu"));
    r.samples = j.at("samples");
    r.stateHash = j.at("state_hash");
    r.peakMemoryKiB = j.at("peak_memory");
    r.ownMemoryKiB = j.at("own_memory");
    r.allocations = optionalFrom(j.at("allocations"));
    r.allocatedBytes = optionalFrom(j.at("allocated_bytes"));
    for (const json& c : j.at("counts")) r.counts.push_back({c.at(0), numberFromJson(c.at(1))});
    for (const json& p : j.at("phases")) r.phases.push_back({p.at(0), numberFromJson(p.at(1))});
    for (const json& q : j.at("quality"))
        r.quality.push_back({q.at(0), q.at(1), numberFromJson(q.at(2)), optionalFrom(q.at(3)),
                             optionalFrom(q.at(4)), q.at(5)});
    return r;
}

json plannedToJson(const PlannedBench& p) {
    return {{"part", p.part},
            {"name", p.name},
            {"engine", p.engine},
            {"size_unit", p.sizeUnit},
            {"size", numberToJson(p.size)},
            {"threads", p.threads},
            {"operation", p.operation},
            {"parameters", p.parameters},
            {"command", p.command},
            {"time_limit", numberToJson(p.timeLimit)}};
}

PlannedBench plannedFromJson(const json& j) {
    PlannedBench p;
    p.part = j.at("part");
    p.name = j.at("name");
    p.engine = j.at("engine");
    p.sizeUnit = j.at("size_unit");
    p.size = numberFromJson(j.at("size"));
    p.threads = j.at("threads");
    p.operation = j.at("operation");
    p.parameters = j.at("parameters");
    p.command = j.at("command");
    p.timeLimit = numberFromJson(j.at("time_limit"));
    return p;
}

int benchChild(const std::filesystem::path& requestFile) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    BenchRepetition done;
    try {
        done = repeat(*request);
    } catch (const adapter::Unsupported& error) {
        done.outcome = "unsupported";
        done.reason = error.what();
    } catch (const std::exception& error) {
        done.outcome = "error";
        done.reason = error.what();
    }
    writeJsonFile(request->at("answer").get<std::string>(), repetitionToJson(done));
    return 0;
}

}  // namespace rigor::validation
