// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/answer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/results/store.hpp"
#include "validation/results/tests/sample_run.hpp"

namespace rigor::validation {
namespace {

/// Nothing changes through JSON text and back: the stored form of both is the same to the last bit.
TEST(Answer, CasesSurviveTheJourney) {
    const results::CaseRow sent = results::sample::caseRow("a", 3);
    const results::CaseRow received = caseFromJson(nlohmann::json::parse(caseToJson(sent).dump()));
    EXPECT_EQ(caseToJson(sent).dump(), caseToJson(received).dump());
    EXPECT_EQ(std::tie(sent.id, sent.position, sent.scenario, sent.spec, sent.engine, sent.preset, sent.dt,
                       sent.outcome, sent.verdict, sent.reason, sent.wallSeconds, sent.cpuSeconds, sent.steps,
                       sent.peakMemoryKiB, sent.stateHash, sent.trajectoryFile, sent.command, sent.settings),
              std::tie(received.id, received.position, received.scenario, received.spec, received.engine,
                       received.preset, received.dt, received.outcome, received.verdict, received.reason,
                       received.wallSeconds, received.cpuSeconds, received.steps, received.peakMemoryKiB,
                       received.stateHash, received.trajectoryFile, received.command, received.settings));
    EXPECT_EQ(received.metrics[0].value, 0.1 + 0.2);
    EXPECT_TRUE(std::isnan(received.metrics[1].value));
    EXPECT_EQ(received.metrics[2].value, results::sample::kInf);
    EXPECT_EQ(received.metrics[2].expectation, results::sample::kDenormal);
    EXPECT_FALSE(received.metrics[1].bound.has_value());
    EXPECT_EQ(received.metrics[0].verdict, results::Verdict::KnownDeviation);
    EXPECT_TRUE(std::signbit(*received.audit[0].depthErrorMedian));
    EXPECT_FALSE(received.audit[0].normalErrorMedian.has_value());
    EXPECT_EQ(received.audit[0].worst, "block|floor");
    EXPECT_EQ(received.metrics[0].orderMax, results::sample::kInf);
    EXPECT_EQ(received.metrics[0].orderCount, 5);
    EXPECT_FALSE(received.metrics[1].orderCount.has_value());
    EXPECT_EQ(received.orders.worst, results::Grade::E);
    EXPECT_EQ(received.readBack[0].found, std::nextafter(2.0, 3.0));
    EXPECT_EQ(received.timings[0].samples, 360);
    EXPECT_EQ(received.timings[0].low, 0.1 + 0.2);
    EXPECT_EQ(received.timings[0].high, results::sample::kDenormal);
    EXPECT_EQ(received.timings[0].bodies, 7);
    EXPECT_FALSE(received.timings[1].low.has_value());
    EXPECT_FALSE(received.quantities[0].measured.has_value());
    EXPECT_EQ(received.ledger[0].reason, "the library has no other");
}

TEST(Answer, HalfAFileIsNone) {
    const results::sample::TemporaryFolder folder;
    const auto file = folder.path() / "answer.json";
    EXPECT_FALSE(readJsonFile(file).has_value());
    writeJsonFile(file, caseToJson(results::sample::caseRow("a", 0)));
    EXPECT_TRUE(readJsonFile(file).has_value());
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_FALSE(readJsonFile(file).has_value());
}

/// The output of a library need not be UTF-8.
TEST(Answer, AnyBytesCanBeSent) {
    const results::sample::TemporaryFolder folder;
    results::CaseRow row = results::sample::caseRow("a", 0);
    row.reason = "\xff\xfe broken \x80";
    writeJsonFile(folder.path() / "a.json", caseToJson(row));
    EXPECT_TRUE(readJsonFile(folder.path() / "a.json").has_value());
}

}  // namespace
}  // namespace rigor::validation
