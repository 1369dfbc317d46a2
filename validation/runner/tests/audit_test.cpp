// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The audit against auditors of known faults: each fault shows in the number meant for it.
#include "validation/runner/audit.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using results::AuditRow;
using testing::HasSubstr;

class Audit : public fixtures::RunnerTest {
  protected:
    results::Run audited(const std::string& specs, const std::string& folder = "run") {
        auto o = options(folder);
        o.audit = true;
        return run(fixtures::plan({fixtures::crossingBalls()}, specs), o);
    }
    static const AuditRow& rowOf(const results::CaseRow& c, const std::string& auditor) {
        for (const auto& row : c.audit)
            if (row.auditor == auditor) return row;
        throw std::runtime_error("no auditor " + auditor);
    }
};

TEST_F(Audit, EveryAuditorAnswersAndEveryFaultIsFound) {
    const auto run = audited("double_free_flight:preset=default");
    ASSERT_EQ(run.cases.size(), 1u);
    const results::CaseRow& c = run.cases[0];

    const AuditRow& oracle = rowOf(c, "oracle");
    EXPECT_EQ(oracle.outcome, "completed");
    EXPECT_GE(oracle.frames, 10);
    EXPECT_GT(oracle.overlapping, 0);
    EXPECT_GT(oracle.queries, oracle.overlapping) << "some poses are apart: the ball over the floor";
    EXPECT_EQ(oracle.undecided, 0);

    const AuditRow& good = rowOf(c, "double_auditor");
    EXPECT_EQ(good.outcome, "completed");
    EXPECT_EQ(good.queries, oracle.queries);
    EXPECT_EQ(good.overlapping, oracle.overlapping);
    EXPECT_EQ(good.missed + good.spurious + good.undecided, 0);
    EXPECT_LT(good.normalErrorMax.value(), 1e-9);
    EXPECT_LT(good.depthErrorMax.value(), 1e-12);
    EXPECT_LT(good.pointErrorMax.value(), 1e-12);

    const AuditRow& flipped = rowOf(c, "double_auditor_flipped");
    EXPECT_NEAR(flipped.normalErrorMax.value(), std::numbers::pi, 1e-9);
    EXPECT_NEAR(flipped.normalErrorMedian.value(), std::numbers::pi, 1e-9);
    EXPECT_LT(flipped.depthErrorMax.value(), 1e-12) << "only the normals are wrong";
    EXPECT_THAT(flipped.worst, HasSubstr("(normal)"));

    const AuditRow& deep = rowOf(c, "double_auditor_deep");
    EXPECT_NEAR(deep.depthErrorMax.value(), 0.01, 1e-12);
    EXPECT_NEAR(deep.depthErrorMedian.value(), 0.01, 1e-12);
    EXPECT_NEAR(deep.pointErrorMax.value(), 0.01, 1e-12);
    EXPECT_LT(deep.normalErrorMax.value(), 1e-9);

    const AuditRow& blind = rowOf(c, "double_auditor_blind");
    EXPECT_EQ(blind.missed, oracle.overlapping);
    EXPECT_THAT(blind.worst, HasSubstr("(missed)"));

    const AuditRow& anxious = rowOf(c, "double_auditor_anxious");
    EXPECT_EQ(anxious.spurious, oracle.queries - oracle.overlapping);
    EXPECT_EQ(anxious.missed, 0);
}

TEST_F(Audit, AnAuditorThatCrashesCostsItsOwnRowOnly) {
    const auto run = audited("double_free_flight:preset=default,double_free_flight:preset=matched");
    ASSERT_EQ(run.cases.size(), 2u);
    for (const auto& c : run.cases) {
        EXPECT_EQ(rowOf(c, "double_auditor_abort").outcome, "crashed");
        EXPECT_THAT(rowOf(c, "double_auditor_abort").note, HasSubstr("SIGABRT"));
        EXPECT_EQ(rowOf(c, "double_auditor").outcome, "completed");
        EXPECT_EQ(c.verdict, results::Verdict::Pass) << "the case is not to blame";
        const auto alone = std::count_if(c.audit.begin(), c.audit.end(), [](const AuditRow& row) {
            return row.auditor.find('|') == std::string::npos;
        });
        EXPECT_EQ(alone, 9) << "the oracle, the run and seven auditors";
        for (const AuditRow& row : c.audit)
            EXPECT_EQ(row.auditor.find("abort|"), std::string::npos)
                << "an auditor without results has no pairs";
    }
}

TEST_F(Audit, AuditorsAreHeldAgainstEachOther) {
    const auto run = audited("double_free_flight:preset=default");
    const results::CaseRow& c = run.cases[0];
    const AuditRow& oracle = rowOf(c, "oracle");

    const AuditRow& flipped = rowOf(c, "double_auditor|double_auditor_flipped");
    EXPECT_EQ(flipped.queries, oracle.queries);
    EXPECT_EQ(flipped.overlapping, oracle.overlapping);
    EXPECT_EQ(flipped.missed + flipped.spurious, 0);
    EXPECT_NEAR(flipped.normalErrorMedian.value(), std::numbers::pi, 1e-9);
    EXPECT_EQ(flipped.depthErrorMax.value(), 0.0);

    const AuditRow& deep = rowOf(c, "double_auditor|double_auditor_deep");
    EXPECT_NEAR(deep.depthErrorMedian.value(), 0.01, 1e-12);
    EXPECT_EQ(deep.normalErrorMax.value(), 0.0);

    const AuditRow& blind = rowOf(c, "double_auditor|double_auditor_blind");
    EXPECT_EQ(blind.spurious, oracle.overlapping) << "found by the first alone";
    EXPECT_EQ(blind.missed, 0);
    EXPECT_FALSE(blind.normalErrorMax.has_value());

    const AuditRow& anxious = rowOf(c, "double_auditor|double_auditor_anxious");
    EXPECT_EQ(anxious.missed, oracle.queries - oracle.overlapping) << "found by the second alone";
}

/// Two of several exact normals are the same result; two of which one is wrong are not.
TEST(AuditPairs, EquallyGoodNormalsDoNotDiffer) {
    const auto answer = [](scenario::Vec3 normal, bool minimising) {
        return AuditAnswer{true, true, true, minimising, 0.1, normal};
    };
    const auto angle = [&](bool one, bool other) {
        return pairRow("a", {answer({1, 0, 0}, one)}, "b", {answer({0, 1, 0}, other)}).normalErrorMax.value();
    };
    EXPECT_EQ(angle(true, true), 0.0);
    EXPECT_NEAR(angle(true, false), std::numbers::pi / 2, 1e-15);
    EXPECT_NEAR(angle(false, false), std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(pairRow("a", {AuditAnswer{}}, "b", {answer({1, 0, 0}, true)}).queries, 0);
}

/// Shapes that an auditor does not have are counted and reported, and are no errors.
TEST_F(Audit, WhatAnAuditorLacksIsSaid) {
    std::string text = fixtures::crossingBalls();
    const std::string ball = R"({"sphere": {"radius": 0.25}})";
    for (auto at = text.find(ball); at != std::string::npos; at = text.find(ball))
        text.replace(at, ball.size(), R"({"box": {"half_extents": [0.25, 0.25, 0.25]}})");
    auto o = options();
    o.audit = true;
    const auto run =
        fixtures::RunnerTest::run(fixtures::plan({text}, "double_free_flight:preset=default"), o);
    const AuditRow& row = rowOf(run.cases[0], "double_auditor");
    EXPECT_EQ(row.outcome, "unsupported");
    EXPECT_EQ(row.queries, 0);
    EXPECT_THAT(row.note, HasSubstr("only balls and half-spaces"));
    EXPECT_GT(rowOf(run.cases[0], "oracle").overlapping, 0);
}

TEST_F(Audit, SceneWithoutPairsIsNotAudited) {
    auto s = fixtures::load(fixtures::crossingBalls()).first;
    EXPECT_TRUE(hasAuditablePairs(s));
    for (auto& b : s.bodies)
        for (auto& shape : b.shapes) shape.filter.group = -1;
    EXPECT_FALSE(hasAuditablePairs(s));
    for (auto& b : s.bodies) {
        for (auto& shape : b.shapes) shape.filter = {};
        b.collides = false;
    }
    EXPECT_FALSE(hasAuditablePairs(s));
}

}  // namespace
}  // namespace rigor::validation
