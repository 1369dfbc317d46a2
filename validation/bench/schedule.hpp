// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Choice of the next repetition. It is a function of the stored repetitions alone, so that a bench that was
// killed goes on as if it had not been interrupted.
//
// Cases of the same part, name and size are a group. A round runs every group once, groups in random order,
// and inside a group its cases (engines, threads) in random order one right after the other: whatever the
// machine does in the meantime, engines that are compared see the same of it. The order of a round follows
// from the seed and the round. Round 0 is the look: it enters no statistic. A group goes on until every case
// of it has a narrow interval, so that rounds stay complete; a case that failed is left out from then on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "validation/results/bench_types.hpp"

namespace rigor::validation {

struct BenchTarget {
    double width = 0.05;     ///< (high - low) / median that is narrow enough; 95 % interval of the median
    int least = 6;           ///< timed repetitions of every case; below six there is no interval
    int most = 30;           ///< maximum number of repetitions
    double budget = 1800.0;  ///< [s] of all processes together; no round but the first two begins beyond it
    std::uint64_t seed = 1;  ///< seed of the order
    std::string clock = "auto";  ///< "cpu", "wall", or "auto": cpu for one thread, wall for more
};

/// The clock that counts for a case.
std::string clockOf(const results::BenchCase& c, const BenchTarget& target);

/// Times [s] of the completed repetitions that count (rounds 1, 2, ...), by round.
std::vector<double> timesOf(const results::BenchCase& c, const std::string& clock);

/// True if the interval of the median is narrow enough.
bool isConverged(const results::BenchCase& c, const BenchTarget& target);

struct NextRepetition {
    std::size_t index = 0;  ///< index of the case
    std::int64_t round = 0;
};
/// Next repetition; empty at the end of the bench.
std::optional<NextRepetition> nextRepetition(const results::Bench& bench, const BenchTarget& target);

/// Estimate of the number of repetitions still to come and of their time: the number that makes the widest
/// interval of each group narrow if it shrinks with the root of their number, within the budget.
struct BenchForecast {
    std::int64_t repetitions = 0;
    double seconds = -1.0;  ///< -1: nothing is known yet
};
BenchForecast forecast(const results::Bench& bench, const BenchTarget& target);

}  // namespace rigor::validation
