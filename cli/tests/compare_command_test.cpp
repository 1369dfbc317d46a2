// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor compare`, `rigor record` and `validate --baseline` as a user calls them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using rigor::cli_test::rigor;

class CompareCommand : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder_);
        const auto run = rigor(validate("a", "rigor"));
        ASSERT_EQ(run.code, 0) << run.out;
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string validate(const std::string& out, const std::string& engine) const {
        return "validate bouncing_ball slide_and_stop --no-audit -q --dt 1/60 --engines " + engine +
               " --out " + path(out);
    }
    fs::path folder_ = fs::path(testing::TempDir()) / "compare-command";
};

TEST_F(CompareCommand, TheSameRunTwiceIsTheSame) {
    EXPECT_EQ(rigor(validate("b", "rigor")).code, 0);
    const auto text = rigor("compare " + path("a") + " " + path("b"));
    EXPECT_EQ(text.code, 0) << text.out;
    EXPECT_NE(text.out.find("No verdict and no error changed"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("1 and 1 run(s)"), std::string::npos);
    const json out =
        json::parse(rigor("compare --json " + path("a") + " " + path("b") + "," + path("a"), false).out);
    EXPECT_FALSE(out.at("worse"));
    EXPECT_EQ(out.at("specs").size(), 4u);  // default, matched, accurate, fast
    EXPECT_GT(out.at("specs")[0].at("same"), 5);
}

TEST_F(CompareCommand, TheHistoryOfRunsIsAPageAndATable) {
    EXPECT_EQ(rigor(validate("b", "rigor")).code, 0);
    const auto one = rigor("history " + path("a") + " --out " + path("page"));
    EXPECT_EQ(one.code, 2);
    EXPECT_NE(one.out.find("expected two or more"), std::string::npos) << one.out;
    const auto two = rigor("history " + path("a") + " " + path("b") + " --out " + path("page"));
    EXPECT_EQ(two.code, 0) << two.out;
    std::ifstream table(path("page/history.csv"));
    std::string head;
    std::getline(table, head);
    EXPECT_TRUE(head.starts_with("run,started,scenario,spec,")) << head;
    std::ifstream page(path("page/index.html"));
    const std::string text((std::istreambuf_iterator<char>(page)), {});
    EXPECT_NE(text.find("\"time_ratio\""), std::string::npos) << "the comparison of the two is in the page";
}

/// Runs with other steps have no case in common: the command says what shows them, and that does.
TEST_F(CompareCommand, TheHistoryOfRunsThatDifferOnPurpose) {
    const std::string finer =
        "validate bouncing_ball slide_and_stop --no-audit -q --dt 1/120 --engines rigor --out ";
    ASSERT_EQ(rigor(finer + path("b")).code, 0);
    const std::string runs = path("a") + " " + path("b") + " --out " + path("page");
    const auto plain = rigor("history " + runs);
    EXPECT_EQ(plain.code, 0) << plain.out;
    EXPECT_NE(plain.out.find("rigor history RUN RUN --pair"), std::string::npos) << plain.out;
    const auto steps = rigor("history --pair dt " + runs);
    EXPECT_EQ(steps.code, 0) << steps.out;
    std::ifstream page(path("page/index.html"));
    const std::string text((std::istreambuf_iterator<char>(page)), {});
    EXPECT_NE(text.find("\"pair\":\"dt\""), std::string::npos);
    EXPECT_NE(text.find("\"dt_after\""), std::string::npos) << "the comparison of the two is in the page";
    const auto engines = rigor("history --pair engine " + runs);
    EXPECT_EQ(engines.code, 2) << engines.out;
    EXPECT_NE(engines.out.find("differ in engine alone"), std::string::npos) << engines.out;
    const auto presets =
        rigor("history --pair spec " + path("a") + " " + path("a") + " --out " + path("page"));
    EXPECT_EQ(presets.code, 2) << presets.out;
    EXPECT_NE(presets.out.find("twice, expected folders of different runs; `rigor compare --pair`"),
              std::string::npos)
        << presets.out;
    EXPECT_EQ(rigor("history --pair colour " + runs).code, 2);
}

/// A record that says half or twice of what the run gives.
TEST_F(CompareCommand, AChangeInEitherDirectionIsSeenAgainstTheRecord) {
    ASSERT_EQ(rigor("record " + path("a") + " --out " + path("library/recorded")).code, 0);
    const fs::path library = fs::path(RIGOR_SOURCE_DIR) / "scenarios/library";
    for (const auto& entry : fs::directory_iterator(library))
        if (entry.path().filename() != "recorded")
            fs::create_symlink(entry.path(), folder_ / "library" / entry.path().filename());
    const std::string environment = "RIGOR_SCENARIOS=" + path("library");
    const auto same = rigor("compare recorded " + path("a"), true, environment);
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_NE(same.out.find("No verdict and no error changed"), std::string::npos) << same.out;

    fs::path file;
    for (const auto& entry : fs::directory_iterator(folder_ / "library/recorded")) file = entry.path();
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto at = text.rfind(';', text.find("position_final") + 20);
    const auto end = text.find('\n', at);
    const double value = std::stod(text.substr(at + 1, end - at - 1));
    const auto recordValue = [&](double recorded) {
        std::ofstream(file) << text.substr(0, at + 1) << recorded << text.substr(end);
        return rigor("compare recorded " + path("a"), true, environment);
    };
    const auto worse = recordValue(0.5 * value), better = recordValue(2.0 * value);
    EXPECT_EQ(worse.code, 1) << worse.out;
    EXPECT_NE(worse.out.find("worse   slide_and_stop"), std::string::npos) << worse.out;
    EXPECT_EQ(better.code, 0) << better.out;
    EXPECT_NE(better.out.find("better  slide_and_stop"), std::string::npos) << better.out;
}

TEST_F(CompareCommand, ValidateAgainstABaseline) {
    const auto same = rigor(validate("b", "rigor") + " --baseline " + path("a"));
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_NE(same.out.find("No verdict and no error changed"), std::string::npos) << same.out;
    const auto missing = rigor(validate("c", "rigor") + " --baseline " + path("nowhere"));
    EXPECT_EQ(missing.code, 2);
    EXPECT_FALSE(fs::exists(folder_ / "c")) << "said before anything runs";
}

/// Two runs without a common case say what each has; deliberate differences are compared on request.
TEST_F(CompareCommand, NothingInCommonIsAnErrorAndPairsAreCompared) {
    ASSERT_EQ(rigor(validate("ode", "ode")).code, 0);
    const auto nothing = rigor("compare " + path("a") + " " + path("ode"));
    EXPECT_EQ(nothing.code, 2) << nothing.out;
    EXPECT_NE(nothing.out.find("engines: ode:preset=default, ode:preset=matched; dt: 0.0166667"),
              std::string::npos)
        << nothing.out;
    const auto engines = rigor("compare --pair engine " + path("a") + " " + path("ode"));
    EXPECT_EQ(engines.code, 0) << engines.out;
    EXPECT_NE(engines.out.find("rigor:preset=default -> ode:preset=default"), std::string::npos)
        << engines.out;
    const json presets = json::parse(rigor("compare --json --pair spec " + path("a"), false).out);
    ASSERT_EQ(presets.at("specs").size(), 6u) << "of default, matched, accurate and fast every two";
    EXPECT_EQ(presets.at("specs")[0].at("cases"), 2);
    EXPECT_EQ(rigor("compare --pair dt " + path("a")).code, 2) << "one step alone";
    EXPECT_EQ(rigor("compare --pair colour " + path("a")).code, 2);
    EXPECT_EQ(rigor("compare --pair engine recorded " + path("a")).code, 2);
}

TEST_F(CompareCommand, OneFolderTwiceIsNoHistoryAndTheRecordGoesFirst) {
    const auto twice = rigor("history " + path("a") + " " + path("a") + " --out " + path("page"));
    EXPECT_EQ(twice.code, 2) << twice.out;
    EXPECT_NE(twice.out.find("found " + path("a") + " twice, expected folders of different runs"),
              std::string::npos)
        << twice.out;
    const auto after = rigor("compare " + path("a") + " recorded");
    EXPECT_EQ(after.code, 2);
    EXPECT_NE(after.out.find("expected it as BEFORE: compare recorded " + path("a")), std::string::npos)
        << after.out;
}

TEST_F(CompareCommand, WhatIsNoRunIsSaid) {
    const auto none = rigor("compare " + path("nowhere") + " " + path("a"));
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.out.find("nowhere"), std::string::npos);
    EXPECT_EQ(rigor("compare " + path("a")).code, 2);
}

}  // namespace
