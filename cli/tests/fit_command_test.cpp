// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor import` and `rigor fit` from the user's side: a folder of recordings, the scenarios made of it, a
// suite of one's own for `validate`, the folder of a fit, resuming, exit codes, messages.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"
#include "validation/import/tests/toss_folder.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using rigor::cli_test::rigor;
using rigor::validation::testing::Flight;
using rigor::validation::testing::freshFolder;
using rigor::validation::testing::tossText;
using rigor::validation::testing::writeText;
using testing::HasSubstr;

/// Cubes that fly, and from frame 22 on sit where they are.
fs::path recordings(const std::string& name, int count) {
    const fs::path folder = freshFolder(name) / "data";
    for (int k = 0; k < count; ++k) {
        Flight flight;
        flight.p0.x = 0.1 * k;
        flight.p0.z = 0.15 + 0.002 * k;
        auto lines = flight.lines(40);
        for (std::size_t i = 22; i < lines.size(); ++i) lines[i] = lines[21];
        writeText(folder / ("toss_" + std::to_string(k) + ".csv"), tossText(lines));
    }
    return folder;
}

TEST(ImportCommand, MakesScenariosThatRun) {
    const fs::path data = recordings("command-import", 4), out = freshFolder("command-import-out") / "mine";
    const auto import =
        rigor("import cube-toss " + data.string() + " --option start=flight --out " + out.string());
    ASSERT_EQ(import.code, 0) << import.out;
    EXPECT_THAT(import.out, HasSubstr("4 scenarios"));
    EXPECT_EQ(rigor("check " + (out / "toss_000.json").string()).code, 0);
    const auto run = rigor("validate " + (out / "test.json").string() +
                               " --engines rigor:preset=default,ode:preset=default " +
                               "--no-audit -q --json --out " + (out / "run").string(),
                           false);
    ASSERT_EQ(run.code, 0);
    int measured = 0;
    const json result = json::parse(run.out);
    ASSERT_EQ(result.at("cases").size(), 4U) << "two scenarios, two engines";
    for (const json& c : result.at("cases"))
        for (const json& m : c.at("metrics")) {
            EXPECT_NE(m.at("kind"), "exact") << m;
            measured += m.at("name") == "measured_loss" && m.at("subject") == "";
        }
    EXPECT_EQ(measured, 4);
}

TEST(ImportCommand, BadInputIsSaid) {
    const fs::path data = recordings("command-bad", 2), out = freshFolder("command-bad-out");
    const auto refused = [&](const std::string& arguments) {
        const auto result = rigor("import " + arguments + " --out " + (out / "new").string());
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_FALSE(fs::exists(out / "new")) << "nothing half-written";
        return result.out;
    };
    EXPECT_THAT(refused("teapot " + data.string()),
                HasSubstr("known: compound-pendulum, cube-push, cube-toss"));
    EXPECT_THAT(refused("cube-toss nowhere"),
                HasSubstr("found nothing, expected the folder of the data set, cube-toss"));
    EXPECT_THAT(refused("cube-toss " + data.string() + " --option units=inches"),
                HasSubstr("expected one of data"));
    EXPECT_THAT(refused("cube-toss " + data.string() + " --train 7"), HasSubstr("a share between 0 and 1"));
    writeText(data / "toss_1.csv", "t,px\n0,0\n");
    EXPECT_THAT(refused("cube-toss " + data.string()),
                HasSubstr("toss_1.csv:1: (document): found the columns t, px"));
}

TEST(FitCommand, RunsResumesAndKeepsAFolder) {
    const fs::path data = recordings("command-fit", 4), in = freshFolder("command-fit-in") / "mine";
    ASSERT_EQ(rigor("import cube-toss " + data.string() + " --out " + in.string()).code, 0);
    const std::string out = (freshFolder("command-fit-out") / "fit").string();
    const std::string fit =
        "fit " + (in / "fit.json").string() + " --engines rigor:preset=default --budget 12 -j 2 -q --json";
    const auto first = rigor(fit + " --out " + out, false);
    ASSERT_EQ(first.code, 0);
    const json result = json::parse(first.out);
    const json& engine = result.at("engines").at(0);
    EXPECT_LE(engine.at("evaluations"), 12);
    EXPECT_EQ(engine.at("parameters").at(0).at("name"), "friction");
    EXPECT_EQ(result.at("baselines").size(), 3U);
    for (const char* file : {"fit.md", "fit.csv", "fit.json", "evaluations.jsonl"})
        EXPECT_TRUE(fs::exists(fs::path(out) / file)) << file;
    EXPECT_TRUE(fs::exists(fs::path(out) / engine.at("run").get<std::string>() / "index.html"));
    EXPECT_THAT(rigor(fit + " --out " + out).out, HasSubstr("holds a fit already"));
    const auto again = rigor(fit + " --resume --out " + out, false);
    ASSERT_EQ(again.code, 0);
    json resumed = json::parse(again.out), whole = result;
    resumed.erase("command");
    whole.erase("command");
    EXPECT_EQ(resumed, whole);
    EXPECT_EQ(rigor("fit nowhere.json").code, 2);
    EXPECT_EQ(rigor("fit " + (in / "train.json").string()).code, 2);
}

}  // namespace
