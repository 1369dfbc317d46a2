// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The module that `rigor new engine --language cpp` writes, compiled as its owner would compile it.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "cli/tests/program.hpp"

namespace rigor::cli_test {
namespace {

TEST(NewModule, Conforms) {
    const std::string folder = testing::TempDir() + "mine_in_cpp";
    std::filesystem::remove_all(folder);
    const auto written = rigor("new engine mine_in_cpp --language cpp --folder " + folder);
    ASSERT_EQ(written.code, 0) << written.out;
    const std::string build = "cmake -S " + folder + " -B " + folder + "/build >/dev/null && cmake --build " +
                              folder + "/build >" + folder + "/log 2>&1";
    ASSERT_EQ(std::system(build.c_str()), 0);
    setenv("RIGOR_ADAPTER_PATH", (folder + "/build").c_str(), 1);
    const auto conform = rigor("conform mine_in_cpp --only description,build,motion");
    EXPECT_EQ(conform.code, 0) << conform.out;
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rigor::cli_test
