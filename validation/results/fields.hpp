// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The fields of the records of a case, each named once: what writes them, reads them back and sends them from
// a child to its parent goes through these lists. `use(column, member)`, for a field that not every schema
// had `use(column, member, since)`, and where older stores did not mean the empty value
// `use(column, member, since, before)` with the SQL of what they meant.
#pragma once

#include <concepts>
#include <type_traits>

#include "validation/results/types.hpp"

namespace rigor::results {

/// T or const T.
template <class Row, class T>
concept RowOf = std::same_as<std::remove_const_t<Row>, T>;

template <RowOf<MetricRow> Row, class Use>
void eachField(Row& m, Use&& use) {
    use("name", m.name);
    use("subject", m.subject);
    use("unit", m.unit);
    use("kind", m.kind);
    use("value", m.value);
    use("at", m.at);
    use("bound", m.bound);
    use("expectation", m.expectation);
    use("verdict", m.verdict);
    use("note", m.note);
    use("scale", m.scale, 7);
    use("relative_error", m.relative, 7);
    use("ideal_error", m.ideal, 7);
    use("recorded", m.recorded, 7);
    use("order_min", m.orderMin, 9);
    use("order_max", m.orderMax, 9);
    use("order_count", m.orderCount, 9);
    use("bound_min", m.boundMin, 15);
}

template <RowOf<QuantityRow> Row, class Use>
void eachField(Row& q, Use&& use) {
    use("name", q.name);
    use("unit", q.unit);
    use("exact", q.exact);
    use("scheme_exact", q.schemeExact);
    use("measured", q.measured);
}

template <RowOf<SettingRow> Row, class Use>
void eachField(Row& s, Use&& use) {
    use("key", s.key);
    use("value", s.value);
}

template <RowOf<LedgerRow> Row, class Use>
void eachField(Row& l, Use&& use) {
    use("topic", l.topic);
    use("requested", l.requested);
    use("resolved", l.resolved);
    use("realisation", l.realisation);
    use("reason", l.reason);
}

template <RowOf<ReadBackRow> Row, class Use>
void eachField(Row& r, Use&& use) {
    use("quantity", r.quantity);
    use("subject", r.subject);
    use("expected", r.expected);
    use("found", r.found);
    use("error", r.error);
    use("ok", r.ok);
}

template <RowOf<AuditRow> Row, class Use>
void eachField(Row& a, Use&& use) {
    use("auditor", a.auditor);
    use("outcome", a.outcome);
    use("frames", a.frames);
    use("queries", a.queries);
    use("overlapping", a.overlapping);
    use("missed", a.missed);
    use("spurious", a.spurious);
    use("undecided", a.undecided);
    use("normal_error_max", a.normalErrorMax);
    use("normal_error_median", a.normalErrorMedian);
    use("depth_error_max", a.depthErrorMax);
    use("depth_error_median", a.depthErrorMedian);
    use("point_error_max", a.pointErrorMax);
    use("worst", a.worst);
    use("note", a.note);
    use("findings", a.findings, 11);
}

template <RowOf<TimingRow> Row, class Use>
void eachField(Row& t, Use&& use) {
    use("phase", t.phase);
    use("median", t.median);
    use("p10", t.p10);
    use("p90", t.p90);
    use("total", t.total);
    use("samples", t.samples);
    use("mean_contacts", t.meanContacts);
    use("low", t.low, 3);
    use("high", t.high, 3);
    use("bodies", t.bodies, 3);
    use("first", t.first, 8);
    use("mean", t.mean, 8);
    use("p95", t.p95, 8);
    use("p99", t.p99, 8);
    use("worst", t.worst, 8);
    use("real_time_factor", t.realTimeFactor, 8);
}

/// Calls `use` for each field of the case alone; its lists are tables of their own.
template <RowOf<CaseRow> Row, class Use>
void eachField(Row& c, Use&& use) {
    use("id", c.id);
    use("position", c.position);
    use("scenario", c.scenario);
    use("spec", c.spec);
    use("engine", c.engine);
    use("preset", c.preset);
    use("dt", c.dt);
    use("outcome", c.outcome);
    use("verdict", c.verdict);
    use("reason", c.reason);
    use("wall_seconds", c.wallSeconds);
    use("cpu_seconds", c.cpuSeconds);
    use("steps", c.steps);
    use("peak_memory_kib", c.peakMemoryKiB);
    use("state_hash", c.stateHash);
    use("trajectory_file", c.trajectoryFile);
    use("command", c.command);
    use("refusal", c.refusal, 6);
    use("grade", c.accuracy.grade, 7);
    use("graded_by", c.accuracy.metric, 7);
    use("relative_error", c.accuracy.relative, 7);
    use("ideal_error", c.accuracy.ideal, 7);
    use("grade_note", c.accuracy.note, 7);
    use("regression", c.regression, 7, "'no record'");
    use("regression_reason", c.regressionReason, 7);
    use("insertion_orders", c.orders.run, 9);
    use("insertion_orders_completed", c.orders.completed, 9);
    use("grade_best", c.orders.best, 9);
    use("grade_worst", c.orders.worst, 9);
    use("insertion_note", c.orders.note, 9);
    use("insertion_orders_failed", c.orders.failed, 10);
    use("insertion_verdicts", c.orders.verdicts, 10);
    use("order_dependent", c.orders.dependence, 10);
}

/// The tables with rows of each case: use(table, list of records).
template <RowOf<CaseRow> Row, class Use>
void eachOwnList(Row& c, Use&& use) {
    use("metrics", c.metrics);
    use("quantities", c.quantities);
    use("audit", c.audit);
    use("timings", c.timings);
}

/// Every list of records of a case but its settings.
template <RowOf<CaseRow> Row, class Use>
void eachList(Row& c, Use&& use) {
    eachOwnList(c, use);
    use("ledger", c.ledger);
    use("read_back", c.readBack);
}

/// Enumerations as their texts.
inline const char* textOf(Outcome outcome) {
    return outcomeName(outcome);
}
inline const char* textOf(Verdict verdict) {
    return verdictName(verdict);
}
inline const char* textOf(Regression regression) {
    return regressionName(regression);
}
inline const char* textOf(Grade grade) {
    return gradeName(grade);
}
inline const char* textOf(OrderDependence dependence) {
    return orderDependenceName(dependence);
}
inline void fromText(const std::string& text, OrderDependence& dependence) {
    dependence = parseOrderDependence(text);
}
inline void fromText(const std::string& text, Outcome& outcome) {
    outcome = parseOutcome(text);
}
inline void fromText(const std::string& text, Verdict& verdict) {
    verdict = parseVerdict(text);
}
inline void fromText(const std::string& text, Regression& regression) {
    regression = parseRegression(text);
}
inline void fromText(const std::string& text, Grade& grade) {
    grade = parseGrade(text);
}

}  // namespace rigor::results
