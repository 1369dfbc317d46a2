// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References that hang, eat the memory or crash: each is reported by its name, and costs no run and no
// engine.
#include <gmock/gmock.h>

#include <chrono>

#include "validation/runner/start_program.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using fixtures::plan;
using fixtures::thrownBall;
using results::Outcome;
using results::Verdict;
using testing::HasSubstr;
using testing::StartsWith;

class ReferenceGuard : public fixtures::RunnerTest {
  protected:
    /// Limits for a reference that never ends: it runs over the limit however slow the machine is.
    static constexpr ReferenceLimits kBrief{1.0, 512};
    /// Limits for one that has to end in time, also on a machine with other work.
    static constexpr ReferenceLimits kWide{120.0, 512};

    static std::string ballWith(const std::string& reference, const std::string& extra = "") {
        std::string text = thrownBall("ball", extra);
        const std::string usual = R"({"free_flight": {"body": "ball"}})";
        return text.replace(text.find(usual), usual.size(), reference);
    }
    static std::string ballNaming(const std::string& name, const std::string& extra = "") {
        return ballWith("{\"" + name + "\": {\"body\": \"ball\"}}", extra);
    }
    ReferenceCheck check(const std::string& text, const ReferenceLimits& limits = kWide) const {
        const auto [scenario, stored] = fixtures::load(text);
        return checkReference({stored, scenario.name, scenario.reference.has_value()}, limits,
                              options().binary);
    }
    results::Run runWith(const std::string& text, const ReferenceLimits& limits = kBrief) {
        auto o = options();
        o.referenceLimits = limits;
        return run(plan({text}, "double_free_flight:preset=default"), o);
    }
    /// True if anything was compared with a reference.
    static bool hasExact(const results::CaseRow& row) {
        return std::any_of(row.metrics.begin(), row.metrics.end(),
                           [](const auto& m) { return m.kind == "exact" || m.kind == "scheme_exact"; });
    }
};

TEST_F(ReferenceGuard, EveryEndHasItsName) {
    EXPECT_EQ(check(thrownBall("ball")).outcome, ReferenceOutcome::Holds);
    EXPECT_EQ(check(thrownBall("ball")).problem, "");
    EXPECT_EQ(check(fixtures::crossingBalls()).outcome, ReferenceOutcome::None);
    EXPECT_EQ(check(ballNaming("no_such_reference")).outcome, ReferenceOutcome::Invalid);
    const auto crashed = check(ballNaming("double_crashes"));
    EXPECT_EQ(crashed.outcome, ReferenceOutcome::Crashed);
    EXPECT_THAT(crashed.text(), StartsWith("reference_crashed: the reference crashed: SIGABRT"));
    const auto start = std::chrono::steady_clock::now();
    const auto hung = check(ballNaming("double_hangs"), kBrief);
    EXPECT_EQ(hung.text(), "reference_timeout: the reference did not finish within 1 s");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
    if (isSanitized()) return;  // no memory limit there
    const auto eaten = check(ballNaming("double_eats_memory"));
    EXPECT_EQ(eaten.text(), "reference_out_of_memory: the reference needed more memory than 512 MiB");
}

TEST_F(ReferenceGuard, AnAssumptionThatDoesNotHoldIsNoBreakdown) {
    const auto c = check(ballWith(R"({"sliding_stop": {"body": "ball"}})"));
    EXPECT_FALSE(c.brokeDown());
    EXPECT_NE(c.problem, "");
}

TEST_F(ReferenceGuard, NamesAreReadBack) {
    for (const auto outcome : {ReferenceOutcome::None, ReferenceOutcome::Holds, ReferenceOutcome::Assumption,
                               ReferenceOutcome::Invalid, ReferenceOutcome::Timeout,
                               ReferenceOutcome::OutOfMemory, ReferenceOutcome::Crashed})
        EXPECT_EQ(parseReferenceOutcome(referenceOutcomeName(outcome)), outcome);
    EXPECT_THROW((void)parseReferenceOutcome("reference_lost"), std::runtime_error);
}

/// Many are computed at the same time, forked; each gives its own result, in the order of the questions.
TEST_F(ReferenceGuard, ManyReferencesAreCheckedTogether) {
    const std::string held = thrownBall("ball"), crashes = ballNaming("double_crashes"),
                      none = fixtures::crossingBalls(), unknown = ballNaming("no_such_reference");
    std::vector<ReferenceQuestion> questions;
    for (const std::string& text : {crashes, held, none, unknown, held, crashes}) {
        const auto [scenario, stored] = fixtures::load(text);
        questions.push_back({stored, scenario.name, scenario.reference.has_value()});
    }
    std::vector<ReferenceOutcome> outcomes;
    for (const auto& check : checkReferences(questions, kWide, options().binary, 2))
        outcomes.push_back(check.outcome);
    using enum ReferenceOutcome;
    EXPECT_EQ(outcomes, (std::vector{Crashed, Holds, None, Invalid, Holds, Crashed}));
}

/// The case is run and stored, and is neither a pass nor the engine's fault.
TEST_F(ReferenceGuard, ACaseRunsWithoutTheReferenceThatHangs) {
    const auto r = runWith(ballNaming("double_hangs"));
    ASSERT_EQ(r.cases.size(), 1u);
    const auto& c = r.cases[0];
    EXPECT_EQ(c.outcome, Outcome::Completed);
    EXPECT_EQ(c.verdict, Verdict::NoReference);
    EXPECT_EQ(c.reason, "reference_timeout: the reference did not finish within 1 s");
    EXPECT_EQ(c.steps, 64);
    EXPECT_FALSE(c.metrics.empty()) << "what needs no reference is measured";
    EXPECT_FALSE(hasExact(c));
    EXPECT_TRUE(std::filesystem::exists(options().directory / c.trajectoryFile));
    EXPECT_EQ(r.scenarios.at(0).referenceOutcome, "reference_timeout");
    EXPECT_EQ(r.scenarios.at(0).referenceProblem, "the reference did not finish within 1 s");
    EXPECT_FALSE(runIsGreen(r));
    EXPECT_TRUE(lacksReferencesAlone(r));
}

/// A reference may break down when a metric evaluates it, after its engine's run.
TEST_F(ReferenceGuard, ACaseIsRepeatedWithoutAReferenceThatFailsWhenEvaluated) {
    const std::pair<const char*, const char*> faults[] = {
        {"double_hangs_when_evaluated", "reference_timeout"},
        {"double_crashes_when_evaluated", "reference_crashed"}};
    for (const auto& [name, outcome] : faults) {
        results::Run r;
        // Making it has to end within the limit. One second is enough but for a machine with much other work.
        for (const double seconds : {1.0, 8.0, 64.0}) {
            std::filesystem::remove_all(options().directory);
            const std::string limit = R"(, "time_limit": )" + std::to_string(4 * seconds);
            r = runWith(ballNaming(name, limit), {seconds, 512});
            if (r.scenarios.at(0).referenceOutcome != "reference_timeout") break;
        }
        ASSERT_EQ(r.cases.size(), 1u) << name;
        const auto& c = r.cases[0];
        EXPECT_EQ(c.outcome, Outcome::Completed) << name;
        EXPECT_EQ(c.verdict, Verdict::NoReference) << name;
        EXPECT_THAT(c.reason, StartsWith(outcome)) << name;
        EXPECT_EQ(r.scenarios.at(0).referenceOutcome, "holds") << "as far as it was evaluated before";
        EXPECT_FALSE(hasExact(c)) << name;
        EXPECT_EQ(c.steps, 64);
    }
}

TEST_F(ReferenceGuard, WhatAnEngineMissesItMissesWithoutAReferenceToo) {
    const auto r = runWith(ballNaming("double_hangs", R"(, "accept": {"*": {"energy_drift": 1e-300}})"));
    const auto& c = r.cases.at(0);
    EXPECT_EQ(c.verdict, Verdict::Fail) << c.reason;
    EXPECT_THAT(c.reason, HasSubstr("energy_drift"));
    EXPECT_FALSE(lacksReferencesAlone(r));
}

/// An engine that dies before its run is over is not taken for its reference.
TEST_F(ReferenceGuard, AnEngineThatDiesIsStillBlamed) {
    auto o = options();
    const auto r = run(plan({thrownBall("ball")}, "double_segfault:preset=default"), o);
    EXPECT_EQ(r.cases.at(0).verdict, Verdict::Crashed);
}

}  // namespace
}  // namespace rigor::validation
