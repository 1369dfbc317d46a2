// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/numbers.hpp"
#include "validation/results/files.hpp"
#include "validation/runner/shell_word.hpp"

namespace rigor::cli {
namespace {

namespace fs = std::filesystem;
using validation::shellWord;

struct SweepArguments {
    std::vector<std::string> plan, slurmOptions;  ///< `plan`: what is run, with options of the command
    std::string out;
    int shards = 1;
    bool isStudy = false, slurm = false, exclusive = false, submit = false;

    std::string command() const { return isStudy ? "study" : "validate"; }
};

/// The share of the cores that GNU parallel may fill with shards, each of which uses as many cores as it has jobs.
std::string parallelShards(const SweepArguments& a) {
    int jobs = 1;
    for (std::size_t i = 0; i < a.plan.size(); ++i) {
        const std::string& word = a.plan[i];
        const bool isLast = i + 1 == a.plan.size();
        std::string number;
        if (word == "-j" || word == "--jobs")
            number = isLast ? "" : a.plan[i + 1];
        else if (word.starts_with("--jobs="))
            number = word.substr(7);
        else if (word.starts_with("-j"))
            number = word.substr(2);
        std::from_chars(number.data(), number.data() + number.size(), jobs);
    }
    return std::to_string(100 / std::clamp(jobs, 1, 100)) + "%";
}

/// Directives of Slurm; for the shell they are comments.
std::string directives(const SweepArguments& a, const fs::path& out, const std::string& kind) {
    std::string text =
        "#SBATCH --job-name=rigor-" + kind + "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n";
    const std::string log = kind == "shard" ? "shard-%a.log" : "merge.log";
    text += "#SBATCH --output=" + (out / "logs" / log).string() + "\n";
    if (kind == "shard") {
        text += "#SBATCH --array=1-" + std::to_string(a.shards) + "\n#SBATCH --signal=B:TERM@120\n";
        if (a.exclusive) text += "#SBATCH --exclusive\n";
    }
    for (const std::string& option : a.slurmOptions) text += "#SBATCH " + option + "\n";
    return text;
}

/// One shard, on the disk of its node. An interrupted one is kept in the shared folder and goes on from there.
constexpr const char* kShardBody = R"sh(
k=${1:-${SLURM_ARRAY_TASK_ID:?the number of the shard is the first argument}}
whole=$out/shards/$k
[ -d "$whole" ] && exit 0
local=${RIGOR_LOCAL:-${TMPDIR:-/tmp}}
work=$(mktemp -d "$local/rigor-sweep-$k-XXXXXX") || exit 7
run=$work/run
resume=
child=

# Copies the run into the shared folder, under a name of its own until it is complete there.
save() {
    rm -rf "$1.new" && cp -r "$run" "$1.new" && rm -rf "$1" && mv "$1.new" "$1"
}
leave() {
    rm -rf "$work"
    exit "$1"
}
stop() {
    [ -n "$child" ] && kill -TERM "$child" 2>/dev/null && wait "$child"
    [ -f "$run/results.sqlite" ] && save "$whole.part"
    leave 143
}
trap stop TERM INT

if [ -f "$whole.part/results.sqlite" ]; then
    cp -r "$whole.part" "$run" || leave 7
    resume=--resume
fi
run_plan --shard "$k/$n" --out "$run" --quiet $resume &
child=$!
wait "$child"
code=$?
child=
case $code in
0 | 1 | 6) save "$whole" && rm -rf "$whole.part" && leave 0 ;;
esac
[ -f "$run/results.sqlite" ] && save "$whole.part"
leave "$code"
)sh";

std::string commandLine(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shellWord(word);
    return line;
}

/// The command line of the whole plan, to which a script adds options.
std::string programWith(const SweepArguments& a) {
    return shellWord(ownBinary().string()) + " " + a.command() + " " + commandLine(a.plan);
}

std::string shardScript(const SweepArguments& a, const fs::path& out) {
    return "#!/bin/sh\n" + directives(a, out, "shard") +
           "# Runs one shard: `sh shard.sh K`, or as a task of a Slurm array. Done again, it does what is "
           "missing.\n"
           "out=" +
           shellWord(out.string()) + "\nn=" + std::to_string(a.shards) + "\nrun_plan() {\n    exec " +
           programWith(a) + " \"$@\"\n}\n" + kShardBody;
}

/// Makes the tables of a study once the run is whole. What was red in the merge alone is judged by the study.
std::string evaluation(const SweepArguments& a, const fs::path& out) {
    if (!a.isStudy) return "";
    return "code=$?\ncase $code in 0 | 1 | 4 | 6) ;; *) exit $code ;; esac\n"
           "for option; do [ \"$option\" = --partial ] && exit $code; done\ncd \"$start\" || exit 7\nexec " +
           programWith(a) + " --resume --quiet --out " + shellWord((out / "run").string()) + "\n";
}

std::string mergeScript(const SweepArguments& a, const fs::path& out) {
    const std::string folder = shellWord(out.string());
    return "#!/bin/sh\n" + directives(a, out, "merge") +
           "# Makes one run of the shards that are whole; `sh merge.sh --partial` of those that are there.\n"
           "start=$PWD\ncd " +
           folder + "/shards || exit 7\nset -- \"$@\" --out " + folder +
           "/run\nfor shard in *; do\n    case $shard in *.new) continue ;; esac\n    set -- \"$@\" " +
           folder + "/shards/\"$shard\"\ndone\n" + (a.isStudy ? "" : "exec ") +
           shellWord(ownBinary().string()) + " merge \"$@\"\n" + evaluation(a, out);
}

/// The first line that a command prints; throws EnvironmentError if it fails.
std::string outputOf(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    std::string line;
    for (int c = 0; pipe != nullptr && (c = std::fgetc(pipe)) != EOF && c != '\n';)
        line += static_cast<char>(c);
    if (pipe == nullptr || pclose(pipe) != 0) throw results::EnvironmentError("'" + command + "' failed");
    return line;
}

int sweep(const SweepArguments& a) {
    const fs::path out = fs::absolute(a.out);
    if (fs::exists(out / "shard.sh"))
        throw std::invalid_argument("--out: '" + a.out +
                                    "' holds a sweep already; its shard.sh goes on with it");
    if (a.plan.empty())
        throw std::invalid_argument(a.isStudy ? "sweep: found no study"
                                              : "sweep: found no scenario or suite");
    results::createFolders(out / "shards");
    results::createFolders(out / "logs");
    const fs::path shard = out / "shard.sh", merge = out / "merge.sh";
    results::replaceFile(shard, shardScript(a, out));
    results::replaceFile(merge, mergeScript(a, out));
    const std::string array = "sbatch --parsable " + shellWord(shard.string());
    const std::string dependent = "sbatch --parsable --dependency=afterany:";
    if (a.submit) {
        const std::string job = outputOf(array);
        const std::string merging = outputOf(dependent + shellWord(job) + " " + shellWord(merge.string()));
        std::printf("Submitted the array %s and the merge %s\n", job.c_str(), merging.c_str());
    } else if (a.slurm) {
        std::printf("job=$(%s)\n%s$job %s\n", array.c_str(), dependent.c_str(),
                    shellWord(merge.string()).c_str());
    } else {
        std::printf("seq %d | parallel -j %s sh %s {}\nsh %s\n", a.shards, parallelShards(a).c_str(),
                    shellWord(shard.string()).c_str(), shellWord(merge.string()).c_str());
    }
    return kOk;
}

}  // namespace

void addSweep(CLI::App& app, Action& action) {
    auto a = std::make_shared<SweepArguments>();
    auto* command = app.add_subcommand("sweep",
                                       "Write the scripts that run a plan in shards on many machines and "
                                       "merge them, and print how to start them");
    command->prefix_command();  // the first word that is no option of this command begins the plan
    command->add_option("--shards", a->shards, "Number of parts: each gets whole scenarios")
        ->required()
        ->check(between(1, 100000));
    command
        ->add_option("--out", a->out, "Folder that all machines share: scripts, logs, shards, the merged run")
        ->required();
    command->add_flag("--study", a->isStudy,
                      "WHAT is a study, with options of `rigor study`; the merge makes its tables");
    command->add_flag("--slurm", a->slurm, "For Slurm (default: for GNU parallel)");
    command->add_flag("--submit", a->submit, "Submit them to Slurm at once");
    command->add_flag("--exclusive", a->exclusive,
                      "Nothing else on a node while a shard runs there: for timings");
    command
        ->add_option("--sbatch", a->slurmOptions,
                     "Further option of sbatch for both scripts, as --time=2:00:00")
        ->allow_extra_args(false);
    command->footer(
        "Usage: rigor sweep --shards N --out DIR [OPTIONS] WHAT [options of `rigor validate`]\n"
        "       rigor sweep --shards N --out DIR --study [OPTIONS] STUDY [options of `rigor study`]\n"
        "RIGOR_LOCAL is the folder on a node in which shards run (default: TMPDIR). Shards are moved to the "
        "shared\n"
        "folder when they are whole; interrupted ones are kept there and go on.");
    command->callback([a, command, &action] {
        a->plan = command->remaining();
        action = [a] { return sweep(*a); };
    });
}

}  // namespace rigor::cli
