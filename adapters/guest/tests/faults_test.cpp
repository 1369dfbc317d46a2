// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests with one fault each: every one ends as one exception that names it, within its time.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>

#include "adapters/guest/tests/guest_files.hpp"
#include "adapters/interface/engine_failure.hpp"
#include "adapters/interface/guest.hpp"
#include "adapters/interface/prepared_engine.hpp"

namespace rigor::guest::tests {
namespace {

using adapter::EngineFailure;
using testing::HasSubstr;
using Kind = EngineFailure::Kind;

/// Loads, builds, reads back, makes ten steps and reads everything after each.
void drive(const GuestFolder&) {
    const scenario::Scenario s = ballOverGround();
    const auto prepared = adapter::prepareEngine(adapter::parseSpec("faulty"), s, 0.01);
    const auto world = prepared.build(s, 0.01);
    world->readBack();
    world->ledger();
    std::vector<adapter::ContactPoint> contacts;
    for (int i = 0; i < 10; ++i) {
        world->step();
        world->readContacts(contacts);
    }
}

struct Fault {
    const char* name;
    Kind kind;
    const char* text;  ///< part of the message
};
std::ostream& operator<<(std::ostream& out, const Fault& fault) {
    return out << fault.name;
}

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, EndAsOneFailureThatNamesThem) {
    const GuestFolder folder;
    folder.addFaulty(GetParam().name);
    const auto start = std::chrono::steady_clock::now();
    try {
        drive(folder);
        ADD_FAILURE() << "nothing was noticed";
    } catch (const EngineFailure& failure) {
        EXPECT_EQ(failure.kind(), GetParam().kind) << failure.what();
        EXPECT_THAT(failure.what(), HasSubstr("guest 'faulty'"));
        EXPECT_THAT(failure.what(), HasSubstr(GetParam().text));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(25));
}

INSTANTIATE_TEST_SUITE_P(
    Guest, Faults,
    testing::Values(Fault{"exit", Kind::Died, "exit code 3"}, Fault{"exit", Kind::Died, "the guest gives up"},
                    Fault{"killed", Kind::Died, "SIGKILL"}, Fault{"closed", Kind::Died, "closed its output"},
                    Fault{"silent", Kind::Silent, "no answer within 1 s"},
                    Fault{"garbage", Kind::Protocol, "it begins with 'Hello, world?'"},
                    Fault{"huge", Kind::Protocol, "more than a frame may have"},
                    Fault{"no_json", Kind::Protocol, "header is no JSON object"},
                    Fault{"truncated", Kind::Died, "within a frame, of which 23 bytes came"},
                    Fault{"endless_text", Kind::Protocol, "is no frame"},
                    Fault{"endless_log", Kind::Silent, "text without an end"},
                    Fault{"version", Kind::Protocol,
                          "speaks version 2 of the protocol, this program version 1"},
                    Fault{"no_engine", Kind::Protocol, "the key 'engine' is missing"},
                    Fault{"hello_exit", Kind::Died, "exit code 3"},
                    Fault{"hello_garbage", Kind::Protocol, "Hello, world"},
                    Fault{"unknown_capability", Kind::Protocol, "capabilities.teleportation"},
                    Fault{"wrong_id", Kind::Protocol, "expected"},
                    Fault{"no_states", Kind::Protocol, "the array 'states' is missing"},
                    Fault{"no_seconds", Kind::Protocol, "the key 'seconds' is missing"},
                    Fault{"few_states", Kind::Protocol, "states of 1 bodies, expected 2"},
                    Fault{"narrow_states", Kind::Protocol, "has 12 columns, expected 13"},
                    Fault{"error_without_code", Kind::Protocol, "without one of the codes"},
                    Fault{"contact_order", Kind::Protocol, "A is the one of lower index"},
                    Fault{"contact_index", Kind::Protocol, "contact, body B"},
                    Fault{"ledger_without_topic", Kind::Protocol, "topic"},
                    Fault{"realisation", Kind::Protocol, "found 'nearly'"},
                    Fault{"raise", Kind::Protocol, "there is no such thing"}),
    [](const auto& tested) { return std::string(tested.param.name) + "_" + std::to_string(tested.index); });

TEST(Guests, WithoutAFaultAreRunAndSayWhatTheyAre) {
    const GuestFolder folder;
    folder.addFaulty("none");
    EXPECT_NO_THROW(drive(folder));
    const auto engine = adapter::loadEngine(adapter::parseSpec("faulty"));
    EXPECT_EQ(engine->info().version, "1");
    EXPECT_EQ(engine->info().clock, "guest");
    EXPECT_TRUE(engine->capabilities().dynamics);
    EXPECT_EQ(engine->collision(), nullptr);
}

TEST(Guests, GiveNumbersThatAreNoneAsTheyAre) {
    const GuestFolder folder;
    folder.addFaulty("nan");
    const scenario::Scenario s = ballOverGround();
    const auto prepared = adapter::prepareEngine(adapter::parseSpec("faulty"), s, 0.01);
    const auto world = prepared.build(s, 0.01);
    for (int i = 0; i < 3; ++i) world->step();
    std::vector<adapter::BodyState> states(2);
    world->readStates(states);
    EXPECT_TRUE(std::isnan(states[1].position.y));
}

TEST(Guests, RefuseAsModulesDo) {
    const GuestFolder folder;
    folder.addFaulty("refuse_in_library");
    try {
        drive(folder);
        ADD_FAILURE() << "not refused";
    } catch (const adapter::Unsupported& refused) {
        EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInLibrary);
        EXPECT_EQ(refused.documentation(), "its manual, chapter 3");
        EXPECT_EQ(refused.lacking(), "shape 'sphere'");
    }
    folder.addFaulty("refuse");
    try {
        drive(folder);
        ADD_FAILURE() << "not refused";
    } catch (const adapter::Unsupported& refused) {
        EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInAdapter);
    }
    folder.addFaulty("bad_input");
    EXPECT_THROW(drive(folder), adapter::BadInput);
}

/// A guest that writes to its log without end has gigabytes to write before its time is over.
TEST(Guests, HaveABoundedLog) {
    const GuestFolder folder;
    folder.addFaulty("endless_log");
    const fs::path file = folder.path() / "log";
    const int log = open(file.c_str(), O_CREAT | O_WRONLY, 0600), before = dup(STDERR_FILENO);
    dup2(log, STDERR_FILENO);
    EXPECT_THROW(drive(folder), EngineFailure);
    dup2(before, STDERR_FILENO);
    close(before);
    close(log);
    EXPECT_GT(fs::file_size(file), 64u << 10);
    EXPECT_LT(fs::file_size(file), 65u << 10);
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_THAT(text, HasSubstr("[guest 'faulty': its log goes on"));
}

/// Every later request fails at once: nothing waits for a process that is dead.
TEST(Guests, ThatHaveDiedStayDead) {
    const GuestFolder folder;
    folder.addFaulty("silent");
    const scenario::Scenario s = ballOverGround();
    const auto prepared = adapter::prepareEngine(adapter::parseSpec("faulty"), s, 0.01);
    const auto world = prepared.build(s, 0.01);
    world->step();
    world->step();
    EXPECT_THROW(world->step(), EngineFailure);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THROW(world->step(), EngineFailure);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
}

TEST(Guests, ThatStayAfterTheEndOfTheirInputAreKilled) {
    const GuestFolder folder;
    folder.addFaulty("stays");
    const auto start = std::chrono::steady_clock::now();
    { const auto engine = adapter::loadEngine(adapter::parseSpec("faulty")); }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

/// Nothing is left of a process, or it is about to be collected.
bool hasEnded(int pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.empty() || text.find(") Z") != std::string::npos;
}

/// The process that uses the guest is killed and can do nothing about it.
TEST(Guests, EndWithTheProcessThatStartedThem) {
    const GuestFolder folder;
    folder.addFaulty("stays");
    const std::string file = (folder.path() / "pid").string();
    const pid_t user = fork();
    if (user == 0) {
        setenv("FAULTY_GUEST_PID", file.c_str(), 1);
        const auto engine = adapter::loadEngine(adapter::parseSpec("faulty"));
        pause();
        _exit(0);
    }
    const auto until = [](auto&& condition) {
        for (int i = 0; i < 1500 && !condition(); ++i) usleep(10000);
        return condition();
    };
    int guest = 0;
    ASSERT_TRUE(until([&] { return static_cast<bool>(std::ifstream(file) >> guest) && guest > 0; }));
    EXPECT_FALSE(hasEnded(guest));
    kill(user, SIGKILL);
    waitpid(user, nullptr, 0);
    EXPECT_TRUE(until([&] { return hasEnded(guest); }));
}

TEST(Manifests, SayWhatIsWrongWithThem) {
    const GuestFolder folder;
    const auto problem = [&](const std::string& rest) -> std::string {
        try {
            adapter::readGuestManifest(folder.add("faulty", rest));
        } catch (const adapter::BadInput& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(problem(R"("command": ["true"])"), "");
    EXPECT_THAT(problem(R"("command": [])"), HasSubstr("key 'command': found no program"));
    EXPECT_THAT(problem(R"("command": "true")"), HasSubstr("expected an array of texts"));
    EXPECT_THAT(problem(R"("command": ["true"], "memory": "much")"),
                HasSubstr("one of address_space, resident"));
    EXPECT_THAT(problem(R"("command": ["true"], "comand": ["true"])"), HasSubstr("did you mean 'command'?"));
    EXPECT_THAT(problem(R"("command": ["true"], "reply_seconds": 0)"), HasSubstr("seconds > 0"));
    EXPECT_THAT(problem("command"), HasSubstr("no JSON object"));
}

TEST(Manifests, OfGuestsThatAreNotInstalledAreListedApart) {
    const GuestFolder folder;
    folder.add("faulty",
               R"("command": ["true"], "needs": ["node_modules/x"], "install": "./rigor --with x")");
    folder.add("other", R"("command": ["a_program_that_is_not_there"])");
    const auto known = adapter::availableEngines();
    EXPECT_EQ(
        std::count(known.begin(), known.end(), "faulty") + std::count(known.begin(), known.end(), "other"),
        0);
    std::vector<std::string> absent;
    for (const auto& guest : adapter::absentGuests()) absent.push_back(guest.name);
    EXPECT_THAT(absent, testing::IsSupersetOf({"faulty", "other"}));
    try {
        (void)adapter::loadEngine(adapter::parseSpec("faulty"));
        ADD_FAILURE() << "loaded";
    } catch (const adapter::BadInput& error) {
        EXPECT_THAT(
            error.what(),
            HasSubstr("is not installed: 'node_modules/x' is missing; to install it: ./rigor --with x"));
    }
}

}  // namespace
}  // namespace rigor::guest::tests
