// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Comparison of two runs of the same cases.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/results/trajectory_file.hpp"
#include "validation/results/types.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation::fixtures {

/// Everything of a run that must not depend on when and beside what it ran.
inline std::string timeless(const results::Run& run) {
    std::string text;
    for (results::CaseRow row : run.cases) {
        row.wallSeconds = row.cpuSeconds = 0.0;
        row.peakMemoryKiB = 0;
        row.timings.clear();
        row.command.clear();  // names the folder
        text += caseToJson(row).dump() + "\n";
    }
    return text;
}

/// Bit for bit, NaN included.
inline bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline void expectSameMotion(const results::TrajectoryFile& a, const results::TrajectoryFile& b) {
    EXPECT_TRUE(sameBits(a.times, b.times)) << a.spec;
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        EXPECT_TRUE(sameBits(a.bodies[i].position.values, b.bodies[i].position.values)) << a.spec;
        EXPECT_TRUE(sameBits(a.bodies[i].velocity.values, b.bodies[i].velocity.values)) << a.spec;
    }
    ASSERT_EQ(a.series.size(), b.series.size());
    for (std::size_t i = 0; i < a.series.size(); ++i)
        EXPECT_TRUE(sameBits(a.series[i].channel.values, b.series[i].channel.values)) << a.series[i].name;
}

}  // namespace rigor::validation::fixtures
