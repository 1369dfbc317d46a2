// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The schedule with engines and a clock that are made up: order, interleaving, stopping, going on.
#include "validation/bench/schedule.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace rigor::validation {
namespace {

using results::Bench;
using results::BenchCase;
using results::BenchRepetition;

Bench benchOf(const std::vector<std::string>& scenes, const std::vector<std::string>& engines) {
    Bench bench;
    for (const auto& scene : scenes)
        for (const auto& engine : engines) {
            BenchCase c;
            c.id = scene + engine;
            c.part = "scene";
            c.name = scene;
            c.engine = engine;
            bench.cases.push_back(c);
        }
    return bench;
}

/// Time of a synthetic repetition, by case and round.
using Clock = std::function<double(const BenchCase&, std::int64_t round)>;

BenchRepetition repetition(double seconds, std::int64_t round) {
    BenchRepetition r;
    r.round = round;
    r.wall = r.cpu = seconds;
    r.samples = 1;
    r.processSeconds = 1.0;
    return r;
}

/// Takes up to `most` repetitions; the names of the cases in the order in which they ran.
std::vector<std::pair<std::string, std::int64_t>> take(Bench& bench, const BenchTarget& target,
                                                       const Clock& clock, int most = 100000) {
    std::vector<std::pair<std::string, std::int64_t>> ran;
    for (int i = 0; i < most; ++i) {
        const auto next = nextRepetition(bench, target);
        if (!next) break;
        BenchCase& c = bench.cases[next->index];
        c.repetitions.push_back(repetition(clock(c, next->round), next->round));
        ran.emplace_back(c.id, next->round);
    }
    return ran;
}

double steady(const BenchCase&, std::int64_t round) {
    return 1.0 + 1e-4 * static_cast<double>(round % 3);
}

/// Never narrow: every other repetition takes twice as long.
double wild(const BenchCase&, std::int64_t round) {
    return round % 2 == 0 ? 1.0 : 2.0;
}

TEST(Schedule, EnginesOfASceneRunBesideEachOtherInRandomOrder) {
    Bench bench = benchOf({"x", "y", "z"}, {"a", "b", "c", "d"});
    const auto ran = take(bench, {}, steady);
    std::set<std::string> firsts, orders;
    for (std::size_t i = 0; i < ran.size(); i += 4) {
        std::set<std::string> names;
        std::string order;
        for (std::size_t k = i; k < i + 4; ++k) {
            EXPECT_EQ(ran[k].first.substr(0, 1), ran[i].first.substr(0, 1)) << "a scene is interrupted";
            EXPECT_EQ(ran[k].second, ran[i].second);
            names.insert(ran[k].first);
            order += ran[k].first.substr(1);
        }
        EXPECT_EQ(names.size(), 4u) << "every engine once";
        orders.insert(order);
        if (i % 12 == 0) firsts.insert(ran[i].first.substr(0, 1));
    }
    EXPECT_GT(orders.size(), 8u) << "engines always come in the same order";
    EXPECT_GT(firsts.size(), 1u) << "scenes always come in the same order";
}

TEST(Schedule, TheOrderIsThatOfTheSeed) {
    BenchTarget one, other;
    other.seed = 2;
    Bench a = benchOf({"x", "y"}, {"a", "b", "c"}), b = a, c = a;
    const auto first = take(a, one, steady);
    EXPECT_EQ(first, take(b, one, steady));
    EXPECT_NE(first, take(c, other, steady));
}

TEST(Schedule, StopsWhenTheIntervalIsNarrow) {
    Bench bench = benchOf({"x"}, {"a", "b"});
    take(bench, {}, steady);
    for (const auto& c : bench.cases) EXPECT_EQ(c.repetitions.size(), 7u);  // the look and six
}

TEST(Schedule, GoesOnUntilTheWidestIsNarrowOrTheMostIsReached) {
    BenchTarget target;
    target.most = 11;
    Bench bench = benchOf({"x", "y"}, {"a", "b"});
    take(bench, target, [](const BenchCase& c, std::int64_t round) {
        return c.id == "xb" ? wild(c, round) : steady(c, round);
    });
    // b keeps a company: their rounds stay pairs.
    EXPECT_EQ(bench.cases[0].repetitions.size(), 12u);
    EXPECT_EQ(bench.cases[1].repetitions.size(), 12u);
    EXPECT_EQ(bench.cases[2].repetitions.size(), 7u);
    EXPECT_FALSE(isConverged(bench.cases[1], target));
    EXPECT_TRUE(isConverged(bench.cases[0], target));
}

TEST(Schedule, TheBudgetEndsItAtTheEndOfARound) {
    BenchTarget target;
    target.budget = 13.0;  // each repetition takes a second
    Bench bench = benchOf({"x", "y"}, {"a", "b"});
    EXPECT_EQ(take(bench, target, wild).size(), 16u);
    target.budget = 0.0;
    Bench least = benchOf({"x"}, {"a"});
    EXPECT_EQ(take(least, target, wild).size(), 2u) << "the look and one timing";
}

TEST(Schedule, WhoFailedIsLeftOut) {
    Bench bench = benchOf({"x"}, {"a", "b"});
    const BenchTarget target;
    take(bench, target, steady, 2);
    bench.cases[1].repetitions[0].outcome = "unsupported";
    take(bench, target, steady);
    EXPECT_EQ(bench.cases[0].repetitions.size(), 7u);
    EXPECT_EQ(bench.cases[1].repetitions.size(), 1u);
}

TEST(Schedule, WhoseWorkWasNotGoodIsTimedOnce) {
    for (const std::size_t bad : {0u, 1u}) {  // the look, or the first timed round
        Bench bench = benchOf({"x"}, {"a", "b"});
        const BenchTarget target;
        take(bench, target, steady, bad == 0 ? 2 : 4);
        bench.cases[1].repetitions[bad].quality = {{"missed", "1", 2.0, std::nullopt, 1.0, false}};
        EXPECT_GT(forecast(bench, target).repetitions, 0);
        take(bench, target, steady);
        EXPECT_EQ(bench.cases[0].repetitions.size(), 7u);
        EXPECT_EQ(bench.cases[1].repetitions.size(), 2u);
        EXPECT_EQ(forecast(bench, target).repetitions, 0);
    }
}

TEST(Schedule, GoesOnWhereItWasKilled) {
    const BenchTarget target;
    Bench whole = benchOf({"x", "y"}, {"a", "b", "c"});
    const auto uninterrupted = take(whole, target, steady);
    Bench parts = benchOf({"x", "y"}, {"a", "b", "c"});
    std::vector<std::pair<std::string, std::int64_t>> ran;
    while (true) {  // killed after every five; the repetition under way is lost, the stored ones are not
        const auto some = take(parts, target, steady, 5);
        if (some.empty()) break;
        ran.insert(ran.end(), some.begin(), some.end());
    }
    EXPECT_EQ(ran, uninterrupted);
}

TEST(Schedule, ThreadsAreTimedByTheWall) {
    BenchTarget target;
    BenchCase c;
    EXPECT_EQ(clockOf(c, target), "cpu");
    c.threads = 2;
    EXPECT_EQ(clockOf(c, target), "wall");
    target.clock = "cpu";
    EXPECT_EQ(clockOf(c, target), "cpu");
}

TEST(Schedule, TheForecastEndsAtNothing) {
    Bench bench = benchOf({"x"}, {"a", "b"});
    const BenchTarget target;
    EXPECT_LT(forecast(bench, target).seconds, 0.0);
    take(bench, target, steady, 4);
    EXPECT_EQ(forecast(bench, target).repetitions, 10);
    EXPECT_DOUBLE_EQ(forecast(bench, target).seconds, 10.0);
    take(bench, target, steady);
    EXPECT_EQ(forecast(bench, target).repetitions, 0);
}

}  // namespace
}  // namespace rigor::validation
