// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/accuracy/accuracy.hpp"
#include "validation/runner/judge.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::MetricRow;
using results::Verdict;
using scenario::Scenario;

constexpr std::size_t kMostSubjects = 64;  ///< rows per metric: the whole scene, then the worst subjects
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The table with the scenario's own metrics in front, in their order of importance.
std::vector<const MetricEntry*> orderedMetrics(const Scenario& scenario) {
    std::vector<const MetricEntry*> order;
    for (const auto& name : scenario.metrics)
        if (const MetricEntry* entry = findMetric(name);
            entry != nullptr && std::find(order.begin(), order.end(), entry) == order.end())
            order.push_back(entry);
    for (const MetricEntry& entry : metricTable())
        if (std::find(order.begin(), order.end(), &entry) == order.end()) order.push_back(&entry);
    return order;
}

MetricRow metricRow(const MetricEntry& entry, const MetricValue& value) {
    MetricRow row;
    row.name = entry.name;
    row.subject = value.subject;
    row.unit = entry.unit;
    row.kind = metricKindName(entry.kind);
    row.value = value.value;
    row.at = value.at;
    return row;
}

void keepWorstSubjects(std::vector<MetricRow>& rows) {
    if (rows.size() <= kMostSubjects) return;
    std::stable_sort(rows.begin() + 1, rows.end(),
                     [](const MetricRow& a, const MetricRow& b) { return a.value > b.value; });
    rows.resize(kMostSubjects);
}

bool hasContacts(const Trajectory& run) {
    return std::any_of(run.contacts.begin(), run.contacts.end(),
                       [](const auto& frame) { return !frame.empty(); });
}

/// The reason why a metric that could be computed has no value. `referenceProblem`: why the reference does not hold.
std::string whyNoValue(const MetricEntry& entry, const MetricInput& input,
                       const std::string& referenceProblem) {
    if (entry.kind == MetricKind::Rest && !referenceProblem.empty()) return "no value: " + referenceProblem;
    if (input.trajectory.frames() < 2) return "no value: the run has no step";
    switch (entry.kind) {
        case MetricKind::Exact:
        case MetricKind::SchemeExact:
        case MetricKind::Measured:
            return "no value: the reference does not say this of the bodies";
        case MetricKind::Invariant:
            return "no value: the scene does not conserve this";
        case MetricKind::Contact:
            return hasContacts(input.trajectory) ? "no value: no contact of the run allows it"
                                                 : "no value: the run has no contact";
        case MetricKind::Joint:
            return "no value: no joint of the scene allows it";
        case MetricKind::Outcome:
            return "no value: the scene is no heap of bodies";
        case MetricKind::Rest:
            break;
    }
    return input.reference != nullptr ? "no value: no body rests in the exact solution"
                                      : "no value: the scene has no reference at rest";
}

/// A bound that is set must be evaluated: a metric that gives no value is a miss, unless it compares with a
/// reference that does not hold for these values.
void addMissing(const MetricEntry& entry, const MetricInput& input, const std::string& problem,
                const std::string& referenceProblem, CaseRow& row) {
    if (boundFor(input.scenario, row, entry.name) == nullptr) return;
    const bool compares = entry.kind == MetricKind::Exact || entry.kind == MetricKind::SchemeExact ||
                          entry.kind == MetricKind::Measured;
    if (problem.empty() && compares && input.reference == nullptr) return;
    MetricRow missing = metricRow(entry, {"", kNaN, -1.0});
    missing.note = problem.empty() ? whyNoValue(entry, input, referenceProblem) : problem;
    const std::string note = missing.note;
    judgeMetric(missing, input.scenario, row);
    missing.note = note;
    row.metrics.push_back(missing);
}

void evaluateMetric(const MetricEntry& entry, const MetricInput& input, const std::string& referenceProblem,
                    RelativeErrors& relative, CaseRow& row) {
    std::vector<MetricValue> values;
    std::string problem;
    try {
        values = entry.evaluate(input);
    } catch (const std::exception& error) {
        problem = std::string("could not be computed: ") + error.what();
    }
    if (values.empty()) {
        addMissing(entry, input, problem, referenceProblem, row);
        return;
    }
    std::vector<MetricRow> rows;
    for (const MetricValue& value : values) rows.push_back(metricRow(entry, value));
    relative.fill(entry, rows);
    keepWorstSubjects(rows);
    for (MetricRow& metric : rows) {
        if (metric.subject.empty()) judgeMetric(metric, input.scenario, row);
        row.metrics.push_back(std::move(metric));
    }
}

// ------------------------------------------------------------------------------------------- trajectory
results::Channel channel(const char* unit, int columns, std::size_t frames) {
    return {unit, columns, std::vector<double>(frames * columns, kNaN)};
}

results::BodyChannels emptyBody(const std::string& name, std::size_t frames) {
    return {name, channel("m", 3, frames), channel("1", 4, frames), channel("m/s", 3, frames),
            channel("rad/s", 3, frames)};
}

void set(results::Channel& c, std::size_t frame, const scenario::Vec3& v) {
    double* to = c.values.data() + 3 * frame;
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}
void set(results::Channel& c, std::size_t frame, const scenario::Quat& q) {
    double* to = c.values.data() + 4 * frame;
    to[0] = q.w;
    to[1] = q.x;
    to[2] = q.y;
    to[3] = q.z;
}

results::BodyChannels recordedBody(const Scenario& scenario, const Trajectory& t, int body) {
    auto channels = emptyBody(scenario.bodies[body].name, t.frames());
    for (std::size_t f = 0; f < t.frames(); ++f) {
        const BodyState& s = t.state(f, body);
        set(channels.position, f, s.position);
        set(channels.orientation, f, s.orientation);
        set(channels.velocity, f, s.velocity);
        set(channels.angularVelocity, f, s.angularVelocity);
    }
    return channels;
}

results::BodyChannels referenceBody(const Scenario& scenario, const Trajectory& t, const Reference& reference,
                                    int body) {
    auto channels = emptyBody(scenario.bodies[body].name, t.frames());
    bool known[4] = {};
    for (std::size_t f = 0; f < t.frames() && t.times[f] <= reference.validUntil(); ++f) {
        const PartialState s =
            reference.measured(body, t.times[f]).value_or(reference.exact(body, t.times[f]));
        if (s.position) {
            set(channels.position, f, *s.position);
            known[0] = true;
        }
        if (s.orientation) {
            set(channels.orientation, f, *s.orientation);
            known[1] = true;
        }
        if (s.velocity) {
            set(channels.velocity, f, *s.velocity);
            known[2] = true;
        }
        if (s.angularVelocity) {
            set(channels.angularVelocity, f, *s.angularVelocity);
            known[3] = true;
        }
    }
    results::Channel* all[4] = {&channels.position, &channels.orientation, &channels.velocity,
                                &channels.angularVelocity};
    for (int i = 0; i < 4; ++i)
        if (!known[i]) *all[i] = {};
    return channels;
}

results::ContactSample sample(double time, const ContactPoint& c) {
    results::ContactSample s;
    s.time = time;
    s.bodyA = c.bodyA;
    s.bodyB = c.bodyB;
    s.shapeA = c.shapeA;
    s.shapeB = c.shapeB;
    const auto copy = [](double* to, const scenario::Vec3& v) {
        to[0] = v.x;
        to[1] = v.y;
        to[2] = v.z;
    };
    copy(s.pointA, c.pointA);
    copy(s.pointB, c.pointB);
    copy(s.normal, c.normal);
    s.depth = c.depth;
    s.normalImpulse = c.hasImpulse ? c.normalImpulse : kNaN;
    if (c.hasImpulse) copy(s.frictionImpulse, c.frictionImpulse);
    return s;
}

/// Contacts of every n-th frame are stored, n as small as the size of the file allows.
std::size_t contactStride(const Trajectory& t) {
    constexpr std::size_t kMostContacts = 60000;
    std::size_t count = 0;
    for (const auto& frame : t.contacts) count += frame.size();
    return std::max<std::size_t>(1, (count + kMostContacts - 1) / kMostContacts);
}

std::vector<results::ContactSample> contactSamples(const Trajectory& t, std::size_t every) {
    std::vector<results::ContactSample> samples;
    for (std::size_t f = 0; f < t.contacts.size(); f += every)
        for (const ContactPoint& c : t.contacts[f]) samples.push_back(sample(t.times[f], c));
    return samples;
}

}  // namespace

ReferenceOrProblem referenceOf(const Scenario& scenario, const ReferenceMaker& make) {
    ReferenceOrProblem result;
    try {
        result.reference = make ? make(scenario) : makeReference(scenario);
    } catch (const AssumptionViolated& violated) {
        result.problem = violated.what();
    } catch (const std::invalid_argument& wrong) {
        result.problem = wrong.what();
    }
    return result;
}

void evaluateCase(const MetricInput& input, CaseRow& row, const std::string& referenceProblem) {
    RelativeErrors relative(input);
    for (const MetricEntry* entry : orderedMetrics(input.scenario))
        evaluateMetric(*entry, input, referenceProblem, relative, row);
    row.accuracy = relative.accuracyOf(row.metrics);
    if (input.reference == nullptr) return;
    for (const Quantity& q : input.reference->quantities(row.dt, input.scheme))
        row.quantities.push_back(
            {q.name, q.unit, q.exact, q.schemeExact, q.measure ? q.measure(input.trajectory) : std::nullopt});
}

results::TrajectoryFile trajectoryFile(const MetricInput& input, const CaseRow& row) {
    const Trajectory& t = input.trajectory;
    results::TrajectoryFile file;
    file.scenario = row.scenario;
    file.spec = row.spec;
    file.caseId = row.id;
    file.dt = t.dt;
    file.stride = t.stride;
    file.times = t.times;
    for (int body = 0; body < static_cast<int>(input.scenario.bodies.size()); ++body)
        file.bodies.push_back(recordedBody(input.scenario, t, body));
    if (input.reference != nullptr)
        for (const int body : input.reference->bodies())
            file.reference.push_back(referenceBody(input.scenario, t, *input.reference, body));
    for (const Series& s : diagnosticSeries(input))
        file.series.push_back({s.name, s.subject, {s.unit, 1, s.values}});
    const std::size_t every = contactStride(t);
    file.contactStride = every;
    file.contactsAtStepEnd = t.contactInstant == adapter::ContactInstant::StepEnd;
    file.contacts = contactSamples(t, every);
    return file;
}

}  // namespace rigor::validation
