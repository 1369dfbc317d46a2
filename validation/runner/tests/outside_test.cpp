// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Disturbances from outside are no verdicts: children are killed, folders disappear, files are damaged, file handles
// run out.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "adapters/interface/registry.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"
#include "validation/runner/tests/fixtures.hpp"
#include "validation/runner/tests/same_runs.hpp"

namespace rigor::validation {
namespace {

using fixtures::plan;
using fixtures::timeless;
using testing::HasSubstr;
using testing::IsEmpty;

/// Kills processes of one kind ("__case", "__audit", "__describe") that belong to this test, as they appear.
class Killer {
  public:
    Killer(std::string kind, int most, int signal = SIGKILL)
        : kind_(std::move(kind)), most_(most), signal_(signal) {
        thread_ = std::thread([this] { run(); });
    }
    ~Killer() { stop(); }
    int stop() {
        done_ = true;
        if (thread_.joinable()) thread_.join();
        return killed_;
    }

  private:
    void run() {
        while (!done_ && killed_ < most_) {
            for (const pid_t process : children())
                if (killed_ < most_ && isMeant(process) && kill(process, signal_) == 0) {
                    ++killed_;
                    while (!done_ && isMeant(process)) usleep(200);
                }
            usleep(200);
        }
    }
    static std::vector<pid_t> children() {
        std::vector<pid_t> found;
        std::ifstream in("/proc/self/task/" + std::to_string(getpid()) + "/children");
        for (pid_t pid = 0; in >> pid;) found.push_back(pid);
        return found;
    }
    bool isMeant(pid_t process) const {
        std::ifstream in("/proc/" + std::to_string(process) + "/cmdline", std::ios::binary);
        for (std::string argument; std::getline(in, argument, '\0');)
            if (argument == kind_) return true;
        return false;
    }
    std::string kind_;
    int most_, signal_;
    std::atomic<bool> done_{false};
    std::atomic<int> killed_{0};
    std::thread thread_;
};

/// Makes modules newer, so that what is known of their engines no longer counts.
void renewModules() {
    for (const char* name : {"double_free_flight", "double_nan"})
        std::filesystem::last_write_time(adapter::moduleFor(adapter::parseSpec(name)),
                                         std::filesystem::file_time_type::clock::now());
}

class Outside : public fixtures::RunnerTest {
  protected:
    std::vector<CasePlan> cases_ = {};
    RunOptions audited(const std::string& folder) const {
        RunOptions o = options(folder);
        o.audit = true;
        return o;
    }
    void SetUp() override {
        RunnerTest::SetUp();
        cases_ = plan({fixtures::crossingBalls()},
                      "double_free_flight:preset=default,pause_us=2000,"
                      "double_nan:preset=default");
        whole_ = run(cases_, audited("whole"));
        for (const auto& row : whole_.cases) ASSERT_FALSE(row.audit.empty());
    }
    std::string stop(const RunOptions& o) {
        try {
            run(cases_, o);
        } catch (const results::EnvironmentError& error) {
            return error.what();
        }
        return "";
    }
    void expectResumed(RunOptions o) {
        o.resume = true;
        const auto resumed = run(cases_, o);
        EXPECT_EQ(timeless(resumed), timeless(whole_));
        EXPECT_FALSE(resumed.finished.empty());
        for (const auto& row : resumed.cases)
            fixtures::expectSameMotion(
                results::readTrajectory(o.directory / row.trajectoryFile),
                results::readTrajectory(options("whole").directory / row.trajectoryFile));
    }
    results::Run whole_;
};

TEST_F(Outside, AChildThatIsKilledOnceIsRunAgain) {
    for (const std::string kind : {"__case", "__audit", "__describe", "__serve"})
        for (const int signal : {SIGKILL, SIGTERM}) {
            if (kind == "__serve" && isSanitized()) continue;  // a build with sanitizers has no servers
            SCOPED_TRACE(kind + " " + std::to_string(signal));
            const std::string folder = kind + std::to_string(signal);
            renewModules();
            Killer killer(kind, 2, signal);
            const auto disturbed = run(cases_, audited(folder));
            EXPECT_GT(killer.stop(), 0);
            EXPECT_EQ(timeless(disturbed), timeless(whole_));
            EXPECT_FALSE(disturbed.finished.empty());
        }
}

TEST_F(Outside, AChildThatIsKilledEveryTimeHasNoVerdict) {
    for (const char* kind : {"__case", "__audit"}) {
        SCOPED_TRACE(kind);
        // A child may be done before it is seen: then not every one was killed.
        RunOptions o;
        std::string message;
        for (int attempt = 0; attempt < 10 && message.empty(); ++attempt) {
            o = audited("every" + std::to_string(attempt) + kind);
            Killer killer(kind, 1000);
            message = stop(o);
        }
        EXPECT_THAT(message, HasSubstr("killed from outside 3 times, the last time by SIGKILL"));
        const auto partial = results::readRun(o.directory);
        EXPECT_THAT(partial.finished, IsEmpty());
        for (const auto& row : partial.cases) {
            EXPECT_THAT(row.audit, IsEmpty());
            EXPECT_NE(row.outcome, results::Outcome::OutOfMemory);
            EXPECT_NE(row.outcome, results::Outcome::Crashed);
        }
        expectResumed(o);
    }
}

/// Without a server every child starts the program anew, and the run is the same.
TEST_F(Outside, ServersThatAreKilledEveryTimeAreDoneWithout) {
    if (isSanitized()) GTEST_SKIP() << "a build with sanitizers has no servers";
    Killer killer("__serve", 1000);
    const auto alone = run(cases_, audited("alone"));
    EXPECT_GT(killer.stop(), 1);
    EXPECT_EQ(timeless(alone), timeless(whole_));
    EXPECT_FALSE(alone.finished.empty());
}

TEST_F(Outside, AnEngineThatCannotBeDescribedForKillingStopsTheRun) {
    const RunOptions o = audited("describe");
    std::string message;
    renewModules();
    {
        Killer killer("__describe", 1000);
        message = stop(o);
    }
    EXPECT_THAT(message, HasSubstr("killed from outside"));
    EXPECT_FALSE(std::filesystem::exists(o.directory / "manifest.json")) << "nothing is known of any case";
}

TEST_F(Outside, AFolderThatDisappearsStopsTheRun) {
    const RunOptions o = audited("gone");
    const std::atomic<bool> never{false};
    std::string message;
    try {
        runCases(
            cases_, o,
            [&](const Progress& p) {
                if (p.finished != nullptr) std::filesystem::remove_all(o.directory / "trajectories");
            },
            never);
    } catch (const results::EnvironmentError& error) {
        message = error.what();
    }
    EXPECT_THAT(message, HasSubstr((o.directory / "trajectories").string()));
    EXPECT_THAT(message, HasSubstr("No such file or directory (ENOENT)"));
    std::filesystem::create_directories(o.directory / "trajectories");
    expectResumed(o);
}

TEST_F(Outside, TrajectoriesThatAreMissingOrDamagedAreMadeAgain) {
    const RunOptions o = audited("damaged");
    const auto first = run(cases_, o);
    std::filesystem::remove(o.directory / first.cases[0].trajectoryFile);
    {
        std::fstream file(o.directory / first.cases[1].trajectoryFile,
                          std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(2000);
        file.write("damage", 6);
    }
    std::ofstream(o.directory / "trajectories/left.h5.part") << "half";
    expectResumed(o);
    EXPECT_FALSE(std::filesystem::exists(o.directory / "trajectories/left.h5.part"));
}

TEST_F(Outside, NoFileHandlesStopTheRun) {
    if (isSanitized())
        GTEST_SKIP() << "the sanitizer of undefined behaviour needs handles of its own for its checks";
    struct rlimit before {};
    getrlimit(RLIMIT_NOFILE, &before);
    for (rlim_t handles = 6; handles < 24; ++handles) {
        const RunOptions o = audited("handles" + std::to_string(handles));
        const pid_t child = fork();
        if (child == 0) {
            const struct rlimit few { handles, handles };
            setrlimit(RLIMIT_NOFILE, &few);
            int code = 0;
            try {
                run(cases_, o);
            } catch (const results::EnvironmentError&) {
                code = 7;
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
                code = 1;
            }
            _exit(code);
        }
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_THAT(WEXITSTATUS(status), testing::AnyOf(0, 7)) << handles << " handles";
        if (!results::holdsStore(o.directory)) continue;
        for (const auto& row : results::readRun(o.directory).cases)
            for (const auto& expected : whole_.cases)
                if (row.id == expected.id) {
                    EXPECT_EQ(row.reason, expected.reason) << handles << " handles";
                }
    }
}

/// A process that a child put into a session of its own dies with it.
TEST(ChildrenOfChildren, DieWithTheirParent) {
    const ScratchFolder folder;
    const std::string mark = (folder.path() / "mark").string(), begun = (folder.path() / "begun").string();
    ProcessPool pool(1);
    pool.add({{"/bin/sh", "-c",
               "setsid sh -c 'echo > " + begun + "; sleep 1; echo > " + mark + "' & while [ ! -e " + begun +
                   " ]; do sleep 0.01; done"},
              {10.0, 0},
              "shell",
              [](const ProcessResult&) {}});
    const std::atomic<bool> never{false};
    EXPECT_TRUE(pool.run(never, [](const std::string&) {}));
    usleep(1500000);
    EXPECT_TRUE(std::filesystem::exists(begun));
    EXPECT_FALSE(std::filesystem::exists(mark)) << "it went on";
}

/// A scratch folder whose owner was killed goes away when the next one is made; one in use does not.
TEST(ScratchFolders, OfTheDeadAreRemoved) {
    const ScratchFolder temporary;
    setenv("TMPDIR", temporary.path().c_str(), 1);
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        const ScratchFolder abandoned;
        std::ofstream(abandoned.path() / "request.json") << "{}";
        (void)!write(ready[1], "x", 1);
        pause();
        _exit(0);
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    const auto entries = [&] {
        return std::distance(std::filesystem::directory_iterator(temporary.path()), {});
    };
    { const ScratchFolder mine; }
    EXPECT_EQ(entries(), 2) << "its owner lives: a folder and its lock";
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    { const ScratchFolder mine; }
    EXPECT_EQ(entries(), 0);
    unsetenv("TMPDIR");
}

/// Without a free file handle an empty folder goes, and one with files stays with its lock until the next is made.
TEST(ScratchFolders, AreNotForgottenWhereThereAreNoFileHandles) {
    const ScratchFolder temporary;
    setenv("TMPDIR", temporary.path().c_str(), 1);
    const auto entries = [&] {
        return std::distance(std::filesystem::directory_iterator(temporary.path()), {});
    };
    for (const bool isEmpty : {true, false}) {
        const pid_t child = fork();
        if (child == 0) {
            {
                const ScratchFolder folder;
                if (!isEmpty) std::ofstream(folder.path() / "request.json") << "{}";
                const struct rlimit none {};
                setrlimit(RLIMIT_NOFILE, &none);
            }
            _exit(0);
        }
        waitpid(child, nullptr, 0);
        EXPECT_EQ(entries(), isEmpty ? 0 : 2);
    }
    { const ScratchFolder next; }
    EXPECT_EQ(entries(), 0);
    unsetenv("TMPDIR");
}

}  // namespace
}  // namespace rigor::validation
