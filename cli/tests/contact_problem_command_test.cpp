// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor freeze` and `rigor solve` from the user's side.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tests/program.hpp"

namespace {

using nlohmann::json;
using rigor::cli_test::rigor;
using testing::HasSubstr;

std::string file(const char* name) {
    return (std::filesystem::path(testing::TempDir()) / name).string();
}

TEST(FreezeCommand, AStepGoesToAFileAndIsSolved) {
    const std::string stack = file("stack.hdf5"), csv = file("stack.csv");
    const auto exported = rigor("freeze stack_forces --engine rigor:solver=nsgs --step 3 --out " + stack);
    ASSERT_EQ(exported.code, 0) << exported.out;
    EXPECT_THAT(exported.out, HasSubstr("step 3 of stack_forces"));
    const auto solved =
        rigor("solve " + stack + " --solvers rigor:solver=nsgs,rigor:solver=pgs,rigor:solver=xpbd " +
                  "--iterations 500,1 --seconds 2 --json --csv " + csv,
              false);
    ASSERT_EQ(solved.code, 0) << solved.out;
    const json out = json::parse(solved.out);
    const json& problem = out.at("problems").at(0);
    EXPECT_EQ(problem.at("name"), "stack_forces");
    EXPECT_EQ(problem.at("dimension"), 3);
    const json& answers = problem.at("answers");
    ASSERT_EQ(answers.size(), 4u);  // the engine's own beside them
    EXPECT_EQ(answers[0].at("solver"), "stored");
    EXPECT_LT(answers[0].at("steps")[0].at("residual").get<double>(), 1e-9);
    EXPECT_EQ(answers[1].at("solver"), "rigor:solver=nsgs");
    EXPECT_LT(answers[1].at("steps").back().at("residual").get<double>(), 1e-10);
    ASSERT_EQ(answers[2].at("steps").size(), 2u);
    EXPECT_EQ(answers[2].at("steps")[0].at("allowed"), 1) << "the numbers of iterations rise";
    EXPECT_GT(answers[2].at("steps")[0].at("residual").get<double>(),
              answers[2].at("steps")[1].at("residual").get<double>());
    EXPECT_EQ(answers[3].at("outcome"), "unsupported");
    std::ifstream in(csv);
    std::string head;
    std::getline(in, head);
    EXPECT_THAT(head, HasSubstr("solver;friction;outcome;allowed;done"));
}

TEST(FreezeCommand, WhatCannotBeExportedIsSaid) {
    const std::string out = " --out " + file("none.hdf5");
    auto result = rigor("freeze hinge_limit" + out);
    EXPECT_EQ(result.code, 4);
    EXPECT_THAT(result.out, HasSubstr("a limit is no equation between velocities"));
    result = rigor("freeze free_flight --step 1" + out);
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("no contacts to export"));
    EXPECT_EQ(rigor("freeze no_such_scenario" + out).code, 2);
    EXPECT_EQ(rigor("freeze stack_forces").code, 2);
    EXPECT_EQ(rigor("freeze stack_forces --step 1 --time 2" + out).code, 2);
}

TEST(SolveCommand, BadInputIsSaid) {
    auto result = rigor("solve nowhere.hdf5 --solvers rigor");
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("nowhere.hdf5: there is no such file"));
    std::ofstream(file("bad.json"))
        << R"({"form": "local", "dim": 4, "mu": [], "q": [], "W": {"n": [0, 0], "rows": [], "cols": [], "vals": []}})";
    result = rigor("solve " + file("bad.json") + " --solvers rigor");
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("the dimension has 4, expected 2 or 3"));
    result = rigor("solve " + file("bad.json") + " --solvers ode");
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("ode has no solvers for contact problems"));
}

}  // namespace
