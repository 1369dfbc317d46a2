// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Quality of a timed run, which a fast engine may not trade for its speed. Computed from states and from the
// contacts that the engine reports, in double, with one implementation for all engines.
#pragma once

#include <span>
#include <vector>

#include "adapters/interface/types.hpp"
#include "scenarios/model/scenario.hpp"
#include "validation/results/bench_types.hpp"

namespace rigor::validation {

/// Follows one run of a scenario. No time is measured while it reads.
class QualityMeter {
  public:
    /// `start`: the states before the first step.
    QualityMeter(const scenario::Scenario& scenario, std::span<const adapter::BodyState> start);

    /// States after a step: energy gained and joints apart, the worst of all that were shown.
    void sample(std::span<const adapter::BodyState> states);
    /// States and contacts of the step at which the rest is read.
    void finish(std::span<const adapter::BodyState> states,
                const std::vector<adapter::ContactPoint>& contacts);

    /// All quantities that the scenario has, with its bounds where it sets some.
    std::vector<results::BenchQuality> rows() const;

  private:
    double heightOf(std::size_t body, const adapter::BodyState& state) const;
    double jointGap(std::span<const adapter::BodyState> states) const;

    const scenario::Scenario& scenario_;
    double startEnergy_ = 0.0, energyGain_ = 0.0, jointGap_ = 0.0;
    double maxPenetration_ = 0.0, meanPenetration_ = 0.0, kinetic_ = 0.0, top_ = 0.0, lowest_ = 0.0;
    double pairs_ = 0.0;
};

/// Pairs of bodies that touch in these contacts.
double touchingPairs(const std::vector<adapter::ContactPoint>& contacts);

}  // namespace rigor::validation
