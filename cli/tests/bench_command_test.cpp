// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor bench` as a user calls it, on engines of known behaviour.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"
#include "validation/results/store.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class BenchCommand : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(RIGOR_BINARY_DIR) / ("bench-test-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        std::ofstream(folder_ / "ball.json") << R"({"rigor": 1, "name": "thrown", "title": "A thrown ball",
  "dimension": 3, "gravity": [0, -9.81, 0], "duration": 0.2, "dt": [0.01], "materials": {"steel": {}}, "size": 1,
  "bodies": [{"name": "ball", "mass": 2, "position": [0, 2, 0], "shapes": [{"sphere": {"radius": 0.1}}]}],
  "generators": [{"grid": {"name": "more", "counts": [{"size": 1}, 1, 1], "spacing": [1, 1, 1], "origin": [5, 0, 0],
                           "body": {"shapes": [{"sphere": {"radius": 0.1}}]}}}]})";
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// `--any-build`: the tests run in every build.
    Result bench(const std::string& arguments, bool withErrors = true) const {
        return rigor("bench " + (folder_ / "ball.json").string() + " --any-build " + arguments, withErrors,
                     "RIGOR_ADAPTER_PATH=" + (fs::path(RIGOR_BINARY_DIR) / "tests/doubles").string());
    }
    std::string out(const std::string& name) const { return " --out " + (folder_ / name).string(); }

    fs::path folder_;
};

TEST_F(BenchCommand, PrintsATableAndWritesTheReport) {
    const auto result = bench(
        "--engines double_free_flight,double_free_flight:pause_us=2000 --clock wall --least 6 --most 6" +
        out("run"));
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("thrown, 2 bodies: "));
    EXPECT_THAT(result.out, HasSubstr("double_free_flight:pause_us=2000,preset=matched"));
    EXPECT_THAT(result.out, HasSubstr("base"));
    EXPECT_THAT(result.out, HasSubstr("index.html"));
    for (const char* file :
         {"index.html", "results.sqlite", "tables/bench.csv", "tables/bench.md", "summary.md"})
        EXPECT_TRUE(fs::exists(folder_ / "run" / file)) << file;
}

TEST_F(BenchCommand, JsonHoldsEveryRepetition) {
    const auto result = bench(
        "--engines double_free_flight,double_free_flight:pause_us=2000 --least 2 --most 2 --seed 5 --clock "
        "wall --json -q" +
            out("run"),
        false);
    ASSERT_EQ(result.code, 0) << result.out;
    const json all = json::parse(result.out);
    EXPECT_EQ(all.at("settings").at("seed"), "5");
    EXPECT_TRUE(all.at("environment").contains("caches"));
    EXPECT_TRUE(all.at("environment").contains("load_after"));
    ASSERT_EQ(all.at("cases").size(), 2u);
    const json& slow = all.at("cases").at(1);
    EXPECT_TRUE(slow.at("valid").get<bool>());
    EXPECT_EQ(slow.at("repetitions").size(), 3u);
    EXPECT_GT(slow.at("median").get<double>(), 2e-3);
    EXPECT_GT(slow.at("ratio").get<double>(), 10.0);
    EXPECT_THAT(slow.at("command").get<std::string>(), HasSubstr("pause_us=2000"));
}

TEST_F(BenchCommand, SizesMakeAGrowthCurve) {
    const auto result =
        bench("--engines double_free_flight --least 1 --most 1 --size 3,6 --json -q" + out("run"), false);
    ASSERT_EQ(result.code, 0) << result.out;
    const json cases = json::parse(result.out).at("cases");
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases.at(0).at("size"), 4.0);
    EXPECT_EQ(cases.at(1).at("size"), 7.0);
    EXPECT_THAT(cases.at(1).at("command").get<std::string>(), HasSubstr("--size 6"));
}

TEST_F(BenchCommand, AnEngineNamedTwiceIsTimedOnce) {
    const auto result = bench(
        "--engines double_free_flight,double_free_flight --least 1 --most 1 --json -q" + out("twice"), false);
    ASSERT_EQ(result.code, 0) << result.out;
    EXPECT_EQ(json::parse(result.out).at("cases").size(), 1u);
}

TEST_F(BenchCommand, ABaselineIsComparedCaseByCase) {
    const std::string common = " --least 8 --most 8 --clock wall -q";
    ASSERT_EQ(bench("--engines double_free_flight:pause_us=1000" + common + out("before")).code, 0);
    const auto same = bench("--engines double_free_flight:pause_us=1000 --threshold 900" + common +
                            out("same") + " --baseline " + (folder_ / "before").string());
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_THAT(same.out, HasSubstr("same"));
    const auto other = bench("--engines double_free_flight" + common + out("other") + " --baseline " +
                             (folder_ / "before").string());
    EXPECT_EQ(other.code, 0) << other.out;
    EXPECT_THAT(other.out, HasSubstr("no case is in both runs"));
}

/// The stored times of a run, as if everything had taken `factor` times as long.
void scaleTimes(const fs::path& run, double factor) {
    const auto stored = results::readRun(run);
    results::RunWriter writer(run, true);
    for (const auto& c : stored.bench.cases)
        for (auto r : c.repetitions) {
            r.wall *= factor;
            r.cpu *= factor;
            writer.writeBenchRepetition(c.id, r);
        }
}

TEST_F(BenchCommand, OnlySlowDownsBeyondChanceAndThresholdMakeItRed) {
    const std::string requested =
        "--engines double_free_flight:pause_us=1000 --least 8 --most 8 --clock wall -q";
    ASSERT_EQ(bench(requested + out("before")).code, 0);
    scaleTimes(folder_ / "before", 0.01);  // far beyond what load does to a sleep
    const std::string against = " --baseline " + (folder_ / "before").string();
    const auto slower = bench(requested + out("after") + against);
    EXPECT_EQ(slower.code, 1) << slower.out;
    EXPECT_THAT(slower.out, HasSubstr("slower"));
    EXPECT_THAT(slower.out, HasSubstr("p = "));
    EXPECT_TRUE(fs::exists(folder_ / "after/tables/bench_changes.csv"));
    const auto allowed = bench(requested + out("after") + against + " --resume --threshold 900");
    EXPECT_EQ(allowed.code, 0) << allowed.out;
    scaleTimes(folder_ / "before", 10000.0);
    const auto faster = bench(requested + out("after") + against + " --resume");
    EXPECT_EQ(faster.code, 0) << faster.out;
    EXPECT_THAT(faster.out, HasSubstr("faster"));
}

TEST_F(BenchCommand, AFinishedRunIsGoneOnWithForFree) {
    const std::string requested = "--engines double_free_flight --least 2 --most 2 -q" + out("run");
    ASSERT_EQ(bench(requested).code, 0);
    EXPECT_EQ(bench(requested).code, 2) << "the folder holds a run already";
    const auto again = bench(requested + " --resume --json", false);
    ASSERT_EQ(again.code, 0);
    EXPECT_EQ(json::parse(again.out).at("cases").at(0).at("repetitions").size(), 3u);
    const auto other = bench("--engines double_nan --least 2 --most 2 -q --resume" + out("run"));
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.out, HasSubstr("does not request"));
}

TEST_F(BenchCommand, WhoDiesMakesItRed) {
    const auto result =
        bench("--engines double_free_flight,double_segfault --least 1 --most 1 -q" + out("run"));
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.out, HasSubstr("crashed"));
}

TEST_F(BenchCommand, BadCommandLinesAreSaid) {
    const auto said = [&](const std::string& arguments, const std::string& words) {
        const auto result = bench(arguments + out("none"));
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_THAT(result.out, HasSubstr(words)) << arguments;
        EXPECT_FALSE(fs::exists(folder_ / "none/results.sqlite")) << arguments;
    };
    said("--engines no_engine", "no_engine");
    said("--engines double_free_flight:speed=9", "key 'speed'");
    said("--engines double_free_flight:pause_us=much", "pause_us");
    said("--engines double_free_flight --parts nothing", "expected one of all");
    said("--parts broad_phase --only nothing", "'3D, random order', '3D, spatial order', '2D, random order'");
    said("--parts broad_phase --only '3D, random order' --only nothing",
         "--only: found 'nothing', expected one of");
    said("--only '3D, random order'", "goes with --parts");
    said("--full", "--full: goes with --parts");
    said("--engines double_free_flight --baseline " + (folder_ / "gone").string(), "--baseline");
    said("--engines double_free_flight --width wide", "--width");
    said("--engines double_free_flight --clock sun", "--clock");
    said("--engines double_free_flight --threads 0", "--threads");
    said("--engines double_free_flight --size 3 --growth", "--growth");
    said("--engines double_free_flight --dt fast", "--dt");
}

}  // namespace
}  // namespace rigor::cli_test
