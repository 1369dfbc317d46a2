// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor sweep` on a real Slurm: controller, node and munge on this machine, on the loopback interface alone. An array of
// eight shards, of which one is killed and another is requeued, and a dependent merge. The merged run must be the
// undisturbed one, row for row. A study in shards has the tables of the whole study. Debian: apt install slurm-wlm munge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>

#include "cli/tests/program.hpp"
#include "cli/tests/shared_study.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/runner/merge.hpp"
#include "validation/runner/scratch_folder.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kControllerPort = 26817, kNodePort = 26818;
constexpr int kShards = 8;

std::string configuration(const fs::path& folder) {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    const std::string name = std::string(host).substr(0, std::string(host).find('.')), at = folder.string();
    return "ClusterName=test\nSlurmctldHost=" + name +
           "(127.0.0.1)\nAuthType=auth/munge\nAuthInfo=socket=" + at +
           "/munge.socket\nCommunicationParameters=NoCtldInAddrAny,NoInAddrAny\nSlurmUser=root\nSlurmdUser="
           "root\n"
           "SlurmctldPort=" +
           std::to_string(kControllerPort) + "\nSlurmdPort=" + std::to_string(kNodePort) +
           "\nStateSaveLocation=" + at + "/state\nSlurmdSpoolDir=" + at + "/spool\nSlurmctldPidFile=" + at +
           "/slurmctld.pid\nSlurmdPidFile=" + at +
           "/slurmd.pid\nProctrackType=proctrack/linuxproc\n"
           "TaskPlugin=task/none\nSchedulerParameters=batch_sched_delay=1\nSelectType=select/cons_tres\n"
           "SelectTypeParameters=CR_CPU\nReturnToService=2\nKillWait=5\nMpiDefault=none\nNodeName=" +
           name + " NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\nPartitionName=main Nodes=" + name +
           " Default=YES MaxTime=INFINITE State=UP\n";
}

/// Slurm in processes of this test.
class Slurm {
  public:
    explicit Slurm(const fs::path& folder) : folder_(folder) {
        fs::create_directories(folder / "state");
        fs::create_directories(folder / "spool");
        std::ofstream(folder / "slurm.conf") << configuration(folder);
        std::ofstream(folder / "munge.key") << std::string(1024, 'k');
        fs::permissions(folder / "munge.key", fs::perms::owner_read | fs::perms::owner_write);
        setenv("SLURM_CONF", (folder / "slurm.conf").c_str(), 1);
        const std::string at = folder.string();
        start({"munged", "--foreground", "--force", "--key-file=" + at + "/munge.key",
               "--socket=" + at + "/munge.socket", "--pid-file=" + at + "/munged.pid",
               "--log-file=" + at + "/munged.log", "--seed-file=" + at + "/seed"});
        start({"slurmctld", "-D"});
        start({"slurmd", "-D"});
    }
    ~Slurm() {
        for (auto it = daemons_.rbegin(); it != daemons_.rend(); ++it) {
            kill(*it, SIGTERM);
            waitpid(*it, nullptr, 0);
        }
        unsetenv("SLURM_CONF");
    }

  private:
    void start(const std::vector<std::string>& words) {
        const pid_t child = fork();
        if (child == 0) {
            const fs::path log = folder_ / (words[0] + ".out");
            if (freopen(log.c_str(), "w", stderr) == nullptr || freopen(log.c_str(), "a", stdout) == nullptr)
                _exit(1);
            std::vector<char*> arguments;
            for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
            arguments.push_back(nullptr);
            execvp(arguments[0], arguments.data());
            _exit(127);
        }
        daemons_.push_back(child);
    }
    fs::path folder_;
    std::vector<pid_t> daemons_;
};

std::string output(const std::string& command) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    pclose(pipe);
    return text;
}

bool happens(const std::function<bool()>& event, int seconds) {
    for (int i = 0; i < 50 * seconds; ++i) {
        if (event()) return true;
        usleep(20000);
    }
    return false;
}

/// A cluster of this machine alone, and folders for its shards.
class Sweep : public testing::Test {
  protected:
    void SetUp() override {
        if (geteuid() != 0 || !output("which slurmctld slurmd sbatch munged").ends_with("munged\n"))
            GTEST_SKIP() << "needs root, and slurmctld, slurmd, sbatch and munged (Debian: slurm-wlm, munge)";
        for (const fs::path& folder : {local, temporary}) fs::create_directories(folder);
        setenv("RIGOR_LOCAL", local.c_str(), 1);
        setenv("TMPDIR", temporary.c_str(), 1);  // The processes of this test are recognised by it.
        slurm_.emplace(scratch_.path() / "slurm");
        ASSERT_TRUE(happens([] { return output("sinfo -h -o %T").starts_with("idle"); }, 30))
            << output("sinfo");
    }
    void TearDown() override {
        unsetenv("RIGOR_LOCAL");
        unsetenv("TMPDIR");
    }
    static bool ends() {
        return happens([] { return output("squeue -h").empty(); }, 600);
    }
    /// Number of a shard, `first` or a later one, that has begun to store cases; "": none.
    std::string shardAtWork(int first) const {
        for (int k = first; k <= kShards; ++k)
            for (const auto& entry : fs::directory_iterator(local))
                if (entry.path().filename().string().starts_with("rigor-sweep-" + std::to_string(k) + "-") &&
                    fs::exists(entry.path() / "run" / "results.sqlite"))
                    return std::to_string(k);
        return "";
    }
    std::string in(const std::string& name) const { return (scratch_.path() / name).string(); }

  private:
    const validation::ScratchFolder scratch_;

  protected:
    const fs::path sweep = scratch_.path() / "sweep", local = scratch_.path() / "local",
                   temporary = scratch_.path() / "tmp";

  private:
    std::optional<Slurm> slurm_;
};

TEST_F(Sweep, WithDisturbancesIsTheUndisturbedRun) {
    const std::string what = "smoke --engines rigor,bullet";
    const auto submitted = rigor("sweep --shards " + std::to_string(kShards) + " --out " + sweep.string() +
                                 " --slurm --submit " + what);
    ASSERT_EQ(submitted.code, 0) << submitted.out;

    // One shard loses a process; another is sent back into the queue.
    const auto isRunning = [](const std::string& task) {
        return output("squeue -h -r -t RUNNING -o %K").find(task + "\n") != std::string::npos;
    };
    ASSERT_TRUE(happens([&] { return isRunning("1") || isRunning("2"); }, 60)) << output("squeue");
    EXPECT_TRUE(happens(
        [&] { return output("pkill -KILL -c -f '__case " + temporary.string() + "'") != "0\n"; }, 20));
    std::string number;
    ASSERT_TRUE(happens([&] { return !(number = shardAtWork(4)).empty(); }, 300)) << output("squeue");
    const std::string job =
        output("squeue -h -r -o '%A %K' | awk '$2 == " + number + " { print $1 }' | tr -d '\\n'");
    EXPECT_EQ(output("scontrol requeue " + job), "");
    EXPECT_THAT(output("scontrol show job " + job), HasSubstr("Restarts=1"));
    ASSERT_TRUE(ends()) << output("squeue");

    const auto whole = rigor("validate smoke --engines rigor,bullet -q --out " + in("whole"));
    EXPECT_THAT(whole.code, testing::AnyOf(0, 1, 6)) << whole.out;
    const auto merged = results::readRun(sweep / "run"), expected = results::readRun(in("whole"));
    EXPECT_FALSE(merged.finished.empty());
    ASSERT_EQ(merged.cases.size(), expected.cases.size());
    for (std::size_t i = 0; i < expected.cases.size(); ++i)
        EXPECT_EQ(validation::differenceOfCases(merged.cases[i], expected.cases[i]), "")
            << expected.cases[i].id;
    EXPECT_TRUE(fs::is_empty(local)) << "shards are moved when they are whole";
    EXPECT_TRUE(fs::exists(sweep / "run" / "index.html"));
}

TEST_F(Sweep, OfAStudyHasItsTables) {
    const std::string study = in("shared.json");
    std::ofstream(study) << kSharedStudy;
    const auto submitted =
        rigor("sweep --shards 3 --out " + sweep.string() + " --study --slurm --submit " + study);
    ASSERT_EQ(submitted.code, 0) << submitted.out;
    ASSERT_TRUE(ends()) << output("squeue");
    EXPECT_EQ(rigor("study " + study + " -q --out " + in("whole")).code, 0);
    const std::string tables = results::readFile(sweep / "run" / "study.json");
    ASSERT_NE(tables, "");
    EXPECT_EQ(timeless(tables), timeless(results::readFile(in("whole/study.json"))));
}

}  // namespace
}  // namespace rigor::cli_test
