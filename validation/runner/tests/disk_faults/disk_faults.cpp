// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A small run on a disk on which one call fails (faulty_disk.cpp). Whichever it is: the run ends well or stops with a
// message that names the path and the error, no case is judged by it, and `--resume` makes the run what an undisturbed
// one is, with its audits and files.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <sstream>

#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/start_program.hpp"
#include "validation/runner/tests/fixtures.hpp"
#include "validation/runner/tests/same_runs.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

#ifdef RIGOR_EVERY_FAULT
constexpr int kFaultsOfKind = 1 << 30;
#else
constexpr int kFaultsOfKind = 8;
#endif

struct Ended {
    int code = 0;
    std::string output;
    bool isStopped() const { return code == kExitEnvironment; }
};

class DiskFaults : public fixtures::RunnerTest {
  protected:
    void SetUp() override {
        if (isSanitized()) GTEST_SKIP() << "a sanitizer's own library must be the first that is loaded";
        const fs::path adapters = scratch_.path() / "adapters";
        fs::create_directories(adapters);
        fs::create_directories(temporary());
        for (const char* name : {"free_flight", "nan", "auditor"}) {
            const std::string file = std::string("rigor_adapter_double_") + name + ".so";
            fs::create_symlink(fixtures::buildFolder() / "tests/doubles" / file, adapters / file);
        }
        setenv("RIGOR_ADAPTER_PATH", adapters.c_str(), 1);
        setenv("TMPDIR", temporary().c_str(), 1);
        ASSERT_EQ(makeRun("whole", false).code, 0);
        whole_ = results::readRun(folder("whole"));
        ASSERT_EQ(whole_.cases.size(), 4u);
        for (const auto& row : whole_.cases) ASSERT_FALSE(row.audit.empty());
    }
    void TearDown() override { unsetenv("TMPDIR"); }

    fs::path temporary() const { return scratch_.path() / "tmp"; }
    fs::path folder(const std::string& name) const { return scratch_.path() / "runs" / name; }

    /// A whole run in a process of its own, to which `variables` are given.
    Ended makeRun(const std::string& name, bool resume,
                  const std::map<std::string, std::string>& variables = {}) {
        const fs::path request = scratch_.path() / "request.json", output = scratch_.path() / "output";
        writeJsonFile(request, {{"folder", folder(name).string()},
                                {"resume", resume},
                                {"specs", "double_free_flight:preset=default,double_nan:preset=default"},
                                {"texts", {fixtures::thrownBall("ball"), fixtures::crossingBalls()}}});
        const std::string program = (fixtures::buildFolder() / "tests/runner_child").string();
        const pid_t child = fork();
        if (child == 0) {
            for (const auto& [key, value] : variables) setenv(key.c_str(), value.c_str(), 1);
            const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            dup2(file, STDOUT_FILENO);
            dup2(file, STDERR_FILENO);
            execl(program.c_str(), program.c_str(), "__run", request.c_str(), nullptr);
            _exit(1);
        }
        int status = 0;
        waitpid(child, &status, 0);
        std::stringstream text;
        text << std::ifstream(output).rdbuf();
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, text.str()};
    }

    /// The same with the fault `kind` at call `at`; `calls` becomes the number of calls.
    Ended makeFaultyRun(const std::string& name, const std::string& kind, std::int64_t at,
                        std::int64_t& calls) {
        const fs::path counter = scratch_.path() / "counter";
        results::replaceScratchFile(counter, std::string(sizeof calls, '\0'));
        std::map<std::string, std::string> variables{
            {"LD_PRELOAD", (fixtures::buildFolder() / "tests/faulty_disk.so").string()},
            {"RIGOR_FAULT_COUNTER", counter.string()},
            {"RIGOR_FAULT_AT", std::to_string(at)},
            {"RIGOR_FAULT_KIND", kind},
            {"RIGOR_FAULT_UNDER", folder(name).string() + ":" + temporary().string()}};
        if (!process_.empty()) variables["RIGOR_FAULT_PROCESS"] = process_;
        const Ended end = makeRun(name, false, variables);
        std::ifstream(counter, std::ios::binary).read(reinterpret_cast<char*>(&calls), sizeof calls);
        return end;
    }

    void expectUndisturbed(const std::string& name) {
        const auto run = results::readRun(folder(name));
        EXPECT_THAT(run.damage, IsEmpty());
        EXPECT_FALSE(run.finished.empty());
        EXPECT_EQ(fixtures::timeless(run), fixtures::timeless(whole_));
        for (const auto& row : run.cases)
            fixtures::expectSameMotion(results::readTrajectory(folder(name) / row.trajectoryFile),
                                       results::readTrajectory(folder("whole") / row.trajectoryFile));
        EXPECT_EQ(filesOf(folder(name)), filesOf(folder("whole")));
    }

    static std::vector<std::string> filesOf(const fs::path& run) {
        std::vector<std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(run))
            files.push_back(fs::relative(entry.path(), run).string());
        std::sort(files.begin(), files.end());
        return files;
    }

    /// Whatever call fails, no case is stored that an undisturbed run would not have stored.
    void expectNoBlame(const std::string& name) {
        if (!results::holdsStore(folder(name))) return;
        results::Run partial;
        try {
            partial = results::readRun(folder(name));
        } catch (const std::runtime_error&) {
            return;  // the tables were not made
        }
        for (const auto& row : partial.cases)
            for (const auto& expected : whole_.cases)
                if (row.id == expected.id) {
                    EXPECT_EQ(row.verdict, expected.verdict) << row.reason;
                    EXPECT_EQ(row.reason, expected.reason);
                    EXPECT_THAT(row.audit.size(), AnyOf(0u, expected.audit.size()));
                }
    }

    void checkFault(const std::string& kind, std::int64_t at) {
        SCOPED_TRACE(kind + " at call " + std::to_string(at));
        const std::string name = kind + std::to_string(at);
        std::int64_t calls = 0;
        const Ended end = makeFaultyRun(name, kind, at, calls);
        EXPECT_TRUE(end.code == 0 || end.isStopped()) << end.code << ": " << end.output;
        if (end.isStopped()) {
            ++stopped_;
            EXPECT_THAT(end.output, HasSubstr(scratch_.path().string())) << "no path";
            const std::string error = kind == "full" ? "ENOSPC" : kind;
            // One failed call may be tried again, and the journal be looked for that it did not make.
            EXPECT_THAT(end.output,
                        AnyOf(HasSubstr(error), HasSubstr(textOfError(kind)),
                              HasSubstr(kind == "full" ? "ENOSPC" : "unable to open database file")));
            expectNoBlame(name);
            const Ended again = makeRun(name, results::wasBegun(folder(name)));
            EXPECT_EQ(again.code, 0) << again.output;
        }
        expectUndisturbed(name);
        EXPECT_TRUE(fs::is_empty(temporary())) << "scratch files are left";
        fs::remove_all(folder(name));
    }

    static std::string textOfError(const std::string& kind) {
        if (kind == "EIO") return "Input/output error";
        if (kind == "EINTR") return "Interrupted system call";
        return "No space left on device";
    }

    void checkKind(const std::string& kind, std::int64_t most = kFaultsOfKind) {
        std::int64_t calls = 0;
        ASSERT_EQ(makeFaultyRun("counted", kind, 0, calls).code, 0);
        fs::remove_all(folder("counted"));
        ASSERT_GT(calls, process_.empty() ? 100 : 3);
        const std::int64_t faults = std::min<std::int64_t>(calls, most);
        for (std::int64_t i = 0; i < faults; ++i) checkFault(kind, 1 + i * calls / faults);
        std::printf("%s%s%s: %lld calls, %lld faults, %d runs stopped\n", process_.c_str(),
                    process_.empty() ? "" : " ", kind.c_str(), static_cast<long long>(calls),
                    static_cast<long long>(faults), stopped_);
        const bool mustStop = kind == "ENOSPC" || kind == "EIO" || kind == "full";
        EXPECT_GT(stopped_, mustStop ? faults / 2 : -1);
    }

    results::Run whole_;
    int stopped_ = 0;
    std::string process_;  ///< first argument of the processes whose calls fail; "": of all
};

TEST_F(DiskFaults, NoSpaceAtOneCall) {
    checkKind("ENOSPC");
}
/// Most calls are those of the store. The children of each kind have few, and each of these fails once.
TEST_F(DiskFaults, NoSpaceAtOneCallOfAChild) {
    for (const char* process : {"__case", "__audit", "__describe", "__reference"}) {
        process_ = process;
        stopped_ = 0;
        checkKind("ENOSPC", 12);
    }
}
TEST_F(DiskFaults, NoSpaceFromOneCallOn) {
    checkKind("full");
}
TEST_F(DiskFaults, AnErrorOfTheDevice) {
    checkKind("EIO");
}
TEST_F(DiskFaults, AnInterruptedCall) {
    checkKind("EINTR");
}
TEST_F(DiskFaults, AShortWrite) {
    checkKind("short");
}

}  // namespace
}  // namespace rigor::validation
