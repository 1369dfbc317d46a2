// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Instruction counts against recorded ones: a check of speed that noise cannot move. The work is small and
// the same on every run (counted_work.hpp); callgrind counts it alone, not the start of the program. So that
// neither processor nor surroundings matter, Highway's instruction set is fixed, the C library is limited to
// SSE4 (it picks its memory and mathematical functions by processor), and the environment is empty. The
// compiler and the libraries' own versions remain: the record is one file per compiler.
//
// Measured: two runs with different environments give the same counts to the last instruction.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace rigor::engine::test {
namespace {

using Counts = std::map<std::string, long long>;

constexpr double kTolerance = 0.02;
const std::filesystem::path kProgram = RIGOR_COUNTED_PROGRAM;
const std::filesystem::path kRecord =
    std::filesystem::path(RIGOR_SOURCE_DIR) / "engine/benchmarks/instruction_counts" / RIGOR_COMPILER ".txt";

/// Names of x86 features as glibc knows them (glibc 2.26 to 2.36 and since): unknown ones are ignored.
constexpr const char* kPlainLibrary =
    "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX,-AVX2,-AVX_Usable,-AVX2_Usable,-AVX512F,-AVX512VL,-AVX512BW,-FMA,-"
    "FMA4,"
    "-FMA_Usable,-FMA4_Usable,-BMI1,-BMI2,-LZCNT,-MOVBE,-RTM,-ERMS,-FSRM,-AVX_Fast_Unaligned_Load,-XSAVEC";

/// Command line of callgrind for the counted work whose name begins with `prefix`, `options` before it.
std::string callgrind(const std::string& options, const std::string& prefix, const std::string& more = "") {
    return "env -i PATH=\"$PATH\" LC_ALL=C " + std::string(kPlainLibrary) + " " + more +
           " valgrind --tool=callgrind " + options + " '" + kProgram.string() + "' " + prefix;
}

/// Valgrind decodes only what the processor it runs on has. Highway's library reads the clock by RDTSCP when
/// it is loaded, and some virtual processors do not offer that instruction.
bool valgrindDecodesTheProgram() {
    const std::string none = callgrind("--callgrind-out-file=/dev/null", "no_such_work");
    const std::string refused = none + " 2>&1 | grep -q 'Unrecognised instruction'";
    return std::system(refused.c_str()) != 0;
}

std::string whyNot() {
    if (std::string(RIGOR_BUILD_KIND) != "Release")
        return "counts are those of Release builds without sanitizers";
    if (std::system("command -v valgrind >/dev/null 2>&1") != 0)
        return "valgrind is not installed (Debian: apt-get install valgrind)";
    if (!valgrindDecodesTheProgram())
        return "valgrind does not decode an instruction of this processor's start of the program";
    return {};
}

std::vector<std::string> lines(const std::filesystem::path& file) {
    std::vector<std::string> all;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
}

long long totalOf(const std::filesystem::path& dump) {
    for (const std::string& line : lines(dump))
        if (line.starts_with("totals: ")) return std::stoll(line.substr(8));
    return -1;
}

/// Counts of all work whose name begins with `prefix`; with `more` in the environment.
Counts count(const std::string& prefix, const std::string& more = "") {
    const auto folder =
        std::filesystem::path(testing::TempDir()) / ("rigor_counts_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const auto in = [&](const char* name) { return (folder / name).string(); };
    const std::string command =
        callgrind("--toggle-collect=rigorCountedWork --dump-after=rigorCountedWork --callgrind-out-file='" +
                      in("dump") + "'",
                  prefix, more) +
        " >'" + in("names") + "' 2>'" + in("log") + "'";
    Counts counts;
    const bool ran = std::system(command.c_str()) == 0;
    const auto names = lines(in("names"));
    EXPECT_TRUE(ran && !names.empty()) << command;
    for (std::size_t i = 0; i < names.size(); ++i)
        counts[names[i]] = totalOf(in("dump") + "." + std::to_string(i + 1));
    if (!ran)
        for (const std::string& line : lines(in("log"))) std::printf("%s\n", line.c_str());
    std::filesystem::remove_all(folder);
    return counts;
}

Counts recorded() {
    Counts counts;
    for (const std::string& line : lines(kRecord)) {
        if (line.empty() || line.starts_with("#")) continue;
        const auto space = line.find(' ');
        counts[line.substr(space + 1)] = std::stoll(line.substr(0, space));
    }
    return counts;
}

void record(const Counts& counts) {
    std::filesystem::create_directories(kRecord.parent_path());
    std::ofstream out(kRecord);
    out << "# Instructions by work, " RIGOR_COMPILER
           ", Release; written by RIGOR_RENEW_COUNTS=1 "
           "engine_instruction_count_test\n";
    for (const auto& [name, instructions] : counts) out << instructions << ' ' << name << '\n';
    ASSERT_TRUE(out.flush()) << kRecord;
}

TEST(InstructionCounts, AreNotAboveTheRecord) {
    if (const std::string reason = whyNot(); !reason.empty()) GTEST_SKIP() << reason;
    const Counts now = count("");
    if (std::getenv("RIGOR_RENEW_COUNTS") != nullptr) {
        record(now);
        GTEST_SKIP() << "recorded: " << kRecord;
    }
    const Counts before = recorded();
    if (before.empty()) GTEST_SKIP() << "nothing is recorded for this compiler: " << kRecord;
    for (const auto& [name, instructions] : now) {
        const auto known = before.find(name);
        if (known == before.end()) {
            std::printf("not recorded yet: %lld %s\n", instructions, name.c_str());
            continue;
        }
        const double change = static_cast<double>(instructions) / static_cast<double>(known->second) - 1;
        EXPECT_LE(change, kTolerance) << name << ": " << known->second << " recorded, " << instructions
                                      << " now. Where that is meant: RIGOR_RENEW_COUNTS=1";
        if (change < -kTolerance) std::printf("%+.1f %%, to be renewed: %s\n", 100 * change, name.c_str());
    }
    for (const auto& [name, instructions] : before)
        EXPECT_TRUE(now.contains(name)) << name << " is recorded and no longer counted";
}

TEST(InstructionCounts, AreTheSameWhateverSurroundsThem) {
    if (const std::string reason = whyNot(); !reason.empty()) GTEST_SKIP() << reason;
    for (const char* work : {"step/default/pile", "broad_phase/dynamic_aabb_tree", "solver/block"}) {
        const Counts once = count(work),
                     again = count(work, "HOME=/nowhere PADDING=" + std::string(3000, 'x'));
        EXPECT_EQ(once, again) << work;
        for (const auto& [name, instructions] : once) EXPECT_GT(instructions, 10000) << name;
    }
}

}  // namespace
}  // namespace rigor::engine::test
