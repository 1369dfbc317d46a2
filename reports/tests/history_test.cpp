// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The history of several runs: a value for each run, in the order of the runs, with gaps where a run does not
// have a case.
#include "reports/page/history.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/encoding/text.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;

results::Run runNamed(const std::string& folder) {
    results::Run run = synthetic::makeRun(2);
    run.directory = folder;
    return run;
}

nlohmann::json dataOf(const std::string& page) {
    const std::string mark = "id=\"history-data\">";
    const auto from = page.find(mark) + mark.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

const nlohmann::json& seriesOf(const nlohmann::json& data, const CaseRow& c) {
    for (const auto& s : data.at("series"))
        if (s.at("scenario") == c.scenario && s.at("spec") == c.spec && s.at("dt") == c.dt) return s;
    throw std::runtime_error("no series of " + c.id);
}

/// A case that completed and has its main metric and a time.
std::size_t completed(const results::Run& run) {
    for (std::size_t i = 0; i < run.cases.size(); ++i)
        if (run.cases[i].outcome == results::Outcome::Completed && !run.cases[i].timings.empty() &&
            !run.cases[i].metrics.empty())
            return i;
    throw std::runtime_error("no case completed");
}

struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / "rigor-history-test";
    Folder() { std::filesystem::remove_all(path); }
    ~Folder() { std::filesystem::remove_all(path); }
};

std::string textOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(History, EachRunHasItsValueAndAGapWhereItDoesNotHaveTheCase) {
    std::vector<results::Run> runs{runNamed("runs/first"), runNamed("runs/second/"), runNamed("third")};
    const std::size_t at = completed(runs[0]);
    for (auto& t : runs[2].cases[at].timings) t.median *= 3.0;
    for (auto& m : runs[2].cases[at].metrics) m.value *= 2.0;
    const CaseRow sample = runs[0].cases[at];
    runs[1].cases.erase(runs[1].cases.begin() + static_cast<std::ptrdiff_t>(at));
    const auto data = dataOf(historyPage(runs, {"", R"({"worse":true})"}));
    ASSERT_EQ(data.at("runs").size(), 3u);
    EXPECT_EQ(data.at("runs")[0].at("name"), "first");
    EXPECT_EQ(data.at("runs")[1].at("name"), "second");
    EXPECT_EQ(data.at("runs")[2].at("name"), "third");
    EXPECT_TRUE(data.at("changes")[0].is_null());
    EXPECT_TRUE(data.at("changes")[1].at("worse"));
    const auto& s = seriesOf(data, sample);
    ASSERT_EQ(s.at("error").size(), 3u);
    EXPECT_TRUE(s.at("error")[1].is_null());
    EXPECT_TRUE(s.at("time")[1].is_null());
    EXPECT_EQ(s.at("outcome")[1], "");
    EXPECT_EQ(s.at("outcome")[0], "completed");
    EXPECT_DOUBLE_EQ(s.at("error")[2].get<double>(), 2.0 * s.at("error")[0].get<double>());
    EXPECT_DOUBLE_EQ(s.at("time")[2].get<double>(), 3.0 * s.at("time")[0].get<double>());
}

TEST(History, TheTableHasARowForEachCaseOfEachRun) {
    const std::vector<results::Run> runs{runNamed("first"), runNamed("second")};
    std::istringstream lines(historyCsv(runs));
    std::string head, line;
    std::getline(lines, head);
    EXPECT_TRUE(head.starts_with("run,started,scenario,spec,dt,"));
    std::size_t first = 0, second = 0;
    while (std::getline(lines, line)) {
        first += line.starts_with("first,") ? 1 : 0;
        second += line.starts_with("second,") ? 1 : 0;
    }
    EXPECT_EQ(first, runs[0].cases.size());
    EXPECT_EQ(second, runs[1].cases.size());
}

/// Replays that two of the newest runs have are copied under names of their own, and named by their series.
TEST(History, ReplaysOfTheNewestRunsAreBesideThePage) {
    const Folder scratch;
    std::vector<results::Run> runs;
    for (const char* name : {"oldest", "older", "newest"}) {
        runs.push_back(runNamed((scratch.path / name).string()));
        std::filesystem::create_directories(scratch.path / name / "data");
        writeFile(scratch.path / name / "data" / "replay-0-0.js",
                  "rigorData(\"replay-0-0\",\"" + std::string(name) + "\");\n");
    }
    writeFile(scratch.path / "newest/data/replay-1-0.js", "rigorData(\"replay-1-0\",\"alone\");\n");
    const auto replays = historyReplays(runs, 2);
    ASSERT_EQ(replays.files.size(), 2u) << "one that a single run has is left out";
    writeHistoryReplays(replays, scratch.path / "page");
    EXPECT_EQ(textOf(scratch.path / "page" / "run-1-replay-0-0.js"),
              "rigorData(\"run-1-replay-0-0\",\"older\");\n");
    EXPECT_EQ(textOf(scratch.path / "page" / "run-2-replay-0-0.js"),
              "rigorData(\"run-2-replay-0-0\",\"newest\");\n");
    EXPECT_TRUE(std::filesystem::exists(scratch.path / "page" / "scene-0.js"));
    const auto data = dataOf(historyPage(runs, {"", ""}, replays));
    std::size_t named = 0;
    for (const auto& s : data.at("series")) {
        EXPECT_TRUE(s.at("replay")[0].is_null());
        if (s.at("scene").is_null()) continue;
        EXPECT_EQ(s.at("scenario"), runs[0].scenarios[0].name);
        named += s.at("replay")[2] == "run-2-replay-0-0" ? 1 : 0;
    }
    EXPECT_GT(named, 0u);
    EXPECT_TRUE(historyReplays(runs, 0).files.empty());
}

/// Frames that are the same in two runs are copied once, and both runs name that copy.
TEST(History, RunsWithTheSameFramesShareAFile) {
    const Folder scratch;
    std::vector<results::Run> runs;
    for (const char* name : {"before", "same", "changed"}) {
        runs.push_back(runNamed((scratch.path / name).string()));
        std::filesystem::create_directories(scratch.path / name / "data");
        const std::string frames = std::string(name) == "changed" ? "others" : "frames";
        writeFile(scratch.path / name / "data/replay-0-0.js",
                  "rigorData(\"replay-0-0\",\"" + frames + "\");\n");
    }
    const auto replays = historyReplays(runs, 3);
    std::vector<std::string> files, names;
    for (const auto& file : replays.files) files.push_back(file.name);
    for (const auto& [key, name] : replays.names) names.push_back(name);
    EXPECT_EQ(files, (std::vector<std::string>{"run-0-replay-0-0", "run-2-replay-0-0"}));
    EXPECT_EQ(names, (std::vector<std::string>{"run-0-replay-0-0", "run-0-replay-0-0", "run-2-replay-0-0"}));
    writeHistoryReplays(replays, scratch.path / "page");
    EXPECT_FALSE(std::filesystem::exists(scratch.path / "page/run-1-replay-0-0.js"));
}

TEST(History, NoNameIsMarkup) {
    const std::vector<results::Run> runs{runNamed("first"), runNamed("second")};
    EXPECT_EQ(historyPage(runs, {""}).find("<img src=x"), std::string::npos);
}

}  // namespace
}  // namespace rigor::report
