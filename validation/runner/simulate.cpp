// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>

#include "validation/runner/cost.hpp"
#include "validation/runner/stepper.hpp"
#include "validation/statistics/quantile.hpp"
#include "validation/statistics/statistics.hpp"

namespace rigor::validation {
namespace {

using scenario::Scenario;
constexpr std::size_t kMostStates = 400000;  ///< recorded body states per case: 42 MB as doubles

/// The first sample apart: a first step that builds everything up, or iterates 401 times, hides in a median
/// and drags a mean.
void describeAfterFirst(const std::vector<double>& samples, results::TimingRow& row) {
    if (samples.size() < 2) return;
    row.first = samples.front();
    std::vector<double> others(samples.begin() + 1, samples.end());
    row.mean = std::accumulate(others.begin(), others.end(), 0.0) / others.size();
    std::sort(others.begin(), others.end());
    row.p95 = quantileOfSorted(others, 0.95);
    row.p99 = quantileOfSorted(others, 0.99);
    row.worst = others.back();
}

/// The interval of the median is that of statistics.hpp: the information of this run's steps on their median.
/// Steps of one run resemble their neighbours, and another run may find the machine in another mood.
results::TimingRow timingRow(const std::string& phase, std::vector<double> samples, double meanContacts) {
    results::TimingRow row;
    row.phase = phase;
    row.meanContacts = meanContacts;
    row.samples = samples.size();
    if (samples.empty()) return row;
    for (const double s : samples) row.total += s;
    if (const auto interval = medianInterval(samples)) {
        row.low = interval->low;
        row.high = interval->high;
    }
    describeAfterFirst(samples, row);
    std::sort(samples.begin(), samples.end());
    row.median = quantileOfSorted(samples, 0.5);
    row.p10 = quantileOfSorted(samples, 0.1);
    row.p90 = quantileOfSorted(samples, 0.9);
    return row;
}

/// Wall times of step() alone, by the engine's own clock where it is in another process, the engine's own phase
/// times, and how many contacts there were.
class Stopwatch {
  public:
    void measure(adapter::World& world) {
        const auto begin = std::chrono::steady_clock::now();
        world.step();
        const auto end = std::chrono::steady_clock::now();
        const adapter::StepCounters counters = world.counters();
        const double wall = std::chrono::duration<double>(end - begin).count();
        steps_.push_back(counters.stepSeconds >= 0.0 ? counters.stepSeconds : wall);
        costs_.add(counters);
        for (const auto& [phase, seconds] : counters.phaseSeconds) phases_[phase].push_back(seconds);
        if (counters.contacts >= 0) {
            contacts_ += counters.contacts;
            ++counted_;
        }
    }
    std::vector<results::TimingRow> rows(const Trajectory& trajectory) const {
        const double contacts = counted_ > 0 ? contacts_ / counted_ : recordedContacts(trajectory);
        std::vector<results::TimingRow> rows{timingRow("step", steps_, contacts)};
        if (rows[0].mean && *rows[0].mean > 0.0) rows[0].realTimeFactor = trajectory.dt / *rows[0].mean;
        for (const auto& [phase, samples] : phases_) rows.push_back(timingRow(phase, samples, contacts));
        return rows;
    }

    std::vector<results::MetricRow> costs() const { return costs_.rows(); }

  private:
    static double recordedContacts(const Trajectory& t) {
        double sum = 0.0;
        for (const auto& frame : t.contacts) sum += frame.size();
        return t.frames() > 1 ? sum / (t.frames() - 1) : 0.0;
    }
    CostMeter costs_;
    std::vector<double> steps_;
    std::map<std::string, std::vector<double>> phases_;
    double contacts_ = 0.0;
    std::size_t counted_ = 0;
};

void appendFrame(Trajectory& t, double time, std::span<const BodyState> states) {
    t.times.push_back(time);
    t.states.insert(t.states.end(), states.begin(), states.end());
    t.contacts.emplace_back();
}

}  // namespace

std::size_t stepCount(const Scenario& scenario, double dt) {
    return static_cast<std::size_t>(std::max(1.0, std::round(scenario.duration / dt)));
}

int recordingStride(std::size_t steps, std::size_t bodies) {
    const std::size_t least = std::max<std::size_t>(1, (steps * bodies + kMostStates - 1) / kMostStates);
    for (std::size_t stride = least; stride <= 2 * least; ++stride)
        if (steps % stride == 0) return stride;
    return least;
}

Simulation simulate(const Scenario& scenario, double dt, adapter::World& world, const LiveOptions& options) {
    const std::size_t bodies = scenario.bodies.size(), total = stepCount(scenario, dt);
    Simulation run;
    Trajectory& t = run.trajectory;
    t.dt = dt;
    t.bodyCount = bodies;
    t.stride = options.stride > 0 ? options.stride : recordingStride(total, bodies);
    const auto stride = static_cast<std::size_t>(t.stride);
    t.contactInstant = world.contactInstant();
    const bool atEnd = t.contactInstant == adapter::ContactInstant::StepEnd;

    Stepper stepper(scenario, dt, world);
    std::vector<ContactPoint> contacts;
    appendFrame(t, 0.0, stepper.states());
    if (options.onWorld) options.onWorld(world);
    if (options.onStep) options.onStep(0.0, stepper.states(), {});
    run.nonFinite = stepper.nonFinite();

    Stopwatch watch;
    while (stepper.steps() < total && run.nonFinite.empty()) {
        const bool beginsAtFrame = stepper.steps() % stride == 0;
        stepper.begin();
        watch.measure(world);
        stepper.end();
        const bool endsAtFrame = stepper.steps() % stride == 0;
        const bool recorded = atEnd ? endsAtFrame : beginsAtFrame;
        if (recorded || options.onStep) world.readContacts(contacts);
        if (recorded && !atEnd) t.contacts.back() = contacts;
        if (endsAtFrame) {
            appendFrame(t, stepper.time(), stepper.states());
            if (atEnd) t.contacts.back() = contacts;
            run.nonFinite = stepper.nonFinite();
        }
        if (options.onWorld) options.onWorld(world);
        if (options.onStep) options.onStep(stepper.time(), stepper.states(), contacts);
    }
    if (!atEnd) t.contacts.back().clear();  // contacts of steps that no frame ends
    if (run.nonFinite.empty()) run.nonFinite = stepper.nonFinite();
    run.steps = stepper.steps();
    run.stateHash = stepper.stateHash();
    run.timings = watch.rows(t);
    run.costs = watch.costs();
    return run;
}

}  // namespace rigor::validation
