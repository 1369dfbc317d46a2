// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor study` from the user's side: a file of one's own, the run folder, resuming, exit codes, messages.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"
#include "cli/tests/shared_study.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using rigor::cli_test::kSharedStudy;
using rigor::cli_test::rigor;
using rigor::cli_test::timeless;

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

/// An empty folder with the study of that text.
fs::path folderWithStudy(const std::string& name, const char* text) {
    const auto folder = fs::path(testing::TempDir()) / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "shared.json") << text;
    return folder;
}

TEST(StudyCommand, ShardsGiveTheTablesOfTheWholeStudy) {
    const auto folder = folderWithStudy("study-shards", kSharedStudy);
    const auto study = (folder / "shared.json").string();
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
    const auto lacking =
        rigor("merge" + shards.substr(0, shards.rfind(' ')) + " --out " + (folder / "lacking").string());
    EXPECT_EQ(lacking.code, 2) << lacking.out;
    EXPECT_NE(lacking.out.find("missing or unfinished shards of 3: 3"), std::string::npos) << lacking.out;
    EXPECT_FALSE(fs::exists(folder / "lacking"));
    const auto merged = (folder / "merged").string();
    EXPECT_EQ(rigor("merge" + shards + " --out " + merged).code, 0);
    const auto tables = rigor("study " + study + " --json --resume -q --out " + merged, false);
    EXPECT_EQ(tables.code, whole.code);
    EXPECT_EQ(timeless(tables.out), timeless(whole.out));
    EXPECT_TRUE(fs::exists(folder / "merged/study.md"));
    EXPECT_EQ(rigor("study " + study + " --shard 4/3" + out("none")).code, 2);
    EXPECT_FALSE(fs::exists(folder / "none"));
}

/// The scripts of `rigor sweep` without a scheduler, from a folder that the study's path begins at.
TEST(StudyCommand, ASweepGivesTheTablesOfTheWholeStudy) {
    const auto folder = folderWithStudy("study-sweep", kSharedStudy);
    const auto whole = rigor(
        "study " + (folder / "shared.json").string() + " --json -q --out " + (folder / "whole").string(),
        false);
    const auto in = [&](const std::string& command) {
        return std::system(("cd " + folder.string() + " && RIGOR_LOCAL=" + folder.string() + " " + command +
                            " > out.txt 2>&1")
                               .c_str());
    };
    const std::string begin = "sweep --shards 3 --out " + (folder / "sweep").string();
    ASSERT_EQ(rigor(begin + " --study shared.json --audit").code, 0);
    for (const char* shard : {"1", "2"}) EXPECT_EQ(in(std::string("sh sweep/shard.sh ") + shard), 0) << shard;
    EXPECT_NE(in("sh sweep/merge.sh"), 0) << "a shard is missing";
    EXPECT_FALSE(fs::exists(folder / "sweep/run/study.json"));
    EXPECT_EQ(in("sh sweep/shard.sh 3"), 0);
    EXPECT_EQ(WEXITSTATUS(in("sh sweep/merge.sh")), whole.code);
    std::ifstream tables(folder / "sweep/run/study.json");
    const std::string text((std::istreambuf_iterator<char>(tables)), {});
    EXPECT_EQ(timeless(text), timeless(whole.out));
    EXPECT_EQ(rigor("sweep --shards 3 --study --out " + (folder / "none").string()).code, 2) << "no study";
    EXPECT_FALSE(fs::exists(folder / "none"));
}

/// A shard with two jobs takes two cores.
TEST(StudyCommand, ParallelShardsTakeAllCoresTogether) {
    for (const auto& [jobs, share] :
         {std::pair{"", "100%"}, {" -j 2", "50%"}, {" -j4", "25%"}, {" --jobs=8", "12%"}}) {
        const auto folder = fs::path(testing::TempDir()) / "study-shares";
        fs::remove_all(folder);
        const auto sweep = rigor("sweep --shards 8 --out " + folder.string() + " smoke" + jobs);
        EXPECT_NE(sweep.out.find(std::string("parallel -j ") + share + " "), std::string::npos) << sweep.out;
    }
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
