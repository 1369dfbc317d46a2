// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor study` from the user's side: a file of one's own, the run folder, resuming, exit codes, messages.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using rigor::cli_test::rigor;

fs::path writeStudy(const std::string& cureAtMost) {
    const auto file = fs::path(testing::TempDir()) / "my_study.json";
    std::ofstream(file) << R"({"rigor_study": 1, "name": "mine", "parts": [
        {"name": "slide", "scenarios": ["slide_and_stop"], "parameters": {"bodies.block.mass": [1, 4]},
         "dt": [0.01], "metrics": ["position_final", "mean_contacts", "time.step"],
         "variants": [{"name": "without", "engine": "rigor:position_correction=none"}, "rigor"],
         "symptom": {"fault": "without", "cure": "rigor", "metric": "position_final", "fault_at_least": 1000,
                     "cure_at_most": )"
                        << cureAtMost << "}}]}";
    return file;
}

TEST(StudyCommand, RunsAFileAndKeepsAFolder) {
    const auto study = writeStudy("1").string();
    const auto run = (fs::path(testing::TempDir()) / "study-run").string();
    fs::remove_all(run);
    const auto first = rigor("study " + study + " -q --json --out " + run, false);
    EXPECT_EQ(first.code, 1) << "the symptom is not shown: an error of a kilometre would be";
    const json out = json::parse(first.out);
    const json& rows = out.at("parts").at(0).at("rows");
    ASSERT_EQ(rows.size(), 4u);
    for (const json& row : rows) {
        EXPECT_EQ(row.at("outcome"), "completed");
        EXPECT_GE(row.at("metrics").at("position_final").at("value").get<double>(), 0.0);
        EXPECT_GT(row.at("metrics").at("mean_contacts").at("value").get<double>(), 0.0);
        EXPECT_GT(row.at("metrics").at("time.step").at("value").get<double>(), 0.0);
    }
    EXPECT_EQ(out.at("symptoms").at(0).at("shown"), false);
    EXPECT_EQ(out.at("symptoms").at(0).at("cured"), true);
    EXPECT_EQ(out.at("symptoms").at(0).at("switched").size(), 1u);
    for (const char* file : {"study.csv", "study.md", "study.json", "index.html", "results.sqlite"})
        EXPECT_TRUE(fs::exists(fs::path(run) / file)) << file;
    EXPECT_EQ(rigor("report " + run).code, 0) << "a run folder like any other";
    EXPECT_EQ(rigor("study " + study + " -q --out " + run).code, 2) << "holds a run already";
    const auto again = rigor("study " + study + " -q --json --resume --out " + run, false);
    EXPECT_EQ(json::parse(again.out).at("parts"), out.at("parts")) << "nothing is run a second time";
}

/// Tables without what differs from run to run.
json timeless(const std::string& text) {
    json parts = json::parse(text).at("parts");
    for (json& part : parts)
        for (json& row : part.at("rows")) row.at("metrics").erase("time.step");
    return parts;
}

TEST(StudyCommand, ShardsGiveTheTablesOfTheWholeStudy) {
    const auto study = (fs::path(testing::TempDir()) / "shared_study.json").string();
    std::ofstream(study) << R"({"rigor_study": 1, "name": "shared", "parts": [
        {"name": "masses", "scenarios": ["slide_and_stop", "free_flight"], "dt": [0.01],
         "metrics": ["position_final", "time.step"], "variants": ["rigor", "ode:preset=matched"],
         "symmetries": ["mirror", "time_reversal"]}]})";
    const auto folder = fs::path(testing::TempDir()) / "study-shards";
    fs::remove_all(folder);
    const auto out = [&](const std::string& name) { return " -q --out " + (folder / name).string(); };
    const auto whole = rigor("study " + study + " --json" + out("whole"), false);
    ASSERT_EQ(timeless(whole.out).at(0).at("rows").size(), 4u);
    std::string shards;
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        const std::string name = std::string("shard") + shard[0];
        const auto run = rigor("study " + study + " --shard " + shard + out(name));
        EXPECT_EQ(run.code, 0) << run.out;
        EXPECT_FALSE(fs::exists(folder / name / "study.json"));
        shards += " " + (folder / name).string();
    }
    const auto merged = (folder / "merged").string();
    EXPECT_EQ(rigor("merge" + shards + " --out " + merged).code, 0);
    const auto tables = rigor("study " + study + " --json --resume -q --out " + merged, false);
    EXPECT_EQ(tables.code, whole.code);
    EXPECT_EQ(timeless(tables.out), timeless(whole.out));
    EXPECT_TRUE(fs::exists(folder / "merged/study.md"));
    EXPECT_EQ(rigor("study " + study + " --shard 4/3" + out("none")).code, 2);
    EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(StudyCommand, BadInputIsSaid) {
    const auto symptom = rigor("study " + writeStudy("2000").string());
    EXPECT_EQ(symptom.code, 2);
    EXPECT_NE(symptom.out.find("my_study.json:"), std::string::npos) << symptom.out;
    EXPECT_NE(symptom.out.find("/parts/0/symptom"), std::string::npos) << symptom.out;
    EXPECT_EQ(rigor("study no_such_study").code, 2);
    EXPECT_EQ(rigor("study iterations --part nothing").code, 2);
}

}  // namespace
