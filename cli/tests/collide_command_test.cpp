// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor collide` from the user's side: verdicts, exit codes, files, messages.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"

namespace {

using nlohmann::json;
using rigor::cli_test::rigor;

std::filesystem::path written(const char* name, const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(file) << text;
    return file;
}

json collideJson(const std::string& arguments, int code = 0) {
    const auto result = rigor("collide --json " + arguments, false);
    EXPECT_EQ(result.code, code) << arguments << "\n" << result.out.substr(0, 2000);
    return json::parse(result.out);
}

/// The results of the files follow by hand: the in-house engine gives them, and so does the oracle.
TEST(CollideCommand, InHouseEngineIsRightOnTheSuite) {
    const json out = collideJson("--suite --engines rigor");
    EXPECT_EQ(out.at("green"), true);
    ASSERT_GE(out.at("cases").size(), 20u);
    for (const json& c : out.at("cases")) {
        EXPECT_EQ(c.at("truth").at("source"), "oracle") << c.at("name");
        EXPECT_FALSE(c.at("truth").contains("conflict")) << c.at("name");
        const json& right = c.contains("expected") ? c.at("expected") : c.at("truth");
        const double expected = right.at("signed_distance");
        const json& found = c.at("answers").at(0).at("signed_distance");
        // values are missing: not every algorithm measures gaps
        if (expected > 0.0 && found.is_null()) continue;
        EXPECT_NEAR(found.get<double>(), expected, 1e-9 + 1e-6 * std::abs(expected)) << c.at("name");
    }
}

TEST(CollideCommand, EveryInstalledEngineAnswers) {
    const json out = collideJson("--suite");
    std::map<std::string, int> answered;
    for (const json& s : out.at("summary"))
        answered[s.at("name").get<std::string>().substr(0, s.at("name").get<std::string>().find(':'))] +=
            s.at("answered").get<int>();
    for (const char* engine : {"box2d", "bullet", "fcl", "ode", "rigor"})
        EXPECT_GT(answered[engine], 3) << engine;
}

TEST(CollideCommand, WritesItsFiles) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "collide-out";
    std::filesystem::remove_all(folder);
    const auto result = rigor("collide analytic --engines rigor,fcl --out " + folder.string());
    EXPECT_EQ(result.code, 0) << result.out;
    std::ifstream in(folder / "collide.csv");
    std::string line;
    int lines = 0;
    while (std::getline(in, line)) ++lines;
    const json stored = json::parse(std::ifstream(folder / "collide.json"));
    EXPECT_EQ(lines, 1 + 2 * static_cast<int>(stored.at("cases").size()));
    EXPECT_TRUE(std::filesystem::exists(folder / "summary.md"));
}

/// A file whose own value is wrong makes the run red, and says which case.
TEST(CollideCommand, AWrongExpectationIsRed) {
    const auto file = written(
        "wrong.json",
        R"({"rigor_collision": 1, "name": "wrong", "cases": [{"name": "false_file", "a": {"sphere": {"radius": 1}},
            "b": {"sphere": {"radius": 1}, "position": [1.5, 0, 0]}, "expected": {"signed_distance": -0.4}}]})");
    const auto result = rigor("collide " + file.string() + " --engines rigor");
    EXPECT_EQ(result.code, 1);
    EXPECT_NE(result.out.find("false_file"), std::string::npos) << result.out;
}

/// Random pairs: the same for the same seed and from the file they were saved in; judged by the oracle alone.
TEST(CollideCommand, RandomPairs) {
    const auto file = std::filesystem::path(testing::TempDir()) / "random.json";
    const std::string request = "--random 33 --seed 4 --engines rigor";
    const json made = collideJson(request + " --save " + file.string());
    const json again = collideJson(request), read = collideJson(file.string() + " --engines rigor"),
               other = collideJson("--random 33 --seed 5 --engines rigor");
    ASSERT_EQ(made.at("cases").size(), 33u);
    EXPECT_EQ(made.at("kinds").size(), 11u);
    for (std::size_t i = 0; i < 33; ++i) {
        const json &c = made.at("cases").at(i), &truth = c.at("truth");
        EXPECT_EQ(truth.at("source"), "oracle");
        EXPECT_EQ(c.at("answers").at(0).at("verdict"), "ok") << c;
        EXPECT_EQ(again.at("cases").at(i).at("truth"), truth);
        EXPECT_EQ(read.at("cases").at(i).at("truth"), truth);
        EXPECT_NE(other.at("cases").at(i).at("truth"), truth);
    }
    const json deep = collideJson("--random 8 --dimension 2 --kinds deep --pairs box-circle --engines rigor");
    for (const json& c : deep.at("cases")) EXPECT_EQ(c.at("tags"), json({"deep", "box", "circle"}));
    EXPECT_EQ(rigor("collide analytic --seed 3").code, 2) << "a seed of nothing";
    const auto odd = rigor("collide --random 3 --kinds odd");
    EXPECT_EQ(odd.code, 2);
    EXPECT_NE(odd.out.find("'odd', expected one of generic"), std::string::npos) << odd.out;
}

/// Single precision is another spec: coarser, measured by the same oracle, and it does not make a run red.
TEST(CollideCommand, SinglePrecisionIsASpec) {
    const json run = collideJson("--random 60 --kinds generic,deep --engines rigor,rigor:precision=f32");
    const json &twice = run.at("summary").at(0), &once = run.at("summary").at(1);
    EXPECT_EQ(once.at("answered"), 60);
    EXPECT_LT(twice.at("depth_error_max").get<double>(), 1e-9);
    EXPECT_GT(once.at("depth_error_max").get<double>(), 1e-9);
    EXPECT_LT(once.at("depth_error_max").get<double>(), 1e-4);
}

TEST(CollideCommand, BadInputIsSaid) {
    EXPECT_EQ(rigor("collide").code, 2);
    EXPECT_EQ(rigor("collide no_such_file --engines rigor").code, 2);
    EXPECT_EQ(rigor("collide analytic --engines no_engine").code, 2);
    const auto key = rigor("collide analytic --engines rigor:narrow_phase=magic");
    EXPECT_EQ(key.code, 2) << key.out;
    EXPECT_NE(key.out.find("narrow_phase"), std::string::npos) << key.out;
    const auto bad = written("bad.jsonl", "{\"a\": 1}\n{\"a\": {}}\n");
    const auto result = rigor("collide " + bad.string() + " --engines rigor");
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.out.find("bad.jsonl:1: "), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("expected"), std::string::npos) << result.out;
}

/// Published and generated queries with known results, if they are installed.
TEST(CollideCommand, GeneratedPolytopePairs) {
    const char* data = std::getenv("RIGOR_DATA");
    const auto file =
        std::filesystem::path(data != nullptr ? data : "") / "collision-cases" / "generated.jsonl";
    if (data == nullptr || !std::filesystem::exists(file)) GTEST_SKIP() << "no collision-cases in RIGOR_DATA";
    const json out = collideJson(file.string() + " --engines rigor");
    EXPECT_EQ(out.at("summary").at(0).at("answered"), 400);
    EXPECT_EQ(out.at("summary").at(0).at("missed"), 0);
    EXPECT_EQ(out.at("summary").at(0).at("spurious"), 0);
}

}  // namespace
