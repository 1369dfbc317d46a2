// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/references/rolling/line_roll.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::validation {
namespace {

double sign(double x) {
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/// Time until a speed that changes at this rate is zero; never if it does not come nearer.
double untilZero(double speed, double rate) {
    return speed * rate < 0.0 ? -speed / rate : std::numeric_limits<double>::infinity();
}

}  // namespace

LineRoll::LineRoll(const Setup& setup, double velocity, double roll) : setup_(setup) {
    State state{0.0, velocity, 0.0, roll};
    // Rounding of a start that rolls.
    if (std::abs(velocity - roll) <= 1e-9 * (std::abs(velocity) + std::abs(roll))) state.roll = velocity;
    double t = 0.0;
    constexpr int kMostPhases = 64;  // each law changes its sign once or twice
    for (int i = 0; i < kMostPhases; ++i) {
        phases_.push_back(phaseFrom(t, state));
        const Phase& phase = phases_.back();
        const double slip = state.velocity - state.roll;
        const double untilRolls = phase.slips ? untilZero(slip, phase.acceleration - phase.rollAcceleration)
                                              : std::numeric_limits<double>::infinity();
        const double untilTurns = untilZero(state.roll, phase.rollAcceleration);
        const double length = std::min(untilRolls, untilTurns);
        if (!std::isfinite(length)) return;
        t += length;
        state = at(t);
        if (untilTurns <= length) state.roll = 0.0;
        if (untilRolls <= length || (!phase.slips)) state.velocity = state.roll;
    }
}

LineRoll::Phase LineRoll::phaseFrom(double t, const State& state) const {
    const auto& [p, sliding, holding, resistance, k] = setup_;
    const double slip = state.velocity - state.roll;
    const auto slides = [&](double direction) {
        const double f = -sliding * direction;
        // The force -f turns the ball; where it does not turn yet, resistance may keep it so.
        const double turns = state.roll != 0.0 ? sign(state.roll) : sign(-f);
        const bool held = state.roll == 0.0 && sliding <= resistance;
        return Phase{t, state, p + f, held ? 0.0 : (-f - resistance * turns) / k, true};
    };
    if (slip != 0.0) return slides(sign(slip));
    if (state.roll == 0.0 && std::abs(p) <= resistance && std::abs(p) <= holding)
        return {t, state, 0.0, 0.0, false};
    const double turns = state.roll != 0.0 ? sign(state.roll) : sign(p);
    const bool starts = state.roll != 0.0 || std::abs(p) > resistance;
    const double rolls = starts ? (p - resistance * turns) / (1.0 + k) : 0.0;
    if (std::abs(rolls - p) <= holding) return {t, state, rolls, rolls, false};
    // Slips the way that it would without friction.
    const double direction = sign(starts ? p + resistance * turns / k : p);
    return slides(direction);
}

LineRoll::State LineRoll::at(double t) const {
    auto phase = phases_.end() - 1;
    while (phase != phases_.begin() && phase->begin > t) --phase;
    const double s = t - phase->begin;
    const State& from = phase->start;
    return {from.way + s * (from.velocity + 0.5 * s * phase->acceleration),
            from.velocity + s * phase->acceleration,
            from.turned + s * (from.roll + 0.5 * s * phase->rollAcceleration),
            from.roll + s * phase->rollAcceleration};
}

std::optional<double> LineRoll::restTime() const {
    const Phase& last = phases_.back();
    const bool rests = last.start.velocity == 0.0 && last.start.roll == 0.0 && last.acceleration == 0.0 &&
                       last.rollAcceleration == 0.0;
    return rests ? std::optional<double>(last.begin) : std::nullopt;
}

std::optional<double> LineRoll::rollTime() const {
    if (phases_.back().slips) return std::nullopt;
    auto phase = phases_.end() - 1;
    while (phase != phases_.begin() && !(phase - 1)->slips) --phase;
    return phase->begin;
}

}  // namespace rigor::validation
