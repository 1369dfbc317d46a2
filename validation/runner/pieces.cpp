// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "adapters/interface/state_setting.hpp"
#include "validation/runner/simulate.hpp"
#include "validation/runner/stepper.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using adapter::BodyState;
using results::MetricRow;
using scenario::Scenario;
using States = std::vector<BodyState>;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

bool isDynamic(const Scenario& s, std::size_t body) {
    return s.bodies[body].type == scenario::BodyType::Dynamic;
}

/// The states at every step of the case.
struct Truth {
    std::vector<States> at;
    std::string name;  ///< "the reference free_flight", "a run at dt/16"
};

/// States of every dynamic body at every step; empty if one part of one is unknown.
std::optional<Truth> truthOfReference(const Scenario& s, double dt, const Reference& reference) {
    const auto known = reference.bodies();
    const std::size_t steps = stepCount(s, dt);
    Truth truth{{}, "the reference " + s.reference->name};
    for (std::size_t n = 0; n <= steps; ++n) {
        const double t = n * dt;
        if (t > reference.validUntil()) return std::nullopt;
        States& states = truth.at.emplace_back(s.bodies.size());
        for (std::size_t i = 0; i < s.bodies.size(); ++i) {
            if (!isDynamic(s, i)) continue;
            const int body = i;
            if (std::find(known.begin(), known.end(), body) == known.end()) return std::nullopt;
            const PartialState p = reference.exact(body, t);
            if (!p.position || !p.orientation || !p.velocity || !p.angularVelocity) return std::nullopt;
            states[i] = {*p.position, *p.orientation, *p.velocity, *p.angularVelocity};
        }
    }
    return truth;
}

/// The run of the same engine at a finer step; empty when its states become infinite.
std::optional<Truth> convergedTruth(const Scenario& s, double dt, const WorldMaker& build) {
    const double fine = dt / kConvergedSteps;
    const auto world = build(fine);
    Stepper stepper(s, fine, *world);
    Truth truth{{}, "a run of its own at dt/" + std::to_string(kConvergedSteps)};
    const std::size_t steps = stepCount(s, dt);
    for (std::size_t n = 0; n <= steps; ++n) {
        if (!stepper.nonFinite().empty()) return std::nullopt;
        const auto states = stepper.states();
        truth.at.emplace_back(states.begin(), states.end());
        for (int k = 0; k < kConvergedSteps && n < steps; ++k) {
            stepper.begin();
            world->step();
            stepper.end();
        }
    }
    return truth;
}

/// The angle of the rotation from one orientation to another [rad].
double angleBetween(const scenario::Quat& a, const scenario::Quat& b) {
    const scenario::Quat q = scenario::conjugate(a) * b;
    return 2.0 * std::atan2(norm(scenario::Vec3{q.x, q.y, q.z}), std::abs(q.w));
}

/// Errors of the pieces of one length, one value for each piece.
struct PieceErrors {
    std::vector<double> ways, turns, ends;  ///< [m], [rad], when the piece ends [s]
};

PieceErrors pieceErrorsOf(const Scenario& s, double dt, std::size_t every, adapter::World& world,
                          adapter::StateSetting& setter, const Truth& truth) {
    PieceErrors errors;
    Stepper stepper(s, dt, world);
    for (std::size_t start = 0; start + every < truth.at.size(); start += every) {
        setter.setStates(truth.at[start]);
        stepper.jumpTo(start);
        for (std::size_t k = 0; k < every; ++k) {
            stepper.begin();
            world.step();
            stepper.end();
        }
        const auto now = stepper.states();
        const States& wanted = truth.at[start + every];
        double way = 0.0, turn = 0.0;
        for (std::size_t i = 0; i < s.bodies.size(); ++i) {
            if (!isDynamic(s, i)) continue;
            way = std::max(way, norm(now[i].position - wanted[i].position));
            turn = std::max(turn, angleBetween(now[i].orientation, wanted[i].orientation));
        }
        const bool lost = !stepper.nonFinite().empty();
        errors.ways.push_back(lost ? kNoValue : way);
        errors.turns.push_back(lost ? kNoValue : turn);
        errors.ends.push_back(stepper.time());
        if (lost) break;
    }
    return errors;
}

MetricRow rowOf(const std::string& name, int every, const char* unit, double value, double at,
                const std::string& note) {
    MetricRow row;
    row.name = name;
    row.subject = "every " + std::to_string(every) + (every == 1 ? " step" : " steps");
    row.unit = unit;
    row.kind = "pieces";
    row.value = value;
    row.at = at;
    row.note = note;
    return row;
}

/// Median and worst of one kind of miss.
void addRows(std::vector<MetricRow>& rows, const std::string& name, int every, const char* unit,
             const std::vector<double>& values, const std::vector<double>& ends, const std::string& note) {
    const bool lost = values.empty() || std::isnan(values.back());
    const auto worst = std::max_element(values.begin(), values.end());
    rows.push_back(rowOf(name, every, unit, lost ? kNoValue : median(values), -1.0, note));
    rows.push_back(rowOf(name + "_worst", every, unit, lost ? kNoValue : *worst,
                         lost ? -1.0 : ends[worst - values.begin()], note));
}

}  // namespace

std::vector<MetricRow> measurePieces(const Scenario& scenario, double dt, const std::vector<int>& every,
                                     const WorldMaker& build, const Reference* reference) {
    std::vector<MetricRow> rows;
    const auto without = [&](const std::string& why) {
        for (const int k : every) {
            addRows(rows, "piece_error", k, "m", {}, {}, why);
            addRows(rows, "piece_turn", k, "rad", {}, {}, why);
        }
        return rows;
    };
    if (dynamic_cast<adapter::StateSetting*>(build(dt).get()) == nullptr)
        return without("the adapter cannot put bodies back yet");
    std::optional<Truth> truth;
    if (reference != nullptr) truth = truthOfReference(scenario, dt, *reference);
    if (!truth) truth = convergedTruth(scenario, dt, build);
    if (!truth) return without("the run at a finer step became infinite");
    for (const int k : every) {
        const auto world = build(dt);
        auto& setter = dynamic_cast<adapter::StateSetting&>(*world);
        const PieceErrors errors = pieceErrorsOf(scenario, dt, k, *world, setter, *truth);
        const std::string note = errors.ways.empty()
                                     ? "the run is shorter than a piece"
                                     : std::to_string(errors.ways.size()) + " pieces, put back on " +
                                           truth->name + "; warm start " + setter.warmStart();
        addRows(rows, "piece_error", k, "m", errors.ways, errors.ends, note);
        addRows(rows, "piece_turn", k, "rad", errors.turns, errors.ends, note);
    }
    return rows;
}

}  // namespace rigor::validation
