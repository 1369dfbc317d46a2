// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/answer.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rigor::validation {
namespace {

using nlohmann::json;
using namespace results;

json optional(const std::optional<double>& value) {
    return value ? numberToJson(*value) : json(nullptr);
}
std::optional<double> optionalFrom(const json& j) {
    if (j.is_null()) return std::nullopt;
    return numberFromJson(j);
}

json metricToJson(const MetricRow& m) {
    return {m.name,
            m.subject,
            m.unit,
            m.kind,
            numberToJson(m.value),
            numberToJson(m.at),
            optional(m.bound),
            optional(m.expectation),
            verdictName(m.verdict),
            m.note,
            optional(m.scale),
            optional(m.relative),
            optional(m.ideal),
            optional(m.recorded)};
}
MetricRow metricFromJson(const json& j) {
    return {j.at(0),
            j.at(1),
            j.at(2),
            j.at(3),
            numberFromJson(j.at(4)),
            numberFromJson(j.at(5)),
            optionalFrom(j.at(6)),
            optionalFrom(j.at(7)),
            parseVerdict(j.at(8)),
            j.at(9),
            optionalFrom(j.at(10)),
            optionalFrom(j.at(11)),
            optionalFrom(j.at(12)),
            optionalFrom(j.at(13))};
}

json accuracyToJson(const AccuracyRow& a) {
    return {gradeName(a.grade), a.metric, optional(a.relative), optional(a.ideal), a.note};
}
AccuracyRow accuracyFromJson(const json& j) {
    return {parseGrade(j.at(0)), j.at(1), optionalFrom(j.at(2)), optionalFrom(j.at(3)), j.at(4)};
}

json quantityToJson(const QuantityRow& q) {
    return {q.name, q.unit, numberToJson(q.exact), optional(q.schemeExact), optional(q.measured)};
}
QuantityRow quantityFromJson(const json& j) {
    return {j.at(0), j.at(1), numberFromJson(j.at(2)), optionalFrom(j.at(3)), optionalFrom(j.at(4))};
}

json ledgerToJson(const LedgerRow& l) {
    return {l.topic, l.requested, l.resolved, l.realisation, l.reason};
}
LedgerRow ledgerFromJson(const json& j) {
    return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4)};
}

json readBackToJson(const ReadBackRow& r) {
    return {r.quantity, r.subject, numberToJson(r.expected), numberToJson(r.found), numberToJson(r.error),
            r.ok};
}
ReadBackRow readBackFromJson(const json& j) {
    return {j.at(0), j.at(1), numberFromJson(j.at(2)), numberFromJson(j.at(3)), numberFromJson(j.at(4)),
            j.at(5)};
}

json timingToJson(const TimingRow& t) {
    return {t.phase,
            numberToJson(t.median),
            numberToJson(t.p10),
            numberToJson(t.p90),
            numberToJson(t.total),
            t.samples,
            numberToJson(t.meanContacts),
            optional(t.low),
            optional(t.high),
            t.bodies,
            optional(t.first),
            optional(t.mean),
            optional(t.p95),
            optional(t.p99),
            optional(t.worst),
            optional(t.realTimeFactor)};
}
TimingRow timingFromJson(const json& j) {
    return {j.at(0),
            numberFromJson(j.at(1)),
            numberFromJson(j.at(2)),
            numberFromJson(j.at(3)),
            numberFromJson(j.at(4)),
            j.at(5),
            numberFromJson(j.at(6)),
            optionalFrom(j.at(7)),
            optionalFrom(j.at(8)),
            j.at(9),
            optionalFrom(j.at(10)),
            optionalFrom(j.at(11)),
            optionalFrom(j.at(12)),
            optionalFrom(j.at(13)),
            optionalFrom(j.at(14)),
            optionalFrom(j.at(15))};
}

template <class Row>
json listToJson(const std::vector<Row>& rows, json (*convert)(const Row&)) {
    json list = json::array();
    for (const Row& row : rows) list.push_back(convert(row));
    return list;
}
template <class Row>
std::vector<Row> listFromJson(const json& list, Row (*convert)(const json&)) {
    std::vector<Row> rows;
    for (const json& j : list) rows.push_back(convert(j));
    return rows;
}

}  // namespace

json numberToJson(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    return value;
}

double numberFromJson(const json& j) {
    if (!j.is_string()) return j.get<double>();
    const auto text = j.get<std::string>();
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf") return std::numeric_limits<double>::infinity();
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    throw std::runtime_error("answer of a child: found '" + text + "', expected a number");
}

json auditToJson(const AuditRow& a) {
    return {{"auditor", a.auditor},
            {"outcome", a.outcome},
            {"counts", {a.frames, a.queries, a.overlapping, a.missed, a.spurious, a.undecided}},
            {"errors",
             {optional(a.normalErrorMax), optional(a.normalErrorMedian), optional(a.depthErrorMax),
              optional(a.depthErrorMedian), optional(a.pointErrorMax)}},
            {"worst", a.worst},
            {"note", a.note}};
}

AuditRow auditFromJson(const json& j) {
    const json &n = j.at("counts"), &e = j.at("errors");
    return {j.at("auditor"),
            j.at("outcome"),
            n.at(0),
            n.at(1),
            n.at(2),
            n.at(3),
            n.at(4),
            n.at(5),
            optionalFrom(e.at(0)),
            optionalFrom(e.at(1)),
            optionalFrom(e.at(2)),
            optionalFrom(e.at(3)),
            optionalFrom(e.at(4)),
            j.at("worst"),
            j.at("note")};
}

json caseToJson(const CaseRow& c) {
    return {{"id", c.id},
            {"position", c.position},
            {"scenario", c.scenario},
            {"spec", c.spec},
            {"engine", c.engine},
            {"preset", c.preset},
            {"dt", numberToJson(c.dt)},
            {"outcome", outcomeName(c.outcome)},
            {"verdict", verdictName(c.verdict)},
            {"reason", c.reason},
            {"refusal", c.refusal},
            {"wall", numberToJson(c.wallSeconds)},
            {"cpu", numberToJson(c.cpuSeconds)},
            {"steps", c.steps},
            {"memory", c.peakMemoryKiB},
            {"hash", c.stateHash},
            {"trajectory", c.trajectoryFile},
            {"command", c.command},
            {"settings", c.settings},
            {"metrics", listToJson(c.metrics, metricToJson)},
            {"quantities", listToJson(c.quantities, quantityToJson)},
            {"ledger", listToJson(c.ledger, ledgerToJson)},
            {"read_back", listToJson(c.readBack, readBackToJson)},
            {"audit", listToJson(c.audit, auditToJson)},
            {"timings", listToJson(c.timings, timingToJson)},
            {"accuracy", accuracyToJson(c.accuracy)},
            {"regression", {regressionName(c.regression), c.regressionReason}}};
}

CaseRow caseFromJson(const json& j) {
    CaseRow c;
    c.id = j.at("id"), c.position = j.at("position"), c.scenario = j.at("scenario"), c.spec = j.at("spec");
    c.engine = j.at("engine"), c.preset = j.at("preset"), c.dt = numberFromJson(j.at("dt"));
    c.outcome = parseOutcome(j.at("outcome")), c.verdict = parseVerdict(j.at("verdict"));
    c.reason = j.at("reason"), c.refusal = j.at("refusal");
    c.wallSeconds = numberFromJson(j.at("wall")), c.cpuSeconds = numberFromJson(j.at("cpu"));
    c.steps = j.at("steps"), c.peakMemoryKiB = j.at("memory"), c.stateHash = j.at("hash");
    c.trajectoryFile = j.at("trajectory"), c.command = j.at("command");
    c.settings = j.at("settings").get<std::map<std::string, std::string>>();
    c.metrics = listFromJson(j.at("metrics"), metricFromJson);
    c.quantities = listFromJson(j.at("quantities"), quantityFromJson);
    c.ledger = listFromJson(j.at("ledger"), ledgerFromJson);
    c.readBack = listFromJson(j.at("read_back"), readBackFromJson);
    c.audit = listFromJson(j.at("audit"), auditFromJson);
    c.timings = listFromJson(j.at("timings"), timingFromJson);
    c.accuracy = accuracyFromJson(j.at("accuracy"));
    c.regression = parseRegression(j.at("regression").at(0)), c.regressionReason = j.at("regression").at(1);
    return c;
}

void writeJsonFile(const std::filesystem::path& file, const json& content) {
    std::filesystem::path part = file;
    part += ".part";
    {
        std::ofstream out(part, std::ios::trunc);
        out << content.dump(-1, ' ', false, json::error_handler_t::replace);
        if (!out.flush()) throw std::runtime_error(part.string() + ": cannot be written");
    }
    std::filesystem::rename(part, file);
}

std::optional<json> readJsonFile(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) return std::nullopt;
    json content = json::parse(in, nullptr, false);
    if (content.is_discarded()) return std::nullopt;
    return content;
}

}  // namespace rigor::validation
