// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Histories of runs that differ on purpose: which cases are one line, and what the page, its table and its replays
// say of them.
#include "reports/page/case_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "reports/encoding/text.hpp"
#include "reports/page/history.hpp"
#include "reports/tests/synthetic_run.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::PairBy;
using Stored = results::Run;

/// The synthetic run with the cases that are accepted alone.
Stored runOf(const std::string& folder, const std::function<bool(const CaseRow&)>& isKept) {
    Stored run = synthetic::makeRun(2);
    run.directory = folder;
    std::erase_if(run.cases, [&](const CaseRow& c) { return !isKept(c); });
    return run;
}

/// The coarser or the finer of the two time steps of the synthetic scenarios.
Stored runAt(const std::string& folder, bool fine) {
    const Stored all = synthetic::makeRun(2);
    const double first = all.scenarios[0].timeSteps.front(), last = all.scenarios[0].timeSteps.back();
    const double dt = fine ? std::min(first, last) : std::max(first, last);
    return runOf(folder, [&](const CaseRow& c) { return c.dt == dt; });
}

std::string refusalOf(const std::vector<Stored>& runs, PairBy by) {
    try {
        (void)historiesOf(runs, by);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(CaseHistory, TimeStepsOfASpecAreOneLine) {
    const std::vector<Stored> runs{runAt("coarse", false), runAt("fine", true)};
    const auto histories = historiesOf(runs, PairBy::TimeStep);
    EXPECT_EQ(histories.size(), runs[0].cases.size());
    for (const CaseHistory& h : histories) {
        ASSERT_EQ(h.cases.size(), 2u);
        ASSERT_TRUE(h.cases[0] != nullptr && h.cases[1] != nullptr);
        EXPECT_EQ(h.cases[0]->spec, h.cases[1]->spec);
        EXPECT_GT(h.cases[0]->dt, h.cases[1]->dt);
        EXPECT_EQ(&h.newest(), h.cases[1]);
    }
    EXPECT_EQ(historiesOf(runs, PairBy::Nothing).size(), 2 * histories.size());
}

TEST(CaseHistory, EnginesOfAPresetAreOneLine) {
    const auto only = [](const char* engine) {
        return runOf(engine, [=](const CaseRow& c) {
            return c.engine == engine && c.spec.find(',') == std::string::npos;
        });
    };
    const std::vector<Stored> runs{only("bullet"), only("ode")};
    for (const CaseHistory& h : historiesOf(runs, PairBy::Engine)) {
        ASSERT_TRUE(h.cases[0] != nullptr && h.cases[1] != nullptr);
        EXPECT_EQ(h.cases[0]->preset, h.cases[1]->preset);
        EXPECT_EQ(h.cases[0]->dt, h.cases[1]->dt);
        EXPECT_EQ(h.cases[0]->engine + h.cases[1]->engine, "bulletode");
    }
}

/// A preset against the other one is a line; where a run has both, each is a line of its own.
TEST(CaseHistory, SpecsAreFollowedWithinAPresetWhereARunHasSeveral) {
    const auto ode = [](const char* folder, const std::string& preset) {
        return runOf(folder, [=](const CaseRow& c) {
            return c.engine == "ode" && c.spec.find(',') == std::string::npos &&
                   (preset.empty() || c.preset == preset);
        });
    };
    const std::vector<Stored> presets{ode("a", "default"), ode("b", "matched")};
    for (const CaseHistory& h : historiesOf(presets, PairBy::Spec))
        EXPECT_TRUE(h.cases[0] != nullptr && h.cases[1] != nullptr &&
                    h.cases[0]->preset != h.cases[1]->preset);
    std::vector<Stored> both{ode("a", ""), ode("b", "")};
    for (CaseRow& c : both[1].cases) c.spec += ",iterations=50";
    const auto histories = historiesOf(both, PairBy::Spec);
    EXPECT_EQ(histories.size(), both[0].cases.size());
    for (const CaseHistory& h : histories) EXPECT_EQ(h.cases[1]->spec, h.cases[0]->spec + ",iterations=50");
}

TEST(CaseHistory, SeveralCasesForALineAreRefusedWithWhatHelps) {
    Stored both = synthetic::makeRun(2);
    both.directory = "runs/both";
    const std::vector<Stored> runs{runAt("coarse", false), both};
    const std::string steps = refusalOf(runs, PairBy::TimeStep);
    const CaseRow& first = both.cases.front();
    EXPECT_NE(steps.find("several cases of " + first.scenario + " in both that differ in dt alone"),
              std::string::npos)
        << steps;
    EXPECT_NE(steps.find("\n  " + first.spec + " dt="), std::string::npos) << steps;
    EXPECT_NE(steps.find("rigor validate " + first.scenario + " --dt "), std::string::npos) << steps;
    EXPECT_NE(steps.find("rigor compare --pair dt runs/both"), std::string::npos) << steps;
    EXPECT_NE(refusalOf(runs, PairBy::Engine).find("--engines "), std::string::npos);
    EXPECT_NE(refusalOf(runs, PairBy::Spec).find("differ in spec alone"), std::string::npos)
        << "two specs of one preset";
    EXPECT_EQ(refusalOf(runs, PairBy::Nothing), "");
}

/// The page and the table say of each run which step it has, and the replays of both are beside the page.
TEST(CaseHistory, PageTableAndReplaysNameTheCaseOfEachRun) {
    const std::filesystem::path scratch =
        std::filesystem::path(testing::TempDir()) / "rigor-case-history-test";
    std::filesystem::remove_all(scratch);
    std::vector<Stored> runs{runAt((scratch / "coarse").string(), false),
                             runAt((scratch / "fine").string(), true)};
    for (const char* name : {"coarse", "fine"}) {
        std::filesystem::create_directories(scratch / name / "data");
        writeFile(scratch / name / "data/replay-0-0.js",
                  "rigorData(\"replay-0-0\",\"" + std::string(name) + "\");\n");
    }
    EXPECT_TRUE(historyReplays(runs, 2).files.empty()) << "no time step in common";
    const auto replays = historyReplays(runs, 2, PairBy::TimeStep);
    ASSERT_EQ(replays.files.size(), 2u);
    const std::string page = historyPage(runs, {""}, replays, PairBy::TimeStep);
    const auto from = page.find('{', page.find("id=\"history-data\">"));
    const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    EXPECT_EQ(data.at("pair"), "dt");
    EXPECT_EQ(data.at("runs")[0].at("steps")[0], runs[0].cases[0].dt);
    const auto& s = data.at("series")[0];
    EXPECT_EQ(s.at("cases")[0].at("dt"), runs[0].cases[0].dt);
    EXPECT_EQ(s.at("cases")[1].at("dt"), runs[1].cases[0].dt);
    EXPECT_EQ(s.at("replay")[0], "run-0-replay-0-0");
    EXPECT_EQ(s.at("replay")[1], "run-1-replay-0-0");
    std::istringstream lines(historyCsv(runs, PairBy::TimeStep));
    std::string head, one, other;
    std::getline(lines, head);
    std::getline(lines, one);
    std::getline(lines, other);
    EXPECT_TRUE(head.ends_with(",series")) << head;
    EXPECT_TRUE(one.starts_with("coarse,") && one.ends_with(",1")) << one;
    EXPECT_TRUE(other.starts_with("fine,") && other.ends_with(",1")) << other;
    std::filesystem::remove_all(scratch);
}

}  // namespace
}  // namespace rigor::report
