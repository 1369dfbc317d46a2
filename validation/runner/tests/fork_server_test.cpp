// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Children that are forked from a process which has loaded their module. That crashes, hangs and lack of memory end as
// they do in a process of their own is shown by the other tests here, whose cases are forked so.
#include "validation/runner/fork_server.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>

#include "validation/runner/descendants.hpp"
#include "validation/runner/serve.hpp"
#include "validation/runner/start_program.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct ForkedChild {
    pid_t pid = 0;
    int output = -1;
};

class Served : public fixtures::RunnerTest {
  protected:
    void SetUp() override {
        RunnerTest::SetUp();
        if (isSanitized()) GTEST_SKIP() << "nothing is served in a build with sanitizers";
    }
    void TearDown() override { unsetenv("RIGOR_DOUBLE_UNCLEAN"); }

    static fs::path moduleOf(const std::string& name) {
        return *servedModule(adapter::parseSpec("double_" + name));
    }
    /// A fork of the server of a double; empty if there is none.
    std::optional<ForkedChild> start(const std::string& name, const std::vector<std::string>& arguments,
                                     std::size_t memoryMiB = 0) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
        std::vector<std::string> all{options().binary.string()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const auto pid = servers_->start(moduleOf(name), all, ends[1], memoryMiB);
        close(ends[1]);
        if (pid) return ForkedChild{*pid, ends[0]};
        close(ends[0]);
        return std::nullopt;
    }
    /// The output of a child, and its status as of waitpid.
    static std::pair<std::string, int> end(const ForkedChild& child) {
        std::string said;
        while (drainOutput(child.output, said)) {
        }
        close(child.output);
        int status = -1;
        EXPECT_EQ(waitpid(child.pid, &status, 0), child.pid) << "it is a child of this process";
        return {said, status};
    }
    /// A fork that shows its own command and waits for its request at a pipe that has no writer.
    std::optional<ForkedChild> startWaiting(std::size_t memoryMiB = 0) {
        if (!fs::exists(request_) && mkfifo(request_.c_str(), 0600) != 0) return std::nullopt;
        const auto child = start("free_flight", {"__case", request_.string()}, memoryMiB);
        for (int i = 0; child && i < 500; ++i) {
            if (bytesOf(folderOf(*child) / "cmdline").find("__case") != std::string::npos) break;
            usleep(10000);
        }
        return child;
    }
    static fs::path folderOf(const ForkedChild& child) { return "/proc/" + std::to_string(child.pid); }
    bool isServed(const std::string& name) {
        const auto child = start(name, {"__nothing"});
        if (child) (void)end(*child);
        return child.has_value();
    }
    /// The child of this process that serves.
    static pid_t serverPid() {
        std::ifstream in("/proc/self/task/" + std::to_string(getpid()) + "/children");
        for (pid_t pid = 0; in >> pid;)
            if (bytesOf("/proc/" + std::to_string(pid) + "/cmdline").find(kServeCommand) != std::string::npos)
                return pid;
        return 0;
    }
    std::optional<ForkServers> servers_{std::in_place};
    const fs::path request_ = scratch_.path() / "request";
};

TEST_F(Served, AForkIsAChildOfThisProcessWithItsOwnOutput) {
    for (const char* word : {"__first", "__second"}) {
        const auto child = start("free_flight", {word});
        ASSERT_TRUE(child);
        const auto [said, status] = end(*child);
        EXPECT_THAT(said, HasSubstr(std::string("'") + word + "' is not for people"));
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << status;
    }
}

/// A fork shows its own arguments, leads its process group, is marked as an ancestor, has its limit of memory, and dies
/// alone.
TEST_F(Served, AForkIsSetUpAsAStartedProgramIs) {
    const auto child = startWaiting(512);
    ASSERT_TRUE(child);
    const fs::path process = folderOf(*child);
    EXPECT_EQ(getpgid(child->pid), child->pid);
    EXPECT_THAT(bytesOf(process / "cmdline"), HasSubstr(std::string("__case") + '\0' + request_.string()));
    EXPECT_THAT(bytesOf(process / "environ"), HasSubstr(ancestorMark(getpid(), child->pid)));
    EXPECT_THAT(bytesOf(process / "limits"), testing::ContainsRegex("Max address space +536870912 "));
    EXPECT_THAT(bytesOf(process / "limits"), testing::ContainsRegex("Max core file size +0 "));
    kill(child->pid, SIGKILL);
    const int status = end(*child).second;
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    EXPECT_TRUE(isServed("free_flight"));
}

/// The heaps and mappings of started programs are at random addresses; those of forks differ, too.
TEST_F(Served, ForksHaveTheirHeapsAndMappingsAtRandomAddresses) {
    std::set<std::string> heaps, reserved;
    const auto lineOf = [](const std::string& maps, std::size_t place) {
        const auto line = maps.rfind('\n', place) + 1;
        return place == std::string::npos ? "" : maps.substr(line, maps.find(' ', line) - line);
    };
    for (int k = 0; k < 3; ++k) {
        const auto child = startWaiting();
        ASSERT_TRUE(child);
        const std::string maps = bytesOf(folderOf(*child) / "maps");
        heaps.insert(lineOf(maps, maps.rfind("[heap]")));
        reserved.insert(lineOf(maps, maps.find(" ---p 00000000 00:00 0")));  // below it new mappings are made
        kill(child->pid, SIGKILL);
        (void)end(*child);
    }
    for (const auto* places : {&heaps, &reserved}) {
        EXPECT_GT(places->size(), 1u);
        EXPECT_FALSE(places->contains(""));
    }
}

/// A child that is forked from another server than that of its auditor would load the auditor itself.
TEST_F(Served, AnAuditIsForkedFromTheServerOfItsAuditor) {
    const fs::path modules = scratch_.path() / "modules", loads = scratch_.path() / "loads";
    fs::create_directories(modules);
    for (const char* name : {"auditor", "free_flight"}) {
        const std::string file = std::string("rigor_adapter_double_") + name + ".so";
        fs::copy_file(fixtures::buildFolder() / "tests/doubles" / file, modules / file);
    }
    setenv("RIGOR_ADAPTER_PATH", modules.c_str(), 1);
    setenv("RIGOR_DOUBLE_LOADS", loads.c_str(), 1);
    std::vector<std::string> scenarios;
    for (const char* name : {"crossing_1", "crossing_2", "crossing_3", "crossing_4"}) {
        std::string text = fixtures::crossingBalls();
        scenarios.push_back(text.replace(text.find("crossing_balls"), std::strlen("crossing_balls"), name));
    }
    RunOptions audited = options();
    audited.audit = true;
    const auto run = Served::run(fixtures::plan(scenarios, "double_free_flight:preset=matched"), audited);
    unsetenv("RIGOR_DOUBLE_LOADS");
    ASSERT_EQ(run.cases.size(), 4u);
    for (const auto& row : run.cases) EXPECT_FALSE(row.audit.empty());
    const std::string noted = bytesOf(loads);
    EXPECT_LE(std::count(noted.begin(), noted.end(), '\n'), 3)
        << "it is loaded to be described and by its server, and once more where the server needs long to "
           "load";
}

TEST_F(Served, ModulesThatLeaveSomethingBehindAreNot) {
    for (const char* left : {"thread", "rounding", "file", "memory", "child", "crash"}) {
        setenv("RIGOR_DOUBLE_UNCLEAN", left, 1);
        servers_->endAll();
        EXPECT_FALSE(isServed("unclean")) << left;
        EXPECT_EQ(serverPid(), 0) << left;
    }
    unsetenv("RIGOR_DOUBLE_UNCLEAN");
    servers_->endAll();
    EXPECT_TRUE(isServed("unclean"));
}

TEST_F(Served, AServerThatIsKilledIsStartedAgainOnce) {
    ASSERT_TRUE(isServed("free_flight"));
    for (const bool isStartedAgain : {true, false}) {
        const pid_t server = serverPid();
        ASSERT_GT(server, 0);
        kill(server, SIGKILL);
        EXPECT_EQ(isServed("free_flight"), isStartedAgain);
    }
    EXPECT_EQ(serverPid(), 0);
}

/// A server that does not answer is given up.
TEST_F(Served, AServerThatIsStoppedIsReplaced) {
    servers_.emplace(std::chrono::seconds(2));
    ASSERT_TRUE(isServed("free_flight"));
    const pid_t stopped = serverPid();
    kill(stopped, SIGSTOP);
    EXPECT_TRUE(isServed("free_flight"));
    EXPECT_NE(serverPid(), stopped);
}

TEST_F(Served, GuestsAndMissingEnginesHaveNoModule) {
    EXPECT_FALSE(servedModule(adapter::parseSpec("no_such_engine")));
}

}  // namespace
}  // namespace rigor::validation
