// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests with one fault each go through a whole run: every one is one row that says what became of it, and the others
// are not held up by it.
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>

#include "validation/runner/judge.hpp"
#include "validation/runner/start_program.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Outcome;
using testing::HasSubstr;

struct GuestFault {
    const char* name;
    Outcome outcome;
    const char* reason;  ///< part of the row's reason
};

const GuestFault kGuestFaults[] = {
    {"exit", Outcome::Crashed, "the guest gives up"},
    {"killed", Outcome::Crashed, "SIGKILL"},
    {"truncated", Outcome::Crashed, "within a frame"},
    {"silent", Outcome::Timeout, "no answer within 1 s"},
    {"endless_log", Outcome::Timeout, "no answer within 1 s"},
    {"garbage", Outcome::Error, "Hello, world"},
    {"endless_text", Outcome::Error, "is no frame"},
    {"version", Outcome::Error, "version 2 of the protocol"},
    {"no_states", Outcome::Error, "the array 'states' is missing"},
    {"nan", Outcome::NonFinite, "ball"},
    {"memory", Outcome::OutOfMemory, "MiB in memory"},
    {"refuse", Outcome::Unsupported, "spheres that fly"},
};

class GuestFaults : public fixtures::RunnerTest {
  protected:
    void SetUp() override {
        namespace fs = std::filesystem;
        folder_ = scratch_.path() / "guests";
        fs::create_directory(folder_);
        const char* host = "rigor_guest_host.so";
        fs::create_symlink(fixtures::buildFolder() / "bin/adapters" / host, folder_ / host);
        setenv("RIGOR_ADAPTER_PATH", folder_.c_str(), 1);
    }
    std::string add(const std::string& fault, bool keepAlive = false) const {
        const std::string name = "faulty_" + fault,
                          guests = std::string(RIGOR_SOURCE_DIR) + "/adapters/guest/";
        std::ofstream(folder_ / ("rigor_adapter_" + name + ".json"))
            << R"({"rigor_guest": 1, "protocol": 1, "precision": "f64", "reply_seconds": )"
            << (fault == "memory" ? 60 : 1) << (keepAlive ? R"(, "keep_alive": true)" : "")
            << R"(, "memory": "resident", "name": ")" << name << R"(", "command": ["python3", ")" << guests
            << R"(tests/faulty_guest.py", ")" << guests << R"(sdk", ")" << fault << R"(", ")" << name
            << R"("]})";
        return name;
    }
    /// Runs three scenarios, one after the other, and returns how often the guest was started for a case.
    std::size_t startsOf(const std::string& fault, bool keepAlive, results::Run& done) const {
        const auto file = scratch_.path() / ("starts-" + fault + (keepAlive ? "-kept" : ""));
        setenv("RIGOR_GUEST_STARTS", file.c_str(), 1);
        const std::string spec = add(fault, keepAlive) + ":preset=matched";
        const std::vector<std::string> scenes = {fixtures::thrownBall("one"), fixtures::thrownBall("two"),
                                                 fixtures::thrownBall("three")};
        done = run(fixtures::plan(scenes, spec), options(file.filename().string() + "-run"));
        unsetenv("RIGOR_GUEST_STARTS");
        std::ifstream starts(file);
        std::size_t lines = 0;
        for (std::string line; std::getline(starts, line);) ++lines;
        return lines - 1;  // one start is for the description of the engine
    }
    std::filesystem::path folder_;
};

TEST_F(GuestFaults, AreOneRowEach) {
    std::string specs = add("none") + ":preset=matched";
    std::size_t guests = 1;
    for (const GuestFault& fault : kGuestFaults) {
        // A build with sanitizers has no limits of memory: this guest would take all there is.
        if (isSanitized() && fault.outcome == Outcome::OutOfMemory) continue;
        specs += "," + add(fault.name) + ":preset=matched";
        ++guests;
    }
    auto o = options();
    o.memoryLimitMiB = 400;
    o.jobs = 2;
    const auto start = std::chrono::steady_clock::now();
    const auto done = run(fixtures::plan({fixtures::thrownBall("guests")}, specs), o);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(100));
    ASSERT_EQ(done.cases.size(), guests);
    for (const CaseRow& row : done.cases) {
        SCOPED_TRACE(row.spec + ": " + row.reason);
        if (row.engine == "faulty_none") {
            EXPECT_EQ(row.outcome, Outcome::Completed);
            ASSERT_FALSE(row.timings.empty());
            EXPECT_LT(row.timings[0].median, 1e-3) << "the guest's own clock around a step that does nothing";
            continue;
        }
        for (const GuestFault& fault : kGuestFaults) {
            if (row.engine != std::string("faulty_") + fault.name) continue;
            EXPECT_EQ(row.outcome, fault.outcome);
            EXPECT_THAT(row.reason, HasSubstr(fault.reason));
            EXPECT_EQ(results::isRed(row), fault.outcome != Outcome::Unsupported);
        }
    }
}

TEST_F(GuestFaults, AKeptGuestServesAllCases) {
    results::Run alone, kept;
    EXPECT_EQ(startsOf("none", false, alone), 3u);
    EXPECT_EQ(startsOf("none", true, kept), 1u);
    ASSERT_EQ(kept.cases.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(kept.cases[i].outcome, Outcome::Completed) << kept.cases[i].reason;
        EXPECT_EQ(kept.cases[i].stateHash, alone.cases[i].stateHash);
        EXPECT_GT(kept.cases[i].cpuSeconds, 0.0);
    }
}

/// A guest that ends in its second world: the second case is run again with a guest of its own, the third has a new one.
TEST_F(GuestFaults, ACaseThatAKeptGuestEndsIsRunAgain) {
    results::Run done;
    EXPECT_EQ(startsOf("tired", true, done), 3u);
    ASSERT_EQ(done.cases.size(), 3u);
    for (const CaseRow& row : done.cases) EXPECT_EQ(row.outcome, Outcome::Completed) << row.reason;
}

/// A guest that ends every time is still one row, with the reason of a guest that served no other case.
TEST_F(GuestFaults, AFaultOfAKeptGuestIsReportedLikeThatOfAnother) {
    const std::string name = add("exit", true);
    auto o = options();
    const auto done = run(fixtures::plan({fixtures::thrownBall("guests")}, name + ":preset=matched"), o);
    ASSERT_EQ(done.cases.size(), 1u);
    EXPECT_EQ(done.cases[0].outcome, Outcome::Crashed);
    EXPECT_THAT(done.cases[0].reason, HasSubstr("exit code 3"));
    EXPECT_THAT(done.cases[0].reason, HasSubstr("the guest gives up"));
}

}  // namespace
}  // namespace rigor::validation
