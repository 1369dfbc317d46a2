// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See accuracy.hpp.
#include "validation/accuracy/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/energy.hpp"

namespace rigor::validation {
namespace {

using results::MetricRow;
using scenario::Scenario;

constexpr double kInf = std::numeric_limits<double>::infinity();

bool isNamed(const Scenario& scenario, const std::string& metric) {
    return std::find(scenario.metrics.begin(), scenario.metrics.end(), metric) != scenario.metrics.end();
}

double relativeTo(double scale, double value) {
    const double relative = std::abs(value) / scale;
    return std::isnan(relative) ? kInf : relative;
}

bool isRecording(const Reference& reference) {
    for (const int body : reference.bodies())
        if (reference.measured(body, 0.0)) return true;
    return false;
}

}  // namespace

std::string whyNotGraded(const Scenario& scenario, const Reference* reference) {
    if (reference == nullptr)
        return scenario.reference ? "the exact solution does not hold for these values" : "no exact solution";
    return isRecording(*reference) ? "compared with a recording, which has errors of its own" : "";
}

IdealRun idealRun(const MetricInput& input) {
    IdealRun ideal;
    const Trajectory& like = input.trajectory;
    ideal.run.dt = like.dt;
    ideal.run.stride = like.stride;
    ideal.run.bodyCount = like.bodyCount;
    ideal.run.times = like.times;
    ideal.run.states = like.states;
    if (input.reference == nullptr || like.frames() < 2) return ideal;
    const std::size_t frames = validFrames(input);
    const auto bodies = comparedBodies(input);
    ideal.position = ideal.orientation = ideal.velocity = ideal.spin = !bodies.empty();
    for (const int body : bodies)
        for (std::size_t frame = 0; frame < frames; ++frame) {
            const auto step = frame * like.stride;
            const auto known =
                input.reference->schemeExact(body, step, like.dt, input.scheme).value_or(PartialState{});
            BodyState& state = ideal.run.states[frame * like.bodyCount + body];
            const auto set = [](auto& to, const auto& from, bool& isKnown) {
                isKnown = isKnown && from.has_value();
                if (from) to = *from;
            };
            set(state.position, known.position, ideal.position);
            set(state.orientation, known.orientation, ideal.orientation);
            set(state.velocity, known.velocity, ideal.velocity);
            set(state.angularVelocity, known.angularVelocity, ideal.spin);
            if (!ideal.position && !ideal.orientation && !ideal.velocity && !ideal.spin) return ideal;
        }
    ideal.wholeState =
        ideal.position && ideal.orientation && ideal.velocity && ideal.spin && frames == like.frames();
    for (int body = 0; body < static_cast<int>(input.scenario.bodies.size()); ++body)
        if (isDynamic(input.scenario, body) && std::find(bodies.begin(), bodies.end(), body) == bodies.end())
            ideal.wholeState = false;
    return ideal;
}

RelativeErrors::RelativeErrors(const MetricInput& input)
    : input_(input), whyNot_(whyNotGraded(input.scenario, input.reference)) {
    if (whyNot_.empty()) scales_ = sceneScales(input.scenario, input.reference);
}

const IdealRun& RelativeErrors::run() {
    if (!run_) run_ = idealRun(input_);
    return *run_;
}

std::optional<double> RelativeErrors::scaleOfRow(ScaleKind kind, const std::string& subject,
                                                 const MetricInput& of) const {
    switch (kind) {
        case ScaleKind::One:
        case ScaleKind::Radian:
            return 1.0;
        case ScaleKind::Distance:
            return scales_.distance;
        case ScaleKind::Angle:
            return scales_.angle;
        case ScaleKind::Speed:
            return scales_.speed;
        case ScaleKind::Spin:
            return scales_.spin;
        case ScaleKind::Size:
            return scales_.size;
        case ScaleKind::JointTravel:
            return scales_.jointTravel;
        case ScaleKind::EnergyInJoule:
            return scales_.energy;
        case ScaleKind::Energy:
            // The metric was divided by energyScale(), which may come from the run.
            if (const double unit = energyScale(of); scales_.energy && unit > 0.0)
                return *scales_.energy / unit;
            return std::nullopt;
        case ScaleKind::EventTime:
            for (const Quantity& q : input_.reference->quantities(input_.trajectory.dt, input_.scheme))
                if (q.name == subject)
                    return std::abs(q.exact) > 0.0 ? std::abs(q.exact) : input_.scenario.duration;
            return std::nullopt;
    }
    return std::nullopt;
}

void RelativeErrors::setRelative(ScaleKind kind, const MetricInput& of, std::vector<MetricRow>& rows) const {
    MetricRow* scene = nullptr;
    const MetricRow* worst = nullptr;
    for (MetricRow& row : rows) {
        if (row.subject.empty()) scene = &row;
        if (const auto scale = scaleOfRow(kind, row.subject, of); scale && *scale > 0.0) {
            row.scale = *scale;
            row.relative = relativeTo(*scale, row.value);
        }
        if (!row.subject.empty() && row.relative && (worst == nullptr || *row.relative > *worst->relative))
            worst = &row;
    }
    if (scene != nullptr && worst != nullptr && (!scene->relative || *worst->relative > *scene->relative)) {
        scene->scale = worst->scale;
        scene->relative = worst->relative;
    }
}

std::optional<double> RelativeErrors::idealOfQuantities(ScaleKind kind) {
    double worst = 0.0;
    bool any = false;
    for (const Quantity& q : input_.reference->quantities(input_.trajectory.dt, input_.scheme)) {
        if (!q.measure || (kind == ScaleKind::EventTime && q.unit != "s")) continue;
        std::optional<double> value = q.schemeExact;
        if (!value && run().wholeState) value = q.measure(run().run);
        if (!value) return std::nullopt;
        const double scale = kind == ScaleKind::EventTime ? scaleOfRow(kind, q.name, input_).value_or(1.0)
                                                          : scaleOf(q, q.exact);
        worst = std::max(worst, relativeTo(scale, *value - q.exact));
        any = true;
    }
    return any ? std::optional<double>(worst) : std::nullopt;
}

std::optional<double> RelativeErrors::ideal(const MetricEntry& entry, const ScaleEntry& scale) {
    const auto isKnown = [&] {
        switch (scale.ideal) {
            case IdealKind::Position:
                return run().position;
            case IdealKind::Orientation:
                return run().orientation;
            case IdealKind::Velocity:
                return run().velocity;
            case IdealKind::Spin:
                return run().spin;
            case IdealKind::WholeState:
                return run().wholeState;
            default:
                return false;
        }
    };
    if (scale.ideal == IdealKind::Quantities) return idealOfQuantities(scale.scale);
    if (scale.ideal == IdealKind::Unknown || !isKnown()) return std::nullopt;
    const MetricInput input{input_.scenario, run().run, input_.reference, input_.scheme};
    std::vector<MetricRow> rows;
    for (const MetricValue& value : entry.evaluate(input)) {
        MetricRow& row = rows.emplace_back();
        row.subject = value.subject;
        row.value = value.value;
    }
    setRelative(scale.scale, input, rows);
    return rows.empty() ? std::nullopt : rows.front().relative;
}

void RelativeErrors::fill(const MetricEntry& entry, std::vector<MetricRow>& rows) {
    const ScaleEntry* scale = findScale(entry.name);
    if (scale == nullptr || !whyNot_.empty()) return;
    setRelative(scale->scale, input_, rows);
    for (MetricRow& row : rows)
        if (row.subject.empty() && row.relative && isNamed(input_.scenario, row.name))
            row.ideal = ideal(entry, *scale);
}

results::AccuracyRow RelativeErrors::accuracyOf(const std::vector<MetricRow>& rows) const {
    results::AccuracyRow accuracy;
    accuracy.note = whyNot_;
    if (!whyNot_.empty()) return accuracy;
    for (const MetricRow& row : rows) {
        if (!row.subject.empty() || !row.relative || !isNamed(input_.scenario, row.name)) continue;
        if (accuracy.relative && !(*row.relative > *accuracy.relative)) continue;
        accuracy.metric = row.name;
        accuracy.relative = row.relative;
        accuracy.ideal = row.ideal;
        accuracy.grade = results::gradeOf(*row.relative);
    }
    if (accuracy.grade == results::Grade::None)
        accuracy.note = "none of the metrics named has an exact solution";
    return accuracy;
}

}  // namespace rigor::validation
