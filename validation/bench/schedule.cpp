// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "validation/statistics/quantile.hpp"
#include "validation/statistics/statistics.hpp"

namespace rigor::validation {
namespace {

using results::Bench;
using results::BenchCase;
using results::BenchRepetition;

using Group = std::vector<std::size_t>;  ///< indices of cases

std::vector<Group> groupsOf(const Bench& bench) {
    std::map<std::tuple<std::string, std::string, double>, std::size_t> places;
    std::vector<Group> groups;
    for (std::size_t i = 0; i < bench.cases.size(); ++i) {
        const BenchCase& c = bench.cases[i];
        const auto [it, isNew] = places.try_emplace({c.part, c.name, c.size}, groups.size());
        if (isNew) groups.emplace_back();
        groups[it->second].push_back(i);
    }
    return groups;
}

/// Fisher and Yates; the standard library's shuffle is not the same everywhere.
template <class List>
void shuffle(List& list, std::mt19937_64& random) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random() % i]);
}

std::vector<Group> inOrderOf(std::vector<Group> groups, std::uint64_t seed, std::int64_t round) {
    std::seed_seq sequence{seed & 0xffffffffu, seed >> 32, static_cast<std::uint64_t>(round)};
    std::mt19937_64 random(sequence);
    shuffle(groups, random);
    for (Group& group : groups) shuffle(group, random);
    return groups;
}

bool isGood(const BenchRepetition& r) {
    return std::all_of(r.quality.begin(), r.quality.end(), [](const auto& q) { return q.ok; });
}

/// No repetition before `round` failed; nor is this more than the first timed one of work that was out of
/// bounds once: its times count for nothing, one is enough to be shown.
bool isLive(const BenchCase& c, std::int64_t round) {
    return std::none_of(c.repetitions.begin(), c.repetitions.end(), [&](const BenchRepetition& r) {
        return r.round < round && (r.outcome != "completed" || (round > 1 && !isGood(r)));
    });
}

bool has(const BenchCase& c, std::int64_t round) {
    return std::any_of(c.repetitions.begin(), c.repetitions.end(),
                       [&](const BenchRepetition& r) { return r.round == round; });
}

/// Times of the rounds before `round`.
std::vector<double> timesBefore(const BenchCase& c, const std::string& clock, std::int64_t round) {
    std::vector<double> times;
    for (const BenchRepetition& r : c.repetitions)
        if (r.round > 0 && r.round < round && r.outcome == "completed")
            times.push_back(clock == "wall" ? r.wall : r.cpu);
    return times;
}

/// True if the case was converged when the round began.
bool wasConverged(const BenchCase& c, const BenchTarget& target, std::int64_t round) {
    const auto times = timesBefore(c, clockOf(c, target), round);
    if (static_cast<int>(times.size()) < target.least) return false;
    const auto interval = medianInterval(times);
    return interval && interval->high - interval->low <= target.width * median(times);
}

constexpr std::int64_t kAllRounds = std::numeric_limits<std::int64_t>::max();

double spentBefore(const Bench& bench, std::int64_t round) {
    double seconds = 0.0;
    for (const BenchCase& c : bench.cases)
        for (const BenchRepetition& r : c.repetitions)
            if (r.round < round) seconds += r.processSeconds;
    return seconds;
}

bool wants(const Bench& bench, const Group& group, std::int64_t round, const BenchTarget& target) {
    if (round <= 1) return true;
    if (round > target.most) return false;
    if (round <= target.least) return true;
    return std::any_of(group.begin(), group.end(), [&](std::size_t i) {
        const BenchCase& c = bench.cases[i];
        return isLive(c, round) && !wasConverged(c, target, round);
    });
}

}  // namespace

std::string clockOf(const BenchCase& c, const BenchTarget& target) {
    if (target.clock != "auto") return target.clock;
    return c.threads > 1 ? "wall" : "cpu";
}

std::vector<double> timesOf(const BenchCase& c, const std::string& clock) {
    return timesBefore(c, clock, kAllRounds);
}

bool isConverged(const BenchCase& c, const BenchTarget& target) {
    return wasConverged(c, target, kAllRounds);
}

std::optional<NextRepetition> nextRepetition(const Bench& bench, const BenchTarget& target) {
    const auto groups = groupsOf(bench);
    for (std::int64_t round = 0; round <= std::max(1, target.most); ++round) {
        if (round > 1 && spentBefore(bench, round) >= target.budget) return std::nullopt;
        for (const Group& group : inOrderOf(groups, target.seed, round)) {
            if (!wants(bench, group, round, target)) continue;
            for (const std::size_t i : group)
                if (isLive(bench.cases[i], round) && !has(bench.cases[i], round))
                    return NextRepetition{i, round};
        }
    }
    return std::nullopt;
}

namespace {

/// Repetitions that a case needs in all.
int needed(const BenchCase& c, const BenchTarget& target) {
    const auto times = timesOf(c, clockOf(c, target));
    const auto interval = medianInterval(times);
    if (!interval || isConverged(c, target)) return target.least;
    const double excess = (interval->high - interval->low) / (target.width * median(times));
    const double count = times.size() * excess * excess;
    return static_cast<int>(std::clamp(count, static_cast<double>(target.least), double(target.most)));
}

}  // namespace

BenchForecast forecast(const Bench& bench, const BenchTarget& target) {
    double spent = 0.0, coming = 0.0;
    std::int64_t done = 0, left = 0;
    for (const BenchCase& c : bench.cases)
        for (const BenchRepetition& r : c.repetitions) {
            spent += r.processSeconds;
            ++done;
        }
    if (done == 0) return {};
    const double usual = spent / done;
    for (const Group& group : groupsOf(bench)) {
        int rounds = 0;
        for (const std::size_t i : group) rounds = std::max(rounds, needed(bench.cases[i], target));
        for (const std::size_t i : group) {
            const BenchCase& c = bench.cases[i];
            if (!isLive(c, target.most + 1)) continue;
            const auto missing =
                std::max<std::int64_t>(0, rounds + 1 - static_cast<std::int64_t>(c.repetitions.size()));
            double own = 0.0;
            for (const BenchRepetition& r : c.repetitions) own += r.processSeconds;
            const double each = c.repetitions.empty() ? usual : own / c.repetitions.size();
            left += missing;
            coming += missing * each;
        }
    }
    if (spent + coming > target.budget && coming > 0.0) {
        const double share = std::max(0.0, target.budget - spent) / coming;
        left = static_cast<std::int64_t>(std::ceil(share * left));
        coming *= share;
    }
    return {left, coming};
}

}  // namespace rigor::validation
