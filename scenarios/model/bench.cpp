// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/model/bench.hpp"

#include <array>

namespace rigor::scenario {
namespace {

constexpr std::array<QualityName, 8> kNames{{{Quality::MaxPenetration, "max_penetration", "m"},
                                             {Quality::MeanPenetration, "mean_penetration", "m"},
                                             {Quality::KineticEnergy, "kinetic_energy", "J"},
                                             {Quality::EnergyGain, "energy_gain", "J"},
                                             {Quality::JointGap, "joint_gap", "m"},
                                             {Quality::TopHeight, "top_height", "m"},
                                             {Quality::LowestHeight, "lowest_height", "m"},
                                             {Quality::ContactPairs, "contact_pairs", ""}}};

}  // namespace

std::span<const QualityName> qualityNames() {
    return kNames;
}

const QualityName& nameOf(Quality quantity) {
    return kNames[static_cast<std::size_t>(quantity)];
}

}  // namespace rigor::scenario
