// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The quick part of the table in README.md: some scenarios, some steps.
#include "validation/same_bits/same_bits.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>

#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using namespace fixtures;

/// The columns of the table.
constexpr const char* kSpecs[] = {"rigor:precision=f32,preset=default", "rigor:precision=f64,preset=default",
                                  "rigor:precision=f32,preset=fast", "rigor:precision=f64,preset=fast"};

std::string allSpecs() {
    std::string text;
    for (const char* spec : kSpecs) text += (text.empty() ? "" : ",") + std::string(spec);
    return text;
}

SameBitsCase caseOf(const std::string& scenario, const std::string& spec, std::size_t steps) {
    const auto loaded = scenario::loadScenario(scenario::findScenario(scenario));
    return {loaded.scenario, adapter::parseSpec(spec), loaded.scenario.timeSteps.front(), steps};
}

class SameBits : public RunnerTest {
  protected:
    void SetUp() override {
        const std::string folder = buildFolder();
        setenv("RIGOR_ADAPTER_PATH", (folder + "/bin/adapters:" + folder + "/tests/doubles").c_str(), 1);
    }
};

TEST_F(SameBits, AgainOnTwoThreadsAndRestored) {
    for (const char* name : {"box_stack", "pendulum_chain", "slip_to_roll_2d", "fixed_break"})
        for (const char* spec : kSpecs) {
            SCOPED_TRACE(std::string(name) + " " + spec);
            const SameBitsCase one = caseOf(name, spec, 90);
            const StateHashes first = statesOf(one);
            ASSERT_FALSE(first.empty());
            EXPECT_FALSE(firstDifference(first, statesOf(one)));
            const auto two = onTwoThreads(one);
            ASSERT_TRUE(two);
            EXPECT_FALSE(firstDifference(first, statesOf(*two)));
            for (const unsigned seed : {1u, 2u}) {
                const auto restored = restoredStatesOf(one, seed);
                ASSERT_TRUE(restored);
                EXPECT_FALSE(firstDifference(first, *restored)) << "seed " << seed;
            }
        }
}

TEST_F(SameBits, AnotherMotionHasOthers) {
    const SameBitsCase one = caseOf("box_stack", "rigor:precision=f64,preset=default", 20);
    SameBitsCase other = one;
    other.scenario.gravity = 1.0000000000000002 * other.scenario.gravity;
    const auto step = firstDifference(statesOf(one), statesOf(other));
    ASSERT_TRUE(step);
    EXPECT_LE(*step, 20u);
    EXPECT_EQ(firstDifference({"a", "b"}, {"a", "c"}), 2u);
    EXPECT_EQ(firstDifference({"a"}, {"a", "b"}), 2u);
    EXPECT_FALSE(firstDifference({"a"}, {"a"}));
}

TEST_F(SameBits, EnginesWithoutTheMeansAreNotCompared) {
    const SameBitsCase one = caseOf("free_flight", "double_free_flight:preset=default", 5);
    EXPECT_FALSE(restoredStatesOf(one, 1));
    EXPECT_FALSE(onTwoThreads(one));
}

/// The run of `rigor run`, in this process, and that of `rigor validate`, in a child.
TEST_F(SameBits, RunAndValidateEndInTheSame) {
    const std::string text = scenario::loadScenario(scenario::findScenario("box_stack")).text;
    const auto cases = plan({text}, allSpecs());
    ASSERT_GE(cases.size(), std::size(kSpecs));
    const auto run = RunnerTest::run(cases, options());
    ASSERT_EQ(run.cases.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const SameBitsCase one{cases[i].scenario, cases[i].spec, cases[i].dt, 0};
        ASSERT_EQ(run.cases[i].id, cases[i].id);
        EXPECT_EQ(statesOf(one).back(), run.cases[i].stateHash) << one.key();
    }
}

int exitCodeOf(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string contentOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The program, with the kernels of each instruction set of this machine. `fast` uses them in every island.
TEST_F(SameBits, EveryInstructionSetGivesThem) {
    const std::string folder = buildFolder(), hashes = scratch_.path() / "hashes",
                      log = scratch_.path() / "log";
    const std::string program = folder + "/bin/rigor-same-bits --steps 40 --engines " + allSpecs();
    ASSERT_EQ(exitCodeOf(program + " --write " + hashes + " box_stack ball_pyramid_stands >" + log), 0)
        << contentOf(log);
    int sets = 0;
    for (const char* set : {"AVX3", "AVX2", "SSE4", "SSE2", "EMU128"}) {
        const int code = exitCodeOf(
            "LD_PRELOAD=" + folder + "/tests/instruction_set.so RIGOR_INSTRUCTION_SET=" + set + " " +
            program + " --against " + hashes + " box_stack ball_pyramid_stands >" + log + " 2>&1");
        if (code == 9) continue;  // not on this machine, or not in this build
        EXPECT_EQ(code, 0) << set << "\n" << contentOf(log);
        for (const std::string precision : {"f32", "f64"})
            EXPECT_THAT(contentOf(log),
                        testing::HasSubstr(precision + ", against " + hashes + "     4 of     4 cases"))
                << set;
        ++sets;
    }
    EXPECT_GE(sets, 1);
}

}  // namespace
}  // namespace rigor::validation
