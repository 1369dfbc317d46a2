// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Timing of a scene, and the bounds that its run has to keep for the timing to count. Quantities are measured
// by the harness, from states and contacts, the same way for every engine.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace rigor::scenario {

/// Quantity that a timing's bound limits.
enum class Quality {
    MaxPenetration,   ///< largest depth of the contacts [m]
    MeanPenetration,  ///< mean depth of the contacts that overlap [m]
    KineticEnergy,    ///< kinetic energy of all dynamic bodies [J]
    EnergyGain,    ///< most that kinetic and potential energy rose above the start, in any step examined [J]
    JointGap,      ///< largest distance between the two anchors of a joint, in any step examined [m]
    TopHeight,     ///< height of the highest dynamic body's centre of mass, against gravity [m]
    LowestHeight,  ///< height of the lowest one: bodies that fell through the floor show here [m]
    ContactPairs,  ///< pairs of bodies in touch
};
struct QualityName {
    Quality quantity;
    std::string_view key;   ///< name in files: "max_penetration", ...
    std::string_view unit;  ///< "m", "J" or ""
};
/// All of them, in the order of the enum.
std::span<const QualityName> qualityNames();
const QualityName& nameOf(Quality quantity);

/// min <= value <= max.
struct QualityBound {
    Quality quantity = Quality::MaxPenetration;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();

    /// NaN is never within.
    bool holds(double value) const { return value >= min && value <= max; }
};

/// Steps of the scenario's first dt: `warmUpSteps` without a clock, then `timedSteps` with one, then without
/// one up to step `qualityStep`, where the bounds are tested.
struct BenchPlan {
    int warmUpSteps = 0;                ///< >= 0
    int timedSteps = 1;                 ///< >= 1
    int qualityStep = 1;                ///< >= warmUpSteps + timedSteps
    std::vector<int> sizes;             ///< values of Scenario::size for a growth curve, rising; empty: none
    std::vector<QualityBound> quality;  ///< each quantity once
};

}  // namespace rigor::scenario
