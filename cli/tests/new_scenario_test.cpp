// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor new scenario`: what it writes passes as it is.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "cli/tests/program.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;

TEST(NewScenario, PassesAsItIsWritten) {
    std::string name = testing::TempDir() + "new-scenario-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    const fs::path folder = name;
    const std::string file = (folder / "mine.json").string(), write = "new scenario mine --out " + file;
    const auto written = rigor(write);
    ASSERT_EQ(written.code, 0) << written.out;
    EXPECT_NE(written.out.find("validate " + file), std::string::npos) << written.out;
    const auto run =
        rigor("validate " + file + " --engines rigor --no-audit --out " + (folder / "run").string());
    EXPECT_EQ(run.code, 0) << run.out;
    EXPECT_NE(run.out.find("mine"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("slide_and_stop"), std::string::npos) << run.out;

    EXPECT_EQ(rigor(write).code, 2) << "nothing is overwritten";
    EXPECT_EQ(rigor("new scenario 'a b' --out " + file + "2").code, 2);
    EXPECT_EQ(rigor("new scenario box_stack --out " + file + "2").code, 2) << "a name of the library";
    const auto other = rigor("new scenario mine --from box_stak --out " + file + "2");
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.out.find("box_stack"), std::string::npos) << other.out;
    fs::remove_all(folder);
}

}  // namespace
}  // namespace rigor::cli_test
