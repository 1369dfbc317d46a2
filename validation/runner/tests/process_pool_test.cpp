// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/process_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "validation/runner/describe.hpp"

namespace rigor::validation {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

ProcessResult shell(const std::string& script, ProcessLimits limits = {10.0, 0}) {
    ProcessPool pool(1);
    ProcessResult result;
    pool.add({{"/bin/sh", "-c", script}, limits, "shell", [&](const ProcessResult& r) { result = r; }});
    const std::atomic<bool> never{false};
    EXPECT_TRUE(pool.run(never, [](const std::string&) {}));
    return result;
}

TEST(ProcessPool, ReportsTheEndOfAChild) {
    EXPECT_TRUE(shell("exit 0").exitedWith(0));
    EXPECT_EQ(shell("exit 3").ending(), "exit code 3");
    EXPECT_THAT(shell("kill -SEGV $$").ending(), HasSubstr("SIGSEGV"));
    EXPECT_THAT(shell("kill -ABRT $$").ending(), HasSubstr("SIGABRT"));
    EXPECT_FALSE(shell("kill -ABRT $$").timedOut);
}

TEST(ProcessPool, KeepsTheEndOfWhatAChildSays) {
    const ProcessResult r =
        shell("i=0; while [ $i -lt 5000 ]; do echo line $i; i=$((i+1)); done; echo last >&2");
    EXPECT_THAT(r.outputTail, EndsWith("line 4999\nlast\n"));
    EXPECT_LE(r.outputTail.size(), 4096u);
}

TEST(ProcessPool, EndsWhatTakesTooLongWithAllItStarted) {
    const ScratchFolder folder;
    const auto mark = folder.path() / "mark";
    const ProcessResult r = shell("(sleep 1; echo late > " + mark.string() + ") & while :; do :; done",
                                  {0.2 / timeLimitFactor(), 0});
    EXPECT_TRUE(r.timedOut);
    EXPECT_LT(r.wallSeconds, 5.0);
    EXPECT_GT(r.cpuSeconds, 0.0);
    usleep(1200000);
    EXPECT_FALSE(std::filesystem::exists(mark)) << "a grandchild went on";
}

/// A stand-in for a busy machine: the child is stopped for eight ninths of the time. Its processor time is
/// within the limit, its wall time is not.
TEST(ProcessPool, WaitsForAChildThatGetsAPartOfTheProcessor) {
    const ScratchFolder folder;
    const std::string mark = (folder.path() / "mark").string();
    const double limit = 2.0;
    const ProcessResult r = shell(
        "(for i in 1 2 3 4 5 6 7; do sleep 0.05; kill -STOP $$; sleep 0.4; kill -CONT $$; done; touch " +
            mark + ") & while [ ! -e " + mark + " ]; do :; done; exit 7",
        {limit / timeLimitFactor(), 0});
    EXPECT_TRUE(r.exitedWith(7)) << r.ending() << " after " << r.wallSeconds << " s, " << r.cpuSeconds;
    EXPECT_GT(r.wallSeconds, limit);
}

/// Nothing to do and nothing done: no reason to wait.
TEST(ProcessPool, EndsWhatIsBlocked) {
    const ProcessResult r = shell("sleep 60", {0.2 / timeLimitFactor(), 0});
    EXPECT_TRUE(r.timedOut);
    EXPECT_LT(r.wallSeconds, 10.0);
}

TEST(ProcessPool, ChildrenHaveNoInputAndNoCoreDump) {
    EXPECT_TRUE(shell("if read line; then exit 1; fi; [ $(ulimit -c) = 0 ]").exitedWith(0));
}

/// Two slots, four sleeps: about two sleeps long; order of the ends does not matter, all are reported.
TEST(ProcessPool, RunsAsManyAtATimeAsItMay) {
    ProcessPool pool(2);
    int ended = 0, added = 0;
    for (int i = 0; i < 4; ++i)
        pool.add({{"/bin/sh", "-c", "sleep 0.6"}, {10.0, 0}, "sleep", [&](const ProcessResult& r) {
                      ended += r.exitedWith(0) ? 1 : 0;
                      if (added++ == 0)
                          pool.addNext(
                              {{"/bin/true"}, {10.0, 0}, "more", [&](const ProcessResult&) { ended += 10; }});
                  }});
    const std::atomic<bool> never{false};
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(pool.run(never, [](const std::string&) {}));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(ended, 14);
    EXPECT_GE(seconds, 1.2);
    EXPECT_LT(seconds, 2.3) << "one after the other would be 2.4 s";
}

TEST(ProcessPool, AnInterruptKillsWhatRuns) {
    // Processes that others have left behind become children of this one, which adopts orphans.
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    ProcessPool pool(2);
    std::atomic<bool> interrupted{false};
    pool.add({{"/bin/sleep", "100"}, {200.0, 0}, "long", [](const ProcessResult&) {
                  FAIL() << "it did not end";
              }});
    pool.add({{"/bin/true"}, {10.0, 0}, "short", [&](const ProcessResult&) { interrupted = true; }});
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_FALSE(pool.run(interrupted, [](const std::string&) {}));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

/// kill -9 of the parent: its children do not go on for ever.
TEST(ProcessPool, ChildrenDieWithTheirParent) {
    const ScratchFolder folder;
    const auto pidFile = folder.path() / "pid";
    const pid_t parent = fork();
    if (parent == 0) {
        ProcessPool pool(1);
        pool.add({{"/bin/sh", "-c", "echo $$ > " + pidFile.string() + "; exec sleep 100"},
                  {200.0, 0},
                  "",
                  [](const ProcessResult&) {}});
        const std::atomic<bool> never{false};
        pool.run(never, [](const std::string&) {});
        _exit(0);
    }
    pid_t child = 0;
    for (int i = 0; i < 500 && child == 0; ++i) {
        usleep(10000);
        std::ifstream(pidFile) >> child;
    }
    ASSERT_GT(child, 0);
    ASSERT_EQ(kill(child, 0), 0) << "it runs";
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    bool gone = false;
    for (int i = 0; i < 200 && !gone; ++i) {
        usleep(10000);
        std::ifstream status("/proc/" + std::to_string(child) + "/stat");
        std::string pid, name, state;
        gone = !(status >> pid >> name >> state) || state == "Z";  // a zombie waits for init, it does not run
    }
    EXPECT_TRUE(gone);
}

}  // namespace
}  // namespace rigor::validation
