// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines that abort, hang or leave the numbers: the instance says so, and its caller goes on.
#include "validation/live/instance_process.hpp"

#include <gmock/gmock.h>

#include "validation/live/tests/live_fixtures.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using Kind = InstanceProcess::Answer::Kind;

class Processes : public testing::Test {
  protected:
    static InstanceProcess::Answer load(InstanceProcess& instance, const std::string& spec) {
        return instance.send(
            {{"command", "load"}, {"text", fixtures::slidingBlock()}, {"spec", spec}, {"dt", 1.0 / 120}}, 20);
    }
    static json advance(int steps) { return {{"command", "advance"}, {"steps", steps}, {"seconds", 100.0}}; }
    static std::string program() {
        fixtures::useEngines();  // the child inherits it
        return fixtures::childProgram();
    }
    InstanceProcess instance_{program(), 4096};
};

TEST_F(Processes, LoadAndAdvance) {
    const auto loaded = load(instance_, "rigor");
    ASSERT_EQ(loaded.kind, Kind::Done) << loaded.message;
    EXPECT_TRUE(loaded.packet.header["instance"]["has_stages"].get<bool>());
    EXPECT_TRUE(loaded.packet.header["instance"]["settings"].contains("solver"));
    const auto moved = instance_.send(advance(12), 20);
    ASSERT_EQ(moved.kind, Kind::Done);
    EXPECT_EQ(moved.packet.header["step"], 12);
    EXPECT_GT(moved.packet.header["step_seconds"].get<double>(), 0.0);
    const auto back = instance_.send({{"command", "go_to"}, {"step", 5}}, 20);
    ASSERT_EQ(back.kind, Kind::Done) << back.message;
    EXPECT_EQ(back.packet.header["step"], 5);
    EXPECT_FALSE(back.packet.header.contains("step_seconds")) << "the time of steps that were taken back";
}

TEST_F(Processes, RefusalsAreNoEnd) {
    EXPECT_EQ(instance_.send(advance(1), 20).kind, Kind::Refused) << "nothing is loaded";
    const auto unknown = load(instance_, "rigor:solver=hope");
    EXPECT_EQ(unknown.kind, Kind::Refused);
    EXPECT_EQ(unknown.error, "bad_input");
    EXPECT_THAT(unknown.message, testing::HasSubstr("hope"));
    EXPECT_EQ(load(instance_, "rigor").kind, Kind::Done);
    EXPECT_EQ(instance_.send({{"command", "dance"}}, 20).kind, Kind::Refused);
    EXPECT_EQ(
        instance_.send({{"command", "drag"}, {"body", 0}, {"point", {0, 0, 0}}, {"target", {0, 0, 0}}}, 20)
            .kind,
        Kind::Refused);
    EXPECT_EQ(instance_.send(advance(1), 20).kind, Kind::Done);
}

TEST_F(Processes, AnAbortIsReportedBySignalAndLastWords) {
    ASSERT_EQ(load(instance_, "double_abort").kind, Kind::Done);
    const auto crash = instance_.send(advance(20), 20);
    EXPECT_EQ(crash.kind, Kind::Crashed);
    EXPECT_THAT(crash.message, testing::HasSubstr("SIGABRT"));
    EXPECT_EQ(instance_.send(advance(1), 20).kind, Kind::Crashed) << "and stays gone";
}

TEST_F(Processes, AHangIsEndedAtItsDeadline) {
    ASSERT_EQ(load(instance_, "double_hang").kind, Kind::Done);
    const auto begin = std::chrono::steady_clock::now();
    const auto hang = instance_.send(advance(20), 0.3);
    EXPECT_EQ(hang.kind, Kind::TimedOut);
    EXPECT_THAT(hang.message, testing::HasSubstr("0.3 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Processes, CanBeKilledWhileItWorks) {
    ASSERT_EQ(load(instance_, "double_hang").kind, Kind::Done);
    std::thread killer([this] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        instance_.kill();
    });
    EXPECT_EQ(instance_.send(advance(20), 60).kind, Kind::Crashed);
    killer.join();
}

}  // namespace
}  // namespace rigor::validation
