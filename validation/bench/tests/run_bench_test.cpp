// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Whole benches of engines with known faults and known speeds, each repetition in a process of its own.
#include "validation/bench/run_bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "scenarios/loader/loader.hpp"
#include "validation/bench/print.hpp"
#include "validation/bench/summary.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A thrown ball; the doubles have no contacts. Energy may only be lost, but for `gain`.
std::string thrownBall(const std::string& gain) {
    return R"({"rigor": 1, "name": "thrown", "title": "A thrown ball", "dimension": 3,
  "gravity": [0, -9.81, 0], "duration": 0.3, "dt": [0.01], "materials": {"steel": {}},
  "bench": {"warm_up_steps": 10, "timed_steps": 15, "quality_step": 30, "quality": {"energy_gain": )" +
           gain + R"(}},
  "bodies": [{"name": "ball", "mass": 2, "position": [0, 2, 0], "velocity": [1, 1, 0],
              "shapes": [{"sphere": {"radius": 0.1}}]}]})";
}

class RunBench : public testing::Test {
  protected:
    void SetUp() override {
        setenv("RIGOR_ADAPTER_PATH", (fs::path(RIGOR_BINARY_DIR) / "tests/doubles").c_str(), 1);
        options_.directory = scratch_.path() / "run";
        options_.binary = fs::path(RIGOR_BINARY_DIR) / "tests/bench_child";
        options_.target.least = 3;
        options_.target.most = 3;
        options_.suite = options_.command = "test";
    }

    std::vector<BenchWork> plan(const std::string& specs, const std::string& gain = "1e9") const {
        SceneRequest request;
        auto loaded = scenario::loadScenarioText(thrownBall(gain), "thrown.json");
        request.scenes.push_back({std::move(loaded.scenario), std::move(loaded.text), "thrown.json"});
        request.specs = adapter::parseSpecList(specs);
        std::vector<std::string> names;
        for (const auto& spec : request.specs) names.push_back(spec.engine);
        return planScenes(request, describeEngines(names, options_.binary, 1));
    }
    results::Run run(const std::vector<BenchWork>& work) {
        const std::atomic<bool> never{false};
        return runBench(work, options_, {}, never);
    }
    static const results::BenchCase& caseOf(const results::Run& run, const std::string& engine) {
        for (const auto& c : run.bench.cases)
            if (c.engine.starts_with(engine)) return c;
        throw std::runtime_error("no case of " + engine);
    }

    ScratchFolder scratch_;
    BenchOptions options_;
};

TEST_F(RunBench, DistinguishesSpeeds) {
    options_.base = "double_free_flight";
    const auto done = run(plan("double_free_flight,double_free_flight:pause_us=3000"));
    ASSERT_EQ(done.bench.cases.size(), 2u);
    const auto &fast = done.bench.cases[0], &slow = done.bench.cases[1];
    EXPECT_TRUE(fast.summary.valid) << fast.summary.reason;
    EXPECT_TRUE(slow.summary.valid) << slow.summary.reason;
    ASSERT_EQ(slow.repetitions.size(), 4u);
    for (const auto& r : slow.repetitions) {
        EXPECT_GE(r.wall, 3e-3);
        EXPECT_LT(r.cpu, 3e-3) << "a sleeping process takes no processor time";
        EXPECT_EQ(r.samples, 15);
        EXPECT_GT(r.peakMemoryKiB, 0);
        EXPECT_EQ(r.stateHash, fast.repetitions[0].stateHash) << "the same engine, only slower";
    }
    EXPECT_GE(countOf(fast, "longest_ms"), 1e3 * fast.summary.cpu) << "no step is longer than the longest";
    EXPECT_EQ(slow.summary.base, fast.id);
    EXPECT_FALSE(done.finished.empty());
    EXPECT_EQ(done.environment.count("load_after"), 1u);
    EXPECT_EQ(done.bench.settings.at("seed"), "1");
}

TEST_F(RunBench, TheLookCountsAllocations) {
    if (isSanitized()) GTEST_SKIP() << "a sanitizer has an allocator of its own";
    const fs::path build = RIGOR_BINARY_DIR;
    setenv("RIGOR_ADAPTER_PATH",
           ((build / "tests/doubles").string() + ":" + (build / "bin/adapters").string()).c_str(), 1);
    const auto done = run(plan("double_free_flight,double_free_flight:allocations=3"));
    const auto &none = done.bench.cases.at(0).repetitions, &three = done.bench.cases.at(1).repetitions;
    ASSERT_TRUE(none[0].allocations && three[0].allocations && three[0].allocatedBytes);
    EXPECT_DOUBLE_EQ(*none[0].allocations, 0.0);
    EXPECT_DOUBLE_EQ(*three[0].allocations, 3.0);
    EXPECT_DOUBLE_EQ(*three[0].allocatedBytes, 192.0);
    for (std::size_t i = 1; i < three.size(); ++i)
        EXPECT_FALSE(three[i].allocations) << "counting takes time";
}

/// Sleeping bodies are not work: the table reports their number.
TEST_F(RunBench, ReportsTheNumberOfSleepingBodies) {
    const auto done = run(plan("double_free_flight,double_free_flight:asleep=1"));
    EXPECT_EQ(countOf(done.bench.cases.at(0), "asleep"), 0.0);
    EXPECT_EQ(countOf(done.bench.cases.at(1), "asleep"), 1.0);
    EXPECT_THAT(benchText(done, false), HasSubstr("asleep: bodies that the engine has stopped"));
    options_.directory = scratch_.path() / "awake";
    const auto awake = run(plan("double_free_flight"));
    EXPECT_THAT(benchText(awake, false), Not(HasSubstr("asleep"))) << "no column of zeros";
}

TEST_F(RunBench, ATimingOfABadRunIsInvalid) {
    const auto done = run(plan("double_rigid,double_rigid:fault=gravity_double", "0.5"));
    EXPECT_TRUE(caseOf(done, "double_rigid:preset").summary.valid)
        << caseOf(done, "double_rigid:preset").summary.reason;
    const auto& bad = caseOf(done, "double_rigid:fault").summary;
    EXPECT_FALSE(bad.valid);
    EXPECT_THAT(bad.reason, HasSubstr("energy_gain"));
    EXPECT_GT(bad.wall, 0.0);
    EXPECT_FALSE(bad.ratio);
}

TEST_F(RunBench, AnEngineThatDiesIsAResult) {
    const auto done = run(plan("double_rigid,double_segfault,double_nan"));
    EXPECT_TRUE(caseOf(done, "double_rigid").summary.valid);
    EXPECT_THAT(caseOf(done, "double_segfault").summary.reason, HasSubstr("crashed"));
    EXPECT_EQ(caseOf(done, "double_segfault").repetitions.size(), 1u);
    EXPECT_THAT(caseOf(done, "double_nan").summary.reason, HasSubstr("non_finite"));
}

TEST_F(RunBench, GoesOnAfterAKill) {
    const auto work = plan("double_free_flight,double_free_flight:pause_us=10");
    std::atomic<bool> interrupted{false};
    int seen = 0;
    const auto stop = [&](const BenchProgress& p) {
        if (p.finished != nullptr && ++seen == 5) interrupted = true;
    };
    const auto part = runBench(work, options_, stop, interrupted);
    EXPECT_TRUE(part.finished.empty());
    std::map<std::string, double> kept;
    for (const auto& c : part.bench.cases)
        for (const auto& r : c.repetitions) kept[c.id + std::to_string(r.round)] = r.wall;
    EXPECT_EQ(kept.size(), 5u);
    options_.resume = true;
    const auto whole = run(work);
    EXPECT_FALSE(whole.finished.empty());
    std::set<std::int64_t> orders;
    for (const auto& c : whole.bench.cases) {
        EXPECT_EQ(c.repetitions.size(), 4u);
        for (const auto& r : c.repetitions) {
            orders.insert(r.order);
            const auto it = kept.find(c.id + std::to_string(r.round));
            if (it == kept.end()) continue;
            EXPECT_EQ(r.wall, it->second) << "measured again";
        }
    }
    EXPECT_EQ(orders.size(), 8u);
}

TEST_F(RunBench, TheSameWorkHasTheSameIdInAnotherRun) {
    const auto one = plan("double_rigid"), two = plan("double_rigid"), other = plan("double_free_flight");
    EXPECT_EQ(benchId(one[0].planned), benchId(two[0].planned));
    EXPECT_NE(benchId(one[0].planned), benchId(other[0].planned));
    options_.target.least = options_.target.most = 1;
    const auto before = run(one);
    options_.directory = scratch_.path() / "again";
    const auto after = run(two);
    EXPECT_EQ(changesSince(before.bench, after.bench, {}).size(), 1u);
}

TEST(BenchScenes, TheStepsAreThoseOfTheScenario) {
    const auto loaded = scenario::loadScenarioText(thrownBall("1"), "thrown.json");
    const SceneSteps steps = sceneSteps(loaded.scenario, 0.01);
    EXPECT_EQ(steps.warmUp, 10u);
    EXPECT_EQ(steps.timed, 15u);
    EXPECT_EQ(steps.quality, 30u);
    scenario::Scenario plain = loaded.scenario;
    plain.bench.reset();
    const SceneSteps last = sceneSteps(plain, 0.01);
    EXPECT_EQ(last.warmUp, 20u);
    EXPECT_EQ(last.timed, 10u);
    EXPECT_EQ(last.quality, 30u);
}

EngineDescription described(const std::string& name, bool threads) {
    EngineDescription d;
    d.info.name = name;
    d.capabilities.dynamics = true;
    d.capabilities.dimensions = {3};
    if (threads) d.options.push_back({"threads", {}, 1, 64, true, "1", "1", ""});
    return d;
}

TEST(BenchScenes, ThreadsAreForEnginesThatHaveThem) {
    const auto specs = [](const std::string& text, bool threads) {
        std::vector<std::string> out;
        const auto spec = adapter::parseSpec(text);
        for (const auto& s : threadedSpecs(spec, "matched", {1, 2}, described(spec.engine, threads)))
            out.push_back(s.name + " = " + s.given + " x" + std::to_string(s.threads));
        return out;
    };
    EXPECT_THAT(specs("a", false), testing::ElementsAre("a:preset=matched = a:preset=matched x1"));
    EXPECT_THAT(specs("a", true), testing::ElementsAre("a:preset=matched = a:preset=matched,threads=1 x1",
                                                       "a:preset=matched = a:preset=matched,threads=2 x2"));
    EXPECT_THAT(specs("a:threads=4,preset=default", true),
                testing::ElementsAre("a:preset=default,threads=4 = a:preset=default,threads=4 x4"));
}

}  // namespace
}  // namespace rigor::validation
