// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <nlohmann/json.hpp>

#include "validation/bench/print.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;
using results::BenchCase;
using results::BenchChange;
using results::BenchRepetition;
using results::BenchSummary;

Json finite(double value) {
    return Json::parse(numberToJson(value).dump());
}
Json orNull(const std::optional<double>& value) {
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
             {"allocations", orNull(r.allocations)},
             {"allocated_bytes", orNull(r.allocatedBytes)},
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
                                  {"min", orNull(q.min)},
                                  {"max", orNull(q.max)},
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
             {"median", finite(s.clock == "wall" ? s.wall : s.cpu)},
             {"interval", s.low ? Json::array({*s.low, *s.high}) : Json(nullptr)},
             {"wall", finite(s.wall)},
             {"cpu", finite(s.cpu)},
             {"converged", s.converged},
             {"base", s.base},
             {"ratio", orNull(s.ratio)},
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

Json benchJson(const results::Run& run) {
    Json out{{"settings", run.bench.settings},
             {"environment", run.environment},
             {"cases", Json::array()},
             {"changes", Json::array()}};
    for (const BenchCase& c : run.bench.cases) out["cases"].push_back(caseJson(c));
    for (const BenchChange& c : run.bench.changes) out["changes"].push_back(changeJson(c));
    return out;
}

}  // namespace rigor::validation
