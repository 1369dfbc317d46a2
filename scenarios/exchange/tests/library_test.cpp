// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A library that aborts, crashes, exits, hangs or takes all memory ends with a refusal, and never the program.
#include <gmock/gmock.h>

#include <chrono>

#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace {

using ::testing::HasSubstr;

class FailingLibrary : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(FailingLibrary, IsARefusal) {
    const auto [fault, said] = GetParam();
    setenv("LD_PRELOAD", RIGOR_LIBRARY_DOUBLE, 1);
    setenv("RIGOR_TEST_LIBRARY", fault, 1);
    const auto start = std::chrono::steady_clock::now();
    const auto file =
        writeText(freshFolder("failing") / "model.xml",
                  "<mujoco><worldbody><body><freejoint/><geom size=\"1\"/></body></worldbody></mujoco>");
    const std::string text = refusal("mjcf", file, "--time-limit 2");
    unsetenv("LD_PRELOAD");
    EXPECT_THAT(text, HasSubstr(std::string("model.xml: file: its reader ") + said));
    EXPECT_THAT(text, HasSubstr("was not imported"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

INSTANTIATE_TEST_SUITE_P(Faults, FailingLibrary,
                         ::testing::Values(std::pair("aborts", "ended with SIGABRT"),
                                           std::pair("crashes", "ended with SIGSEGV"),
                                           std::pair("exits", "ended with exit code 0"),
                                           std::pair("hangs", "did not end within 2 s (--time-limit)"),
                                           std::pair("fills_memory", "needs more than 4096 MiB of memory"),
                                           std::pair("floods", "ended with SIGABRT")),
                         [](const auto& fault) { return std::string(fault.param.first); });

}  // namespace
}  // namespace rigor::models::testing
