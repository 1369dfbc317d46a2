// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests with one fault each go through a whole run: every one is one row that says what became of it, and the others
// are not held up by it.
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>

#include "validation/runner/judge.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Outcome;
using testing::HasSubstr;

struct GuestFault {
    const char* name;
    Outcome outcome;
    const char* reason;  ///< part of the row's reason
};

const GuestFault kGuestFaults[] = {
    {"exit", Outcome::Crashed, "the guest gives up"},
    {"killed", Outcome::Crashed, "SIGKILL"},
    {"truncated", Outcome::Crashed, "within a frame"},
    {"silent", Outcome::Timeout, "no answer within 1 s"},
    {"endless_log", Outcome::Timeout, "no answer within 1 s"},
    {"garbage", Outcome::Error, "Hello, world"},
    {"endless_text", Outcome::Error, "is no frame"},
    {"version", Outcome::Error, "version 2 of the protocol"},
    {"no_states", Outcome::Error, "the array 'states' is missing"},
    {"nan", Outcome::NonFinite, "ball"},
    {"memory", Outcome::OutOfMemory, "MiB in memory"},
    {"refuse", Outcome::Unsupported, "spheres that fly"},
};

class GuestFaults : public fixtures::RunnerTest {
  protected:
    void SetUp() override {
        namespace fs = std::filesystem;
        folder_ = scratch_.path() / "guests";
        fs::create_directory(folder_);
        const char* host = "rigor_guest_host.so";
        fs::create_symlink(fixtures::buildFolder() / "bin/adapters" / host, folder_ / host);
        setenv("RIGOR_ADAPTER_PATH", folder_.c_str(), 1);
    }
    std::string add(const std::string& fault) const {
        const std::string name = "faulty_" + fault,
                          guests = std::string(RIGOR_SOURCE_DIR) + "/adapters/guest/";
        std::ofstream(folder_ / ("rigor_adapter_" + name + ".json"))
            << R"({"rigor_guest": 1, "protocol": 1, "precision": "f64", "reply_seconds": )"
            << (fault == "memory" ? 60 : 1) << R"(, "memory": "resident", "name": ")" << name
            << R"(", "command": ["python3", ")" << guests << R"(tests/faulty_guest.py", ")" << guests
            << R"(sdk", ")" << fault << R"(", ")" << name << R"("]})";
        return name;
    }
    std::filesystem::path folder_;
};

TEST_F(GuestFaults, AreOneRowEach) {
    std::string specs = add("none") + ":preset=matched";
    for (const GuestFault& fault : kGuestFaults) specs += "," + add(fault.name) + ":preset=matched";
    auto o = options();
    o.memoryLimitMiB = 400;
    o.jobs = 2;
    const auto start = std::chrono::steady_clock::now();
    const auto done = run(fixtures::plan({fixtures::thrownBall("guests")}, specs), o);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(100));
    ASSERT_EQ(done.cases.size(), 1 + std::size(kGuestFaults));
    for (const CaseRow& row : done.cases) {
        SCOPED_TRACE(row.spec + ": " + row.reason);
        if (row.engine == "faulty_none") {
            EXPECT_EQ(row.outcome, Outcome::Completed);
            ASSERT_FALSE(row.timings.empty());
            EXPECT_LT(row.timings[0].median, 1e-3) << "the guest's own clock around a step that does nothing";
            continue;
        }
        for (const GuestFault& fault : kGuestFaults) {
            if (row.engine != std::string("faulty_") + fault.name) continue;
            EXPECT_EQ(row.outcome, fault.outcome);
            EXPECT_THAT(row.reason, HasSubstr(fault.reason));
            EXPECT_EQ(results::isRed(row), fault.outcome != Outcome::Unsupported);
        }
    }
}

}  // namespace
}  // namespace rigor::validation
