// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shards merged are the whole run, row for row; what does not fit together is refused by name.
#include "validation/runner/merge.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/tests/fixtures.hpp"
#include "validation/runner/tests/same_runs.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using fixtures::plan;
using fixtures::thrownBall;
using testing::HasSubstr;

class Merge : public fixtures::RunnerTest {
  protected:
    std::vector<CasePlan> cases_ =
        plan({thrownBall("a"), fixtures::crossingBalls(), thrownBall("c"), thrownBall("d"), thrownBall("e")},
             "double_free_flight,double_abort,double_nan:preset=default");

    RunOptions shardOptions(const std::string& folder, int number, int count) const {
        RunOptions o = options(folder);
        o.audit = true;
        o.shard = Shard{number, count};
        return o;
    }
    fs::path runShard(const std::vector<CasePlan>& whole, int number, int count,
                      const std::string& prefix = "shard") {
        RunOptions o = shardOptions(prefix + std::to_string(number), number, count);
        const auto own = casesOfShard(whole, *o.shard);
        run(own, o);
        return o.directory;
    }
    std::vector<fs::path> runShards(int count) {
        std::vector<fs::path> folders;
        for (int k = 1; k <= count; ++k) folders.push_back(runShard(cases_, k, count));
        return folders;
    }
    MergeOptions into(std::vector<fs::path> shards, const std::string& out = "merged") const {
        return {std::move(shards), scratch_.path() / out, false, "rigor merge"};
    }
    results::Run wholeRun() {
        RunOptions o = options("whole");
        o.audit = true;
        return run(cases_, o);
    }
    static std::string refusal(const MergeOptions& options) {
        try {
            mergeShards(options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    }
    void expectWhole(const results::Run& merged, const results::Run& whole) {
        EXPECT_EQ(fixtures::timeless(merged), fixtures::timeless(whole));
        EXPECT_EQ(merged.plannedCases, whole.plannedCases);
        EXPECT_EQ(merged.orders.size(), whole.orders.size());
        EXPECT_EQ(merged.fairness.size(), whole.fairness.size());
        ASSERT_EQ(merged.scenarios.size(), whole.scenarios.size());
        for (std::size_t i = 0; i < whole.scenarios.size(); ++i)
            EXPECT_EQ(merged.scenarios[i].text, whole.scenarios[i].text) << i;
        for (const auto& row : whole.cases)
            if (!row.trajectoryFile.empty()) {
                EXPECT_EQ(results::readFile(fs::path(merged.directory) / row.trajectoryFile),
                          results::readFile(fs::path(whole.directory) / row.trajectoryFile));
            }
    }
};

TEST_F(Merge, ShardsHaveWholeScenariosAndAllOfThem) {
    std::vector<std::string> ids;
    for (int k = 1; k <= 3; ++k) {
        Shard shard{k, 3};
        for (const auto& c : casesOfShard(cases_, shard)) ids.push_back(c.id);
        EXPECT_EQ(shard.planned, cases_.size());
    }
    std::vector<std::string> all;
    for (const auto& c : cases_) all.push_back(c.id);
    EXPECT_THAT(ids, testing::UnorderedElementsAreArray(all));
    Shard second{2, 3};
    for (const auto& c : casesOfShard(cases_, second))
        EXPECT_THAT(c.scenario.name, testing::AnyOf("crossing_balls", "e"));
    for (const char* text : {"0/3", "4/3", "2", "2/", "/3", "a/b", "1/2/3", "-1/3", ""})
        EXPECT_THROW(parseShard(text), std::invalid_argument) << text;
    EXPECT_EQ(parseShard("2/8").count, 8);
}

TEST_F(Merge, ShardsMergedAreTheWholeRun) {
    const auto whole = wholeRun();
    const auto folders = runShards(3);
    const auto merged = mergeShards(into({folders[2], folders[0], folders[1]}));
    expectWhole(merged, whole);
    EXPECT_FALSE(merged.finished.empty());
    EXPECT_EQ(merged.environment.at("merged"), "3 shards");
    EXPECT_EQ(merged.environment.at("cpu"), whole.environment.at("cpu"));
    const std::string before = fixtures::timeless(merged);
    EXPECT_EQ(fixtures::timeless(mergeShards(into(folders))), before) << "a second time";
}

TEST_F(Merge, AnInterruptedMergeGoesOn) {
    const auto whole = wholeRun();
    const auto folders = runShards(2);
    mergeShards(into(folders));
    const fs::path out = scratch_.path() / "merged";
    {
        std::vector<std::string> kept;
        for (int i = 0; i < 4; ++i) kept.push_back(whole.cases[i].id);
        results::RunWriter(out, true).keepOnly(kept);
    }
    fs::remove(out / whole.cases.front().trajectoryFile);
    std::ofstream(out / whole.cases[1].trajectoryFile, std::ios::app) << "damage";
    expectWhole(mergeShards(into(folders)), whole);
}

TEST_F(Merge, MissingAndUnfinishedShardsAreNamed) {
    const auto folders = runShards(3);
    EXPECT_THAT(refusal(into({folders[0], folders[2]})), HasSubstr("missing or unfinished shards of 3: 2"));
    MergeOptions partial = into({folders[0], folders[2]});
    partial.partial = true;
    const auto merged = mergeShards(partial);
    EXPECT_TRUE(merged.finished.empty());
    EXPECT_EQ(merged.plannedCases, static_cast<std::int64_t>(cases_.size()));
    EXPECT_LT(merged.cases.size(), cases_.size());
    EXPECT_THAT(merged.environment.at("merged"), HasSubstr("missing or unfinished: 2"));
    expectWhole(mergeShards(into(folders)), wholeRun());
}

TEST_F(Merge, AFinishedShardThatLacksACaseIsRefused) {
    const auto folders = runShards(2);
    std::vector<std::string> kept;
    for (const auto& row : results::readRun(folders[1]).cases) kept.push_back(row.id);
    kept.pop_back();
    results::RunWriter(folders[1], true).keepOnly(kept);
    const auto planned = std::to_string(cases_.size()), found = std::to_string(cases_.size() - 1);
    EXPECT_THAT(refusal(into(folders)), HasSubstr("found " + found + " cases in the 2 shards, expected the " +
                                                  planned + " of the plan"));
    EXPECT_FALSE(fs::exists(scratch_.path() / "merged"));
}

TEST_F(Merge, WhatDoesNotFitIsRefusedByName) {
    const auto folders = runShards(2);
    EXPECT_THAT(refusal(into({})), HasSubstr("no shard"));
    EXPECT_THAT(refusal(into({scratch_.path() / "nothing"})), HasSubstr("is no run folder"));
    wholeRun();
    EXPECT_THAT(refusal(into({options("whole").directory})), HasSubstr("is no shard"));
    const auto other = plan({thrownBall("a"), thrownBall("c")}, "double_free_flight");
    const auto stranger = runShard(other, 2, 2, "stranger");
    EXPECT_THAT(refusal(into({folders[0], stranger})), HasSubstr("different plans"));

    const auto copied = [&](const std::string& name) {
        const fs::path copy = scratch_.path() / name;
        fs::copy(folders[1], copy, fs::copy_options::recursive);
        return copy;
    };
    const fs::path damaged = copied("damaged");
    std::string bytes = results::readFile(damaged / "results.sqlite");
    bytes.replace(bytes.find("SIGABRT"), 7, "SIGSEGV");
    results::replaceFile(damaged / "results.sqlite", bytes);
    EXPECT_THAT(refusal(into({folders[0], damaged})), HasSubstr("do not fit their checksum"));
    const auto rewritten = [&](const std::string& name, const std::function<void(results::Run&)>& change) {
        const fs::path copy = copied(name);
        results::Run run = results::readRun(copy);
        change(run);
        results::RunWriter writer(copy, true);
        writer.writeHeader(run);
        for (const auto& row : run.cases) writer.writeCase(row);
        return copy;
    };
    EXPECT_THAT(
        refusal(into(
            {folders[0], rewritten("version", [](auto& r) { r.environment["shard_version"] = "0.0.1"; })})),
        HasSubstr("different versions: rigor"));
    EXPECT_THAT(
        refusal(into({folders[0], rewritten("engine", [](auto& r) { r.engines[0].version += "x"; })})),
        HasSubstr("different versions or builds of the engine"));
    EXPECT_THAT(refusal(into({folders[0], folders[1],
                              rewritten("text", [](auto& r) { r.scenarios[0].text += " "; })})),
                HasSubstr("different scenarios of the name"));
    EXPECT_THAT(refusal(into({folders[0], folders[1],
                              rewritten("rows", [](auto& r) { r.cases[0].stateHash += "0"; })})),
                HasSubstr("different rows"));
    EXPECT_EQ(refusal(into({folders[0], folders[1],
                            rewritten("times", [](auto& r) { r.cases[0].wallSeconds += 1.0; })})),
              "");
}

TEST_F(Merge, ADamagedTrajectoryOfAShardIsRefused) {
    const auto folders = runShards(2);
    const auto run = results::readRun(folders[1]);
    const auto file = folders[1] / run.cases.front().trajectoryFile;
    std::ofstream(file, std::ios::app) << "damage";
    EXPECT_THAT(refusal(into(folders)), HasSubstr(file.string()));
}

/// Timings of two machines never meet in one comparison: a scenario that another machine began is run anew.
TEST_F(Merge, AShardThatGoesOnOnAnotherMachineRunsBegunScenariosAnew) {
    RunOptions o = shardOptions("moved", 1, 1);
    const auto own = casesOfShard(cases_, *o.shard);
    std::atomic<bool> interrupted{false};
    runCases(
        own, o, [&](const Progress& p) { interrupted = p.done >= 7; }, interrupted);
    {
        results::Run stored = results::readRun(o.directory);
        ASSERT_EQ(stored.cases.size(), 7u) << "one scenario of five cases, and two of the next";
        stored.environment["machine"] = "another";
        results::RunWriter(o.directory, true).writeHeader(stored);
    }
    o.resume = true;
    std::int64_t kept = 0;
    const std::atomic<bool> never{false};
    const auto resumed = runCases(
        own, o, [&](const Progress& p) { kept = p.skipped; }, never);
    EXPECT_EQ(kept, 5);
    EXPECT_THAT(resumed.environment.at("earlier_machines"), HasSubstr("another"));
    EXPECT_EQ(fixtures::timeless(resumed), fixtures::timeless(wholeRun()));
}

}  // namespace
}  // namespace rigor::validation
