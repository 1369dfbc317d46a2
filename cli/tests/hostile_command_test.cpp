// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Messages and exit codes for files and modules that mean harm, and for an output that cannot be written.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "cli/tests/program.hpp"

namespace rigor::cli_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string hostileFile(const std::string& name, const std::string& extra) {
    const std::string file = testing::TempDir() + name;
    std::ofstream(file)
        << R"({"rigor": 1, "name": "hostile", "title": "t", "dimension": 3, "gravity": [0, -9.81, 0],
  "duration": 0.2, "dt": [0.01], "materials": {"wood": {"friction": 0.5, "restitution": 0}},
  "bodies": [{"name": "ball", "shapes": [{"sphere": {"radius": 1}}]}])"
        << extra << "}";
    return "'" + file + "'";
}

/// Standard output goes to a device that takes nothing; standard error is read.
Result intoFullDevice(const std::string& arguments) {
    const std::string file = testing::TempDir() + "errors";
    Result result =
        rigor(arguments + " >/dev/full 2>'" + file + "'; code=$?; cat '" + file + "'; exit $code");
    return result;
}

TEST(HostileCommands, AFullOutputIsAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    for (const char* command : {"list engines --json", "check --json free_flight", "list scenarios", "--help",
                                "run free_flight --json --dt 1/60"}) {
        const Result result = intoFullDevice(command);
        EXPECT_EQ(result.code, 7) << command;
        EXPECT_THAT(result.out, HasSubstr("rigor: standard output: cannot be written")) << command;
    }
}

/// A disk that is full from one call on, before and after the store has its tables: the command of the message works.
TEST(HostileCommands, AfterAFullDiskTheCommandOfTheMessageGoesOn) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "a sanitizer's own library must be the first that is loaded";
#endif
    const std::string folder = testing::TempDir() + "full_disk", counter = testing::TempDir() + "counter";
    for (const int call : {3, 30, 100}) {
        std::filesystem::remove_all(folder);
        std::ofstream(counter) << std::string(8, '\0');
        const Result stopped = rigor(
            "validate free_flight --engines ode -q --no-audit --out '" + folder + "'", true,
            "LD_PRELOAD=" RIGOR_BINARY_DIR "/tests/faulty_disk.so RIGOR_FAULT_KIND=full RIGOR_FAULT_AT=" +
                std::to_string(call) + " RIGOR_FAULT_COUNTER='" + counter + "' RIGOR_FAULT_UNDER='" + folder +
                "'");
        EXPECT_EQ(stopped.code, 7) << stopped.out;
        const std::string before = "Go on with: ./rigor ";
        const auto at = stopped.out.find(before);
        ASSERT_NE(at, std::string::npos) << stopped.out;
        const std::string again =
            stopped.out.substr(at + before.size(), stopped.out.find('\n', at) - at - before.size());
        const Result end = rigor(again);
        EXPECT_EQ(end.code, 0) << again << ": " << end.out;
    }
}

TEST(HostileCommands, ANulInAKeyIsOneProblemAmongOthers) {
    const Result result = rigor("check " + hostileFile("nul.json", R"(, "a\u0000b": 1)") + " " +
                                hostileFile("type.json", R"(, "tags": 3)") + " free_flight");
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("/a\\x00b: found the control character U+0000 in a key"));
    EXPECT_THAT(result.out, HasSubstr("/tags: found number 3"));
    EXPECT_THAT(result.out, HasSubstr("free_flight: ok"));
}

TEST(HostileCommands, NoMessageSteersTheTerminal) {
    for (const std::string& arguments :
         {"check " + hostileFile("escape.json", ", \"\\u001b[31mred\": 1"),
          "check " + hostileFile("raw.json", ", \"\x1b[31mred\": 1"),
          std::string("check '/no/such/\x1b[31mfile.json'"), std::string("run '\x1b[31mfile' --engine rigor"),
          std::string("run free_flight --engine '\x1b[31mengine'"), std::string("report '\x1b[31mfolder'"),
          std::string("list '\x1b[31mwhat'"), std::string("check --'\x1b[31moption'")}) {
        const Result result = rigor(arguments);
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_THAT(result.out, Not(HasSubstr("\x1b"))) << arguments;
    }
}

TEST(HostileCommands, AnEngineThatSleepsIsEndedAfterItsTimeLimit) {
    const std::string doubles = "RIGOR_ADAPTER_PATH=" RIGOR_BINARY_DIR "/tests/doubles";
    const std::string sleeper = hostileFile("sleeper.json", "") +
                                " --engine double_free_flight:pause_us=1000000 --set time_limit=0.1";
    for (const std::string& arguments :
         {"run " + sleeper + " --reference-limit 0.5", "draw " + sleeper + " --at 0.2 --out -"}) {
        const auto start = std::chrono::steady_clock::now();
        const Result result = rigor(arguments, true, doubles);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        EXPECT_EQ(result.code, 5) << arguments << ": " << result.out;
        EXPECT_THAT(result.out, HasSubstr("no end within its time limit")) << arguments;
        EXPECT_LT(seconds, 15.0) << arguments << ": its 20 steps sleep for a second each";
    }
}

TEST(HostileCommands, AReaderMayTakeItsTime) {
    // More than a pipe holds, from a run whose time limit, with the two seconds of one that is blocked, is three seconds.
    const std::string doubles = "RIGOR_ADAPTER_PATH=" RIGOR_BINARY_DIR "/tests/doubles";
    const Result result = rigor("run " + hostileFile("written.json", "") +
                                    " --engine double_free_flight --dt 1e-4 --set time_limit=0.1 "
                                    "--reference-limit 0.5 --csv - 2>&1 | (sleep 6; wc -l)",
                                false, doubles);
    EXPECT_EQ(std::stoi(result.out), 1 + 2001) << "a heading, the start and 2000 steps";
}

TEST(HostileCommands, AModuleThatFitsNothingIsARedRow) {
    const std::string doubles = "RIGOR_ADAPTER_PATH=" RIGOR_BINARY_DIR "/tests/doubles";
    const std::string file = hostileFile("good.json", "");
    const Result contact = rigor("run " + file + " --engine double_hostile:fault=contact", true, doubles);
    EXPECT_EQ(contact.code, 1) << contact.out;
    EXPECT_THAT(contact.out, HasSubstr("contact 0 of a step names body 1000000, expected 0 to 0"));
    const Result text = rigor("run " + file + " --engine double_hostile:fault=long_exception", true, doubles);
    EXPECT_EQ(text.code, 1);
    EXPECT_LT(text.out.size(), 6000u);
    EXPECT_THAT(text.out, Not(HasSubstr("\x1b")));
    const Result refusal =
        rigor("run " + file + " --engine double_hostile:fault=long_refusal", true, doubles);
    EXPECT_EQ(refusal.code, 4);
    EXPECT_LT(refusal.out.size(), 6000u);
}

}  // namespace
}  // namespace rigor::cli_test
