// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;
using adapter::ContactPoint;
using results::BenchQuality;
using scenario::Vec3;

Vec3 upwards(const scenario::Scenario& scenario) {
    const double g = norm(scenario.gravity);
    return g > 0.0 ? scenario.gravity / -g : Vec3{0.0, 1.0, 0.0};
}

/// Sets the bounds of the scenario, and whether they are kept; not-a-number never does.
void judgeQuality(std::vector<BenchQuality>& rows, const scenario::Scenario& scenario) {
    if (scenario.bench)
        for (const scenario::QualityBound& bound : scenario.bench->quality)
            for (BenchQuality& q : rows) {
                if (q.name != scenario::nameOf(bound.quantity).key) continue;
                if (std::isfinite(bound.min)) q.min = bound.min;
                if (std::isfinite(bound.max)) q.max = bound.max;
            }
    for (BenchQuality& q : rows)
        q.ok = !std::isnan(q.value) && (!q.min || q.value >= *q.min) && (!q.max || q.value <= *q.max);
}

/// The larger one; not-a-number stays.
double worse(double a, double b) {
    return std::isnan(b) || b > a ? b : a;
}

}  // namespace

double touchingPairs(const std::vector<ContactPoint>& contacts) {
    std::set<std::pair<int, int>> pairs;
    for (const ContactPoint& c : contacts) pairs.emplace(c.bodyA, c.bodyB);
    return pairs.size();
}

QualityMeter::QualityMeter(const scenario::Scenario& scenario, std::span<const BodyState> start)
    : scenario_(scenario), startEnergy_(mechanicsOf(scenario, start).energy()) {}

double QualityMeter::heightOf(std::size_t body, const BodyState& state) const {
    return dot(upwards(scenario_), centerOfMassOf(scenario_.bodies[body], state));
}

double QualityMeter::jointGap(std::span<const BodyState> states) const {
    if (scenario_.joints.empty()) return 0.0;
    static const MetricEntry* drift = findMetric("joint_drift");
    Trajectory frames;
    frames.dt = 1.0;
    frames.bodyCount = states.size();
    for (const double t : {0.0, 1.0}) {  // a metric needs two frames at least
        frames.times.push_back(t);
        frames.states.insert(frames.states.end(), states.begin(), states.end());
    }
    const auto rows = drift->evaluate({scenario_, frames, nullptr, adapter::Scheme::Unknown});
    return rows.empty() ? 0.0 : rows.front().value;
}

void QualityMeter::sample(std::span<const BodyState> states) {
    energyGain_ = worse(energyGain_, mechanicsOf(scenario_, states).energy() - startEnergy_);
    jointGap_ = worse(jointGap_, jointGap(states));
}

void QualityMeter::finish(std::span<const BodyState> states, const std::vector<ContactPoint>& contacts) {
    sample(states);
    kinetic_ = mechanicsOf(scenario_, states).kinetic;
    double sum = 0.0;
    std::size_t overlapping = 0;
    for (const ContactPoint& c : contacts) {
        maxPenetration_ = worse(maxPenetration_, c.depth);
        if (c.depth > 0.0) {
            sum += c.depth;
            ++overlapping;
        }
    }
    meanPenetration_ = overlapping > 0 ? sum / overlapping : 0.0;
    pairs_ = touchingPairs(contacts);
    top_ = -std::numeric_limits<double>::infinity();
    lowest_ = -top_;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (scenario_.bodies[i].type != scenario::BodyType::Dynamic) continue;
        top_ = worse(top_, heightOf(i, states[i]));
        lowest_ = -worse(-lowest_, -heightOf(i, states[i]));
    }
}

std::vector<BenchQuality> QualityMeter::rows() const {
    using scenario::Quality;
    const std::pair<Quality, double> values[] = {{Quality::MaxPenetration, maxPenetration_},
                                                 {Quality::MeanPenetration, meanPenetration_},
                                                 {Quality::KineticEnergy, kinetic_},
                                                 {Quality::EnergyGain, energyGain_},
                                                 {Quality::JointGap, jointGap_},
                                                 {Quality::TopHeight, top_},
                                                 {Quality::LowestHeight, lowest_},
                                                 {Quality::ContactPairs, pairs_}};
    std::vector<BenchQuality> rows;
    for (const auto& [quantity, value] : values) {
        if (quantity == Quality::JointGap && scenario_.joints.empty()) continue;
        const scenario::QualityName& name = scenario::nameOf(quantity);
        const std::string unit(name.unit.empty() ? "1" : name.unit);
        rows.push_back({std::string(name.key), unit, value, std::nullopt, std::nullopt, true});
    }
    judgeQuality(rows, scenario_);
    return rows;
}

}  // namespace rigor::validation
